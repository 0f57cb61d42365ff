#include "HapticsGuiTest.h"

#include "GuiTestTools.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqObjectBuilder.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqTabbedMultiViewWidget.h"
#include "pqUndoStack.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVHapticScene.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLabel>
#include <QMainWindow>
#include <QScreen>
#include <QTabBar>
#include <QTest>
#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>

#include <algorithm>
#include <string>

using namespace GuiTest;

namespace
{
// Enough to take a while; the full size of an ordinary scan is asked for by an environment
// variable: see Plugin/README.md.
const int SphereResolution = qEnvironmentVariableIntValue("HAPTICS_GUI_LARGE") ? 870 : 300;

QTimer* timer()
{
  return pqApplicationCore::instance()->findChild<QTimer*>("HapticsTimer");
}

double stiffness()
{
  return vtkSMPropertyHelper(scene(), "Stiffness").GetAsDouble();
}

QList<pqPipelineSource*> sources()
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItems<pqPipelineSource*>();
}

pqPipelineSource* makeLargeSphere()
{
  pqPipelineSource* sphere = pqApplicationCore::instance()->getObjectBuilder()->createSource(
    "sources", "SphereSource", pqActiveObjects::instance().activeServer());
  vtkSMPropertyHelper(sphere->getProxy(), "ThetaResolution").Set(SphereResolution);
  vtkSMPropertyHelper(sphere->getProxy(), "PhiResolution").Set(SphereResolution);
  apply(sphere);
  return sphere;
}
}

void HapticsGuiTest::theTimerRestsWhileReleased()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(timer()->isActive());
  QVERIFY2(timer()->interval() >= 1000 / 60, "at most 60 times a second");
  pressTouch();
  QVERIFY(waitUntil([] { return !timer()->isActive(); }));
}

void HapticsGuiTest::aRestingHandIsNotDrawnAgain()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(press());
  int renders = 0;
  QObject counting;
  QObject::connect(pqActiveObjects::instance().activeView(), &pqView::endRender, &counting,
    [&renders] { ++renders; });
  // On a busy machine the hand takes a while to rest.
  for (int i = 0; i == 0 || (i < 10 && renders > 0); ++i)
  {
    renders = 0;
    QTest::qWait(500);
  }
  QCOMPARE(renders, 0);
  turnWheel(0.5, 0.4, 1);
  QVERIFY(waitUntil([&renders] { return renders > 0; }));
}

void HapticsGuiTest::theHandFollowsTheActiveView()
{
  makeWaveletContour();
  pqView* first = pqActiveObjects::instance().activeView();
  pressTouch();
  QVERIFY(engaged());
  QVERIFY(vtkSMPropertyHelper(scene(), "View").GetAsProxy() == first->getProxy());

  pqView* second = pqApplicationCore::instance()->getObjectBuilder()->createView(
    pqRenderView::renderViewType(), pqActiveObjects::instance().activeServer());
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->AssignViewToLayout(second->getViewProxy());
  pqActiveObjects::instance().setActiveView(second);
  QTest::qWait(200);
  QVERIFY2(engaged(), "a view with nothing to touch takes no hand away");
  QVERIFY(vtkSMPropertyHelper(scene(), "View").GetAsProxy() == first->getProxy());

  vtkSMProxy* shown = controller->Show(
    pqActiveObjects::instance().activeSource()->getSourceProxy(), 0, second->getViewProxy());
  vtkSMPropertyHelper(shown, "Touchable").Set(1);
  shown->UpdateVTKObjects();
  QVERIFY(waitUntil(
    [second] {
      return vtkSMPropertyHelper(scene(), "View").GetAsProxy() == second->getProxy() && engaged();
    }));
  QVERIFY(touchIsDown());
  QCOMPARE(vtkSMPropertyHelper(scene(), "Surfaces").GetAsProxy(0), shown);
}

void HapticsGuiTest::panelAndProxyShowTheSameSettings()
{
  makeWaveletContour();
  pressTouch();
  auto* box = find<QDoubleSpinBox>("stiffness");
  QCOMPARE(box->value(), stiffness());
  box->setValue(640.0);
  QCOMPARE(stiffness(), 640.0);
  pqApplicationCore::instance()->getUndoStack()->undo();
  QCOMPARE(stiffness(), 500.0);
  QCOMPARE(box->value(), 500.0);
  QVERIFY2(engaged(), "undo of a setting leaves the hand as it is");
  vtkSMPropertyHelper(scene(), "MaximumForce").Set(2.0);
  scene()->UpdateVTKObjects();
  QCOMPARE(find<QDoubleSpinBox>("maximumForce")->value(), 2.0);
}

void HapticsGuiTest::settingsAreWhatTouchBeginsWith()
{
  findAction("actionEditSettings")->trigger();
  const auto pages = []
  {
    QStringList names;
    for (QWidget* window : QApplication::topLevelWidgets())
    {
      for (const QTabBar* tabs :
        window->isVisible() ? window->findChildren<QTabBar*>() : QList<QTabBar*>())
      {
        for (int i = 0; i < tabs->count(); ++i)
        {
          names << tabs->tabText(i);
        }
      }
    }
    return names;
  };
  QVERIFY2(
    waitUntil([pages] { return pages().contains("Haptics"); }), qPrintable(pages().join(", ")));
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (window->inherits("pqSettingsDialog"))
    {
      window->close();
    }
  }

  const auto set = [](double stiffness)
  {
    vtkSMProxy* settings = pqActiveObjects::instance().activeServer()->proxyManager()->GetProxy(
      "settings", "HapticSettings");
    vtkSMPropertyHelper(settings, "Stiffness").Set(stiffness);
    settings->UpdateVTKObjects();
  };
  makeWaveletContour();
  pressTouch();
  set(650.0);
  QVERIFY2(stiffness() == 500.0, "this session has begun");
  // After Reset Session the panel shows what Touch begins with.
  pqApplicationCore::instance()->getObjectBuilder()->resetServer(
    pqActiveObjects::instance().activeServer());
  QVERIFY(waitUntil([] { return pqActiveObjects::instance().activeServer() && !scene(); }));
  set(700.0);
  QVERIFY(waitUntil([] { return find<QDoubleSpinBox>("stiffness")->value() == 700.0; }));
  startAnew();
  makeWaveletContour();
  pressTouch();
  QCOMPARE(stiffness(), 700.0);
  QCOMPARE(clientScene()->GetStiffness(), 700.0);
  QCOMPARE(find<QDoubleSpinBox>("stiffness")->value(), 700.0);
  set(500.0);
  vtkSMPropertyHelper(scene(), "Stiffness").Set(500.0);
  scene()->UpdateVTKObjects();
}

void HapticsGuiTest::landmarksBecomeASource()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(press());
  auto* drop = find<QAbstractButton>("dropLandmark");
  QVERIFY(waitUntil([drop] { return drop->isEnabled(); }));
  drop->click();
  QCOMPARE(clientScene()->GetNumberOfLandmarks(), 1);
  auto* toSource = find<QAbstractButton>("exportLandmarks");
  QVERIFY(waitUntil([toSource] { return toSource->isEnabled(); }));
  toSource->click();
  const QList<pqPipelineSource*> sources =
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqPipelineSource*>();
  pqPipelineSource* source = sources.last();
  QVERIFY2(source->getSMName().startsWith("HapticLandmarks"), qPrintable(source->getSMName()));
  vtkPVDataInformation* information = source->getSourceProxy()->GetDataInformation(0);
  QCOMPARE(information->GetNumberOfPoints(), vtkTypeInt64(1));
  QVERIFY(information->GetArrayInformation("Force", vtkDataObject::POINT));
  find<QAbstractButton>("clearLandmarks")->click();
  QCOMPARE(clientScene()->GetNumberOfLandmarks(), 0);
}

void HapticsGuiTest::aRecordingIsPlayedBack()
{
  const QString file = QString(qgetenv("HAPTICS_TEST_OUTPUT")) + "/GuiTest.hrec";
  makeWaveletContour();
  pressTouch();
  pressTouch();
  vtkSMPropertyHelper(scene(), "RecordingFileName").Set(qPrintable(file));
  scene()->UpdateVTKObjects();
  QVERIFY(find<QAbstractButton>("record")->isChecked());
  pressTouch();
  QVERIFY(press());
  QVERIFY(find<QLabel>("recording")->text().startsWith("recording to"));
  pressTouch();
  // One run: the next one does not write over it.
  QCOMPARE(vtkSMPropertyHelper(scene(), "RecordingFileName").GetAsString(), "");
  QVERIFY(!find<QAbstractButton>("record")->isChecked());
  QVERIFY(QFileInfo(file).size() > 0);

  setDevice(qPrintable(file));
  QCOMPARE(find<QComboBox>("device")->currentText(), QString("GuiTest.hrec"));
  pressTouch();
  QCOMPARE(takeComplaint(), QString());
  QVERIFY(waitUntil(touching));
}

void HapticsGuiTest::theForceChartFollowsTheHand()
{
  makeWaveletContour();
  auto* show = findAction("actionHapticForceChart");
  show->trigger();
  auto* dock = find<QDockWidget>("HapticsForceChart");
  QVERIFY(dock && dock->isVisible());
  QVERIFY(show->isChecked());
  auto* drawn = dock->findChild<QVTKOpenGLNativeWidget*>();
  const auto hasCurve = [drawn]
  {
    const QImage picture = drawn->grabFramebuffer();
    int red = 0;
    for (int x = 0; x < picture.width(); ++x)
    {
      for (int y = 0; y < picture.height(); ++y)
      {
        const QColor color = picture.pixelColor(x, y);
        red += color.red() > 150 && color.blue() < 100 ? 1 : 0;
      }
    }
    return red > 20; // above the axis: see the force
  };
  QVERIFY2(!hasCurve(), "nothing was felt yet");
  pressTouch();
  QVERIFY(press());
  QVERIFY(waitUntil(hasCurve));
  dock->close();
  QVERIFY(waitUntil([show] { return !show->isChecked(); }));
}

void HapticsGuiTest::strokesBecomeCurvesWithData()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(press());
  const int before = sources().size();
  findAction("actionHapticDraw")->trigger();
  for (double x = 0.5; x < 0.56; x += 0.005)
  {
    moveMouse(x, 0.4);
    QTest::qWait(20);
  }
  findAction("actionHapticDraw")->trigger();
  QCOMPARE(sources().size(), before + 1);
  pqPipelineSource* curves = sources().last();
  QVERIFY2(curves->getSMName().startsWith("HapticCurves"), qPrintable(curves->getSMName()));
  vtkPVDataInformation* data = curves->getSourceProxy()->GetDataInformation(0);
  QVERIFY(data->GetNumberOfCells() >= 1);
  QVERIFY(data->GetNumberOfPoints() > 10);
  for (const char* name : { "ForceMagnitude", "Time", "arc_length", "RTData" })
  {
    QVERIFY2(data->GetArrayInformation(name, vtkDataObject::POINT), name);
  }
  // On the contour at 157 its scalar is that value, to within the deviation of its triangles.
  double range[2];
  data->GetArrayInformation("RTData", vtkDataObject::POINT)->GetComponentRange(0, range);
  QVERIFY(range[0] > 156.9 && range[1] < 157.1);
  QVERIFY(!clientScene()->GetRecordTrace());
}

void HapticsGuiTest::aTraceIsPlottedByItsForce()
{
  makeWaveletContour();
  pqView* active = pqActiveObjects::instance().activeView();
  pressTouch();
  findAction("actionHapticKeepTrace")->trigger();
  QVERIFY(press());
  findAction("actionHapticKeepTrace")->trigger();
  QVERIFY(waitUntil([] { return findAction("actionHapticPlotForce")->isEnabled(); }));
  findAction("actionHapticPlotForce")->trigger();
  const QList<pqView*> views =
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqView*>();
  const auto chart = std::find_if(
    views.begin(), views.end(), [](pqView* view) { return view->getViewType() == "XYChartView"; });
  QVERIFY(chart != views.end());
  QCOMPARE((*chart)->getNumberOfVisibleDataRepresentations(), 1);
  vtkSMProxy* shown = (*chart)->getRepresentation(0)->getProxy();
  QCOMPARE(vtkSMPropertyHelper(shown, "XArrayName").GetAsString(), "Time");
  vtkSMPropertyHelper series(shown, "SeriesVisibility");
  for (unsigned int i = 0; i + 1 < series.GetNumberOfElements(); i += 2)
  {
    const std::string name = series.GetAsString(i);
    QCOMPARE(series.GetAsString(i + 1), name == "ForceMagnitude" ? "1" : "0");
  }
  QCOMPARE(pqActiveObjects::instance().activeView(), active);
  QVERIFY(engaged());
}

void HapticsGuiTest::theTouchedCellIsSelected()
{
  pqPipelineSource* contour = makeWaveletContour();
  pressTouch();
  QVERIFY(press());
  findAction("actionHapticSelectTouched")->trigger();
  const auto selected = [contour]() -> vtkTypeInt64
  {
    vtkSMSourceProxy* selection = contour->getSourceProxy()->GetSelectionInput(0);
    vtkSMProxy* cells = selection ? vtkSMPropertyHelper(selection, "Input").GetAsProxy(0) : nullptr;
    if (!cells)
    {
      return -1;
    }
    vtkSMPropertyHelper ids(cells, "IDs", true);
    return ids.GetNumberOfElements() == 2 ? ids.GetAsIdType(1) : -1;
  };
  QVERIFY(waitUntil([selected] { return selected() >= 0; }));
  const vtkTypeInt64 first = selected();
  moveMouse(0.55, 0.4);
  QVERIFY(waitUntil([selected, first] { return selected() >= 0 && selected() != first; }));
  QVERIFY(waitUntil([selected] { return selected() == clientScene()->GetTouchedCell(); }));
  findAction("actionHapticSelectTouched")->trigger();
}

void HapticsGuiTest::aDraggedContourIsFollowed()
{
  pqPipelineSource* contour = makeWaveletContour();
  vtkSMPropertyHelper value(contour->getProxy(), "ContourValues");
  value.Set(0, 230.0); // closed, till below 200
  apply(contour);
  pressTouch();
  QVERIFY(press());
  // As the slider of the panel does while it is dragged: the value, and a picture.
  for (double dragged = 228.0; dragged >= 204.0; dragged -= 2.0)
  {
    value.Set(0, dragged);
    contour->getProxy()->UpdateVTKObjects();
    pqActiveObjects::instance().activeView()->forceRender();
    QTest::qWait(30);
    QCOMPARE(QString(clientScene()->GetMessage()), QString());
  }
  QVERIFY(waitUntil([] { return !clientScene()->GetBuilding(); }));
  QVERIFY2(touching(), "The contour grows over the hand, which stays outside.");
  QVERIFY(engaged());
  QCOMPARE(takeComplaint(), QString());
}

void HapticsGuiTest::aLargeSurfaceIsBuiltBeside()
{
  makeLargeSphere();
  int ticks = 0;
  qint64 longest = 0; // that the interface stood still [ms]
  QTimer ticking;
  QElapsedTimer since;
  QObject::connect(&ticking, &QTimer::timeout, &ticking,
    [&]
    {
      ++ticks;
      longest = std::max(longest, since.restart());
    });
  since.start();
  pressTouch();
  qInfo("Touch took %lld ms", since.elapsed());
  QVERIFY(clientScene()->GetBuilding());
  QVERIFY(find<QWidget>("building")->isVisible());
  ticking.start(10);
  QVERIFY(waitUntil([] { return !clientScene()->GetBuilding(); }, 120.0));
  QVERIFY2(ticks > 0, "The interface went on while the surface was built.");
  qInfo("%d cells: the interface stood still for %lld ms at most",
    2 * SphereResolution * SphereResolution, longest);
  QVERIFY(waitUntil([] { return !find<QWidget>("building")->isVisible(); }));
  QVERIFY(engaged());
  QVERIFY(press());
}

void HapticsGuiTest::buildingCanBeCancelled()
{
  makeLargeSphere();
  pressTouch();
  QVERIFY(clientScene()->GetBuilding());
  QTest::mouseClick(find<QAbstractButton>("cancelBuild"), Qt::LeftButton);
  QVERIFY(waitUntil([] { return !clientScene()->GetBuilding(); }));
  QString complaint;
  QVERIFY(waitUntil(
    [&complaint]
    {
      complaint = takeComplaint();
      return !complaint.isEmpty();
    }));
  QVERIFY2(complaint.contains("given up"), qPrintable(complaint));
  QVERIFY(!touchIsDown());
}

/// The picture in Plugin/README.md, which names the command.
void HapticsGuiTest::makePictureForReadme()
{
  const QString picture(qgetenv("HAPTICS_GUI_PICTURE"));
  if (picture.isEmpty())
  {
    QSKIP("No picture is asked for.");
  }
  find<pqTabbedMultiViewWidget>("MultiViewWidget")->lockViewSize(QSize());
  auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
  window->setGeometry(0, 0, 1280, 860);
  openFile(QString(qgetenv("HAPTICS_SURFACES_DIR")) + "/pial.vtp");
  auto* shown = vtkSMPVRepresentationProxy::SafeDownCast(
    pqActiveObjects::instance().activeRepresentation()->getProxy());
  shown->SetScalarColoring("Sulc", vtkDataObject::POINT);
  shown->RescaleTransferFunctionToDataRange();
  pressTouch();
  vtkSMPropertyHelper(scene(), "ShowTrail").Set(1);
  scene()->UpdateVTKObjects();
  QVERIFY(press(0.55));
  for (double x = 0.5; x < 0.575; x += 0.002)
  {
    moveMouse(x, 0.55);
    QTest::qWait(30);
  }
  QTest::qWait(1000);
  QVERIFY(QGuiApplication::primaryScreen()->grabWindow(0, 0, 0, 1280, 860).save(picture));
}
