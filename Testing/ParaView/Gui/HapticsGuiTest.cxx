#include "HapticsGuiTest.h"

#include "GuiTestTools.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreTestUtility.h"
#include "pqDataRepresentation.h"
#include "pqFiltersMenuReaction.h"
#include "pqObjectBuilder.h"
#include "pqPipelineSource.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkPVHapticScene.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QLabel>
#include <QProgressBar>
#include <QTableWidget>
#include <QTest>

#include <string>

using namespace GuiTest;

namespace
{
const QString HapticSurface = "Haptic Surface";
// What ParaView's own tests allow: antialiasing and text differ between drivers.
constexpr double ImageThreshold = 20.0;

/// Whether the active view looks as the baseline of that name; leaves its picture where not.
bool looksLike(const char* baseline)
{
  QTest::qWait(300); // until the hand rests
  const QString folder(qgetenv("HAPTICS_TEST_OUTPUT"));
  return pqCoreTestUtility::CompareView(pqActiveObjects::instance().activeView(),
    QString(qgetenv("HAPTICS_SOURCE_DIR")) + "/Testing/Data/Baseline/" + baseline, ImageThreshold,
    folder, QSize(400, 400));
}
}

void HapticsGuiTest::initTestCase()
{
  QVERIFY2(find<QWidget>("pqHapticsPanel"), "The dock panel is there.");
  QVERIFY2(find<QWidget>("HapticsToolBar"), "The toolbar is there.");
  QVERIFY2(!scene(), "Nothing is made before it is needed.");
}

void HapticsGuiTest::init()
{
  startAnew();
  if (scene())
  {
    setDevice("mouse");
  }
  QVERIFY(!touchIsDown());
  takeComplaint();
}

void HapticsGuiTest::touchFeelsAWaveletContour()
{
  makeWaveletContour();
  pressTouch();
  QCOMPARE(takeComplaint(), QString());
  QVERIFY(touchIsDown());
  QVERIFY(engaged());
  QCOMPARE(representationType(), HapticSurface);
  QCOMPARE(find<QComboBox>("device")->currentText(), QString("Mouse"));

  QVERIFY(press());
  QVERIFY(clientScene()->GetForceMagnitude() > 0.1);
  QVERIFY(waitUntil([] { return find<QProgressBar>("force")->value() > 0; }));
  QVERIFY(waitUntil([] { return find<QTableWidget>("values")->rowCount() > 0; }));
  QVERIFY(looksLike("TouchAWaveletContour.png"));

  pressTouch();
  QVERIFY(!touchIsDown());
  QVERIFY(!engaged());
  QCOMPARE(clientScene()->GetForceMagnitude(), 0.0);
}

void HapticsGuiTest::touchFeelsARealMesh()
{
  const QString file = QString(qgetenv("HAPTICS_SURFACES_DIR")) + "/gearbox.stl";
  if (!QFileInfo::exists(file))
  {
    QSKIP("The surface gearbox could not be got.");
  }
  openFile(file);
  pressTouch();
  QCOMPARE(takeComplaint(), QString());
  QVERIFY(engaged());
  QVERIFY(press(0.3));
  QVERIFY(looksLike("TouchARealMesh.png"));
}

void HapticsGuiTest::touchWithoutASourceTellsWhatToDo()
{
  pressTouch();
  QVERIFY(takeComplaint().contains("No source is selected"));
  QVERIFY(!touchIsDown());
  QVERIFY(!engaged());
}

void HapticsGuiTest::touchOfPointsTellsWhatToDo()
{
  makeSource("PointSource");
  pressTouch();
  QString complaint; // not before a look at the points was taken, beside
  QVERIFY(waitUntil(
    [&complaint]
    {
      complaint = takeComplaint();
      return !complaint.isEmpty();
    }));
  QVERIFY2(complaint.contains("no surface"), qPrintable(complaint));
  QVERIFY(!touchIsDown());
  QVERIFY(!engaged());
}

void HapticsGuiTest::touchInAChartViewTellsWhatToDo()
{
  makeWaveletContour();
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  pqActiveObjects::instance().setActiveView(
    builder->createView("XYChartView", pqActiveObjects::instance().activeServer()));
  pressTouch();
  QVERIFY(takeComplaint().contains("Click into a render view"));
  QVERIFY(!touchIsDown());
  QVERIFY(!engaged());
}

void HapticsGuiTest::closingTheViewReleasesTheHand()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(press());
  pqApplicationCore::instance()->getObjectBuilder()->destroy(
    pqActiveObjects::instance().activeView());
  QVERIFY(!engaged());
  QVERIFY(waitUntil([] { return !touchIsDown(); }));
  QCOMPARE(clientScene()->GetForceMagnitude(), 0.0);
  // ParaView goes on, and so does the plugin.
  startAnew();
  makeWaveletContour();
  pressTouch();
  QVERIFY(press());
}

void HapticsGuiTest::deletingTheTouchedSourceLeavesFreeSpace()
{
  pqPipelineSource* contour = makeWaveletContour();
  pressTouch();
  QVERIFY(press());
  pqApplicationCore::instance()->getObjectBuilder()->destroy(contour);
  QVERIFY(waitUntil([] { return !touching(); }));
  QCOMPARE(clientScene()->GetForceMagnitude(), 0.0);
  QCOMPARE(vtkSMPropertyHelper(scene(), "Surfaces").GetNumberOfElements(), 0u);
}

void HapticsGuiTest::resettingTheSessionReleasesTheHand()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(press());
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  builder->resetServer(pqActiveObjects::instance().activeServer());
  QVERIFY(waitUntil([] { return pqActiveObjects::instance().activeServer() != nullptr; }));
  QVERIFY(waitUntil([] { return !touchIsDown(); }));
  QVERIFY(!engaged());
}

void HapticsGuiTest::undoTakesTheRepresentationBack()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(engaged());
  pressTouch();
  pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  QCOMPARE(stack->undoLabel(), QString("Touch"));
  stack->undo();
  QCOMPARE(representationType(), QString("Surface"));
  QVERIFY(!engaged());
  stack->redo();
  QCOMPARE(representationType(), HapticSurface);
  QVERIFY(!engaged()); // a device starts only when a user says so
}

void HapticsGuiTest::undoTakesTheFilterBack()
{
  makeWaveletContour();
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  const auto count = [model] { return model->findItems<pqPipelineSource*>().size(); };
  const auto before = count();
  pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  pqPipelineSource* surface = pqFiltersMenuReaction::createFilter("filters", "GodObjectFilter");
  QVERIFY(surface);
  QCOMPARE(count(), before + 1);
  stack->undo();
  QCOMPARE(count(), before);
  stack->redo();
  QCOMPARE(count(), before + 1);
}

void HapticsGuiTest::aDeviceThatIsNotThereTellsSo()
{
  makeWaveletContour();
  setDevice("/nowhere/stroke.hrec");
  pressTouch();
  const QString complaint = takeComplaint();
  QVERIFY2(complaint.contains("/nowhere/stroke.hrec"), qPrintable(complaint));
  QVERIFY(!touchIsDown());
  setDevice("mouse");
  pressTouch();
  QVERIFY(press());
}
