#include "HapticsGuiTest.h"

#include "GuiTestTools.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreTestUtility.h"
#include "pqDataRepresentation.h"
#include "pqFiltersMenuReaction.h"
#include "pqLoadStateReaction.h"
#include "pqObjectBuilder.h"
#include "pqPipelineSource.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqSourcesMenuReaction.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkNew.h"
#include "vtkPVHapticReadings.h"
#include "vtkPVHapticScene.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QProgressBar>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QToolBar>
#include <QTreeView>

#include <functional>
#include <string>

using namespace GuiTest;

namespace
{
/// As a user does, in the panel.
void setStiffness(double value)
{
  find<QDoubleSpinBox>("stiffness")->setValue(value);
}

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
  // Nothing is touched yet: what that advises every test does.
  const QString state = find<QLabel>("state")->text();
  const auto ExpectRemedyIn = [](const char* words, const QString& text)
  { return text.contains(words); };
  QVERIFY2(ExpectRemedyIn("Select a source and press Touch", state), qPrintable(state));
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

void HapticsGuiTest::touchWorksOnAWaveletContour()
{
  makeWaveletContour();
  pressTouch();
  QCOMPARE(takeComplaint(), QString());
  QVERIFY(touchIsDown());
  QVERIFY(engaged());
  QCOMPARE(representationType(), QString("Surface"));
  QCOMPARE(find<QComboBox>("device")->currentText(), QString("Mouse"));

  QVERIFY(press());
  QVERIFY(clientScene()->GetReadings()->GetForceMagnitude() > 0.1);
  QVERIFY(waitUntil([] { return find<QProgressBar>("force")->value() > 0; }));
  QVERIFY(waitUntil([] { return find<QTableWidget>("values")->rowCount() > 0; }));
  QVERIFY(looksLike("TouchAWaveletContour.png"));

  pressTouch();
  QVERIFY(!touchIsDown());
  QVERIFY(!engaged());
  QCOMPARE(clientScene()->GetReadings()->GetForceMagnitude(), 0.0);
}

void HapticsGuiTest::touchWorksOnARealMesh()
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

void HapticsGuiTest::actionsAreInMenuToolBarAndCustomizeShortcuts()
{
  QStringList buttons;
  for (QAction* action : find<QToolBar>("HapticsToolBar")->actions())
  {
    QVERIFY2(!action->icon().isNull(), qPrintable(action->text()));
    buttons << action->text();
  }
  const QStringList atOnce{ "Touch", "Engage", "Press", "Drop Landmark", "Clutch", "Record..." };
  QCOMPARE(buttons, atOnce);
  QStringList listed;
  QTimer::singleShot(0,
    [&listed]
    {
      QWidget* dialog = QApplication::activeModalWidget();
      auto* tree = dialog ? dialog->findChild<QTreeView*>() : nullptr;
      const std::function<void(const QModelIndex&)> collect = [&](const QModelIndex& parent)
      {
        for (int row = 0; row < tree->model()->rowCount(parent); ++row)
        {
          const QModelIndex index = tree->model()->index(row, 0, parent);
          listed << index.data().toString().remove('&');
          collect(index);
        }
      };
      if (tree)
      {
        collect(QModelIndex());
      }
      if (dialog)
      {
        dialog->close();
      }
    });
  findAction("actionCustomize")->trigger();
  for (const QString& name : atOnce)
  {
    QVERIFY2(listed.contains(name), qPrintable(name + " in: " + listed.join(", ")));
  }
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

void HapticsGuiTest::touchOfPointsSaysWhatToDo()
{
  makeSource("PointSource");
  pressTouch();
  QString complaint; // not before a look at the points was taken, in the background
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

/// Follows what messages advise: `ExpectRemedy` finds the words, and not any more afterwards.
void HapticsGuiTest::whatMessagesAdviseEndsTheFault()
{
  auto* touch = findAction("actionTouch");
  const auto ExpectRemedy = [touch](const char* words, const std::function<void()>& remedy)
  {
    const auto says = [touch, words] { return touch->toolTip().contains(words); };
    const bool wasSaid = waitUntil([&] { return says() && !touch->isEnabled(); });
    const QString before = touch->toolTip();
    remedy();
    return wasSaid && waitUntil([&] { return !says() && touch->isEnabled(); })
      ? QString()
      : QString(words) + " | " + before + " | " + touch->toolTip();
  };
  QString problem =
    ExpectRemedy("Select one in the pipeline browser", [] { makeSource("SphereSource"); });
  QVERIFY2(problem.isEmpty(), qPrintable(problem));

  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  pqServer* server = pqActiveObjects::instance().activeServer();
  pqPipelineSource* cone = pqSourcesMenuReaction::createSource("sources", "ConeSource");
  pqActiveObjects::instance().setActiveSource(cone);
  problem = ExpectRemedy("has not been computed yet. Press Apply", [cone] { apply(cone); });
  QVERIFY2(problem.isEmpty(), qPrintable(problem));

  // A table, as of a file of comma-separated values.
  const QString file = QString(qgetenv("HAPTICS_TEST_OUTPUT")) + "/GuiTest.csv";
  QFile table(file);
  QVERIFY(table.open(QIODevice::WriteOnly));
  table.write("x,y\n1,2\n");
  table.close();
  pqPipelineSource* rows = builder->createReader("sources", "CSVReader", QStringList(file), server);
  rows->getProxy()->UpdateVTKObjects();
  rows->setModifiedState(pqProxy::UNMODIFIED);
  rows->updatePipeline();
  pqActiveObjects::instance().setActiveSource(rows);
  const auto selectCone = [cone] { pqActiveObjects::instance().setActiveSource(cone); };
  problem = ExpectRemedy("is no surface. Select a source of surfaces or volumes", selectCone);
  QVERIFY2(problem.isEmpty(), qPrintable(problem));

  pqView* render = pqActiveObjects::instance().activeView();
  pqActiveObjects::instance().setActiveView(builder->createView("XYChartView", server));
  problem = ExpectRemedy("Click into a render view, or make one",
    [render] { pqActiveObjects::instance().setActiveView(render); });
  QVERIFY2(problem.isEmpty(), qPrintable(problem));

  // An example in the wrong view.
  auto* example = findAction("actionHapticExampleContour");
  QVERIFY(example);
  pqActiveObjects::instance().setActiveView(builder->createView("XYChartView", server));
  example->trigger();
  const QString refusal = takeComplaint();
  const auto ExpectRemedyIn = [](const char* words, const QString& text)
  { return text.contains(words); };
  QVERIFY2(ExpectRemedyIn("needs a render view. Click into one, or make one", refusal),
    qPrintable(refusal));
  pqActiveObjects::instance().setActiveView(render);
  example->trigger();
  QCOMPARE(takeComplaint(), QString());
  QVERIFY(waitUntil(engaged));
  pressTouch();

  // What is engaged before anything is touched complains, and Touch helps.
  setDevice("mouse");
  startAnew();
  findAction("actionHapticEngage")->trigger();
  const QString complaint = takeComplaint();
  QVERIFY2(complaint.contains("shows nothing that can be touched. Select a source and press Touch"),
    qPrintable(complaint));
  makeWaveletContour();
  pressTouch();
  QCOMPARE(takeComplaint(), QString());
  QVERIFY(press());

  // What the hand left has no surface; another source has.
  findAction("actionHapticDropLandmark")->trigger();
  findAction("actionHapticLandmarksToSource")->trigger();
  pqPipelineSource* contour = nullptr;
  pqPipelineSource* landmarks = nullptr;
  for (pqPipelineSource* source :
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqPipelineSource*>())
  {
    contour = source->getSMName().startsWith("Contour") ? source : contour;
    landmarks = source->getSMName().startsWith("HapticLandmarks") ? source : landmarks;
  }
  QVERIFY(contour && landmarks);
  pqActiveObjects::instance().setActiveSource(landmarks);
  problem = ExpectRemedy("it has no surface. Select another source",
    [contour] { pqActiveObjects::instance().setActiveSource(contour); });
  QVERIFY2(problem.isEmpty(), qPrintable(problem));

  // Cells of several blocks are not selected by touch; merged ones are.
  startAnew();
  auto* paint = findAction("actionHapticPaint");
  pqPipelineSource* group = makeFilter("GroupDataSets", makeSource("SphereSource"));
  pressTouch();
  QVERIFY(press(0.5));
  paint->trigger();
  QString said;
  QVERIFY(waitUntil([&said] { return !(said = takeComplaint()).isEmpty(); }));
  QVERIFY2(ExpectRemedyIn("Apply Merge Blocks, and touch that", said), qPrintable(said));
  pressTouch();
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->Hide(
    group->getSourceProxy(), 0, pqActiveObjects::instance().activeView()->getViewProxy());
  pqPipelineSource* merged = makeFilter("MergeBlocks", group);
  pressTouch();
  QVERIFY(press(0.5));
  paint->trigger();
  QVERIFY(
    waitUntil([merged] { return merged->getSourceProxy()->GetSelectionInput(0) != nullptr; }));
  QCOMPARE(takeComplaint(), QString());
  paint->trigger();
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
  // Undone, it is not touched, which the button shows; another press touches it again.
  pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  QCOMPARE(stack->undoLabel(), QString("Touch"));
  stack->undo();
  QVERIFY(waitUntil([] { return !touchIsDown(); }));
  QVERIFY(engaged());
  pressTouch();
  QVERIFY(touchIsDown());
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
  QCOMPARE(clientScene()->GetReadings()->GetForceMagnitude(), 0.0);
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
  QCOMPARE(clientScene()->GetReadings()->GetForceMagnitude(), 0.0);
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

void HapticsGuiTest::aStateTakesThePlaceOfTheScene()
{
  makeWaveletContour();
  pressTouch();
  setStiffness(640.0);
  QTemporaryDir folder;
  pqApplicationCore* const application = pqApplicationCore::instance();
  const QString state = folder.filePath("touched.pvsm");
  const auto numberOfScenes = [&]
  {
    const QString file = folder.filePath("again.pvsm");
    application->saveState(file);
    QFile saved(file);
    return saved.open(QIODevice::ReadOnly) ? saved.readAll().count("type=\"HapticScene\"") : -1;
  };
  application->saveState(state);
  setStiffness(700.0);
  for (int i = 0; i < 2; ++i)
  {
    QVERIFY(press());
    const vtkSMProxy* const before = scene();
    pqLoadStateReaction::loadState(state, true);
    QVERIFY(waitUntil([] { return pqActiveObjects::instance().activeView() != nullptr; }));
    QVERIFY(waitUntil([] { return !touchIsDown(); }));
    QVERIFY(scene() && scene() != before);
    QVERIFY(!engaged());
    // State, panel and view speak of the same scene.
    QCOMPARE(numberOfScenes(), 1);
    QCOMPARE(vtkSMPropertyHelper(scene(), "Stiffness").GetAsDouble(), 640.0);
    QCOMPARE(find<QDoubleSpinBox>("stiffness")->value(), 640.0);
    QCOMPARE(vtkSMPropertyHelper(scene(), "View").GetAsProxy(),
      pqActiveObjects::instance().activeView()->getProxy());
    findAction("actionHapticEngage")->trigger();
    QVERIFY(engaged());
    pqUndoStack* const stack = application->getUndoStack();
    setStiffness(720.0);
    stack->undo();
    QCOMPARE(vtkSMPropertyHelper(scene(), "Stiffness").GetAsDouble(), 640.0);
    stack->redo();
    QCOMPARE(find<QDoubleSpinBox>("stiffness")->value(), 720.0);
    QCOMPARE(numberOfScenes(), 1);
  }
  setStiffness(500.0); // which other tests begin with
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

void HapticsGuiTest::undoOfTouchReleasesAndSaysWhyAsLongAsItIsSo()
{
  makeWaveletContour();
  pressTouch();
  QVERIFY(engaged());
  pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
  const auto state = [] { return find<QLabel>("state")->text(); };
  QVERIFY(press());
  QCOMPARE(stack->undoLabel(), QString("Touch"));
  stack->undo();
  QVERIFY(!isTouchable());
  QVERIFY(waitUntil([] { return !engaged(); }));
  QCOMPARE(state(), QString("Released: nothing is left to touch"));
  stack->redo();
  QVERIFY(isTouchable());
  QCOMPARE(state(), QString("Released"));
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

void HapticsGuiTest::aDeviceThatIsNotThereIsReported()
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
