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
#include <QAction>
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
  QCOMPARE(representationType(), QString("Surface"));
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

void HapticsGuiTest::touchIsDisabledWhereNothingCanBeTouchedAndSaysWhy()
{
  auto* touch = findAction("actionTouch");
  QVERIFY(!touch->isEnabled());
  QVERIFY2(touch->toolTip().contains("No source is selected"), qPrintable(touch->toolTip()));
  makeWaveletContour();
  QVERIFY(touch->isEnabled());
  QVERIFY(!touch->toolTip().contains("No source"));
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  pqActiveObjects::instance().setActiveView(
    builder->createView("XYChartView", pqActiveObjects::instance().activeServer()));
  QVERIFY(!touch->isEnabled());
  QVERIFY2(touch->toolTip().contains("Click into a render view"), qPrintable(touch->toolTip()));
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

void HapticsGuiTest::touchOfASecondSourceAddsIt()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(touchIsDown());
  makeSource("SphereSource");
  QVERIFY2(!touchIsDown(), "The button shows whether what is selected is touched.");
  pressTouch();
  QVERIFY(touchIsDown());
  QVERIFY(engaged());
  QCOMPARE(vtkSMPropertyHelper(scene(), "Surfaces").GetNumberOfElements(), 2u);
  pressTouch();
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
  QVERIFY(!engaged());
  QCOMPARE(QString(clientScene()->GetMessage()), QString()); // no error: the user did it
  QCOMPARE(takeComplaint(), QString());
  QVERIFY(QString(clientScene()->GetState()).contains("nothing is left to touch"));
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

void HapticsGuiTest::undoTakesTouchBack()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(engaged());
  pressTouch();
  pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  QCOMPARE(stack->undoLabel(), QString("Touch"));
  stack->undo();
  QVERIFY(!isTouchable());
  QVERIFY(!engaged());
  stack->redo();
  QVERIFY(isTouchable());
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

void HapticsGuiTest::findingDevicesShowsTheirStates()
{
  auto* chooser = find<QComboBox>("device");
  const int falcon = chooser->findData("falcon");
  QVERIFY(falcon >= 0);
  QVERIFY(chooser->findData("simulated") >= 0);
  const QString before = chooser->currentText();
  const int last = chooser->findText("Find devices...");
  QVERIFY(last >= 0);
  Q_EMIT chooser->activated(last);
  chooser->hidePopup();
  const QString state = chooser->itemData(chooser->findData("falcon"), Qt::ToolTipRole).toString();
  QVERIFY2(state.contains("plugged in"), qPrintable(state));
  QCOMPARE(chooser->currentText(), before);
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
