#include "pqHapticsActions.h"

#include "RecordSource.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqHapticsExamples.h"
#include "pqHapticsForceChart.h"
#include "pqHapticsHeldKey.h"
#include "pqHapticsManager.h"
#include "pqHapticsPen.h"
#include "pqHapticsRecorder.h"
#include "pqHelpReaction.h"
#include "vtkHapticDevice.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticScene.h"
#include "vtkPVHapticReadings.h"
#include "vtkPVHapticRecords.h"
#include "vtkPVHapticScene.h"
#include "vtkPVHapticWorkspace.h"

#include <QAction>
#include <QIcon>
#include <QMainWindow>
#include <QPointer>
#include <QTimer>

#include <utility>

namespace
{
const QString TutorialPage = "qthelp://Haptics.org/Haptics/touch.html";
const QString TouchTip =
  "Touch the selected sources with a haptic device; press again to release it";
}

pqHapticsActions* pqHapticsActions::instance()
{
  static QPointer<pqHapticsActions> actions;
  if (!actions)
  {
    actions = new pqHapticsActions(pqApplicationCore::instance());
  }
  return actions;
}

pqHapticsActions::pqHapticsActions(QObject* parent)
  : Superclass(parent)
  , Manager(pqHapticsManager::instance())
{
  this->makeRunning();
  this->makeMarking();
  this->makeKeeping();
  this->makeLearning();
  // What is on while its key is held, as a brush is down while it is pressed.
  for (QAction* held : { this->Clutch, this->Paint, this->Draw })
  {
    new pqHapticsHeldKey(held);
  }
  const std::pair<QAction*, const char*> icons[] = { { this->Engage, "Engage" },
    { this->Press, "Press" }, { this->Drop, "Landmark" }, { this->Clutch, "Clutch" },
    { this->Record, "Record" } };
  for (const auto& [action, icon] : icons)
  {
    action->setIcon(QIcon(QString(":/Haptics/%1.svg").arg(icon)));
  }
  this->connect(this->Manager, &pqHapticsManager::updated, this, &pqHapticsActions::followHand);
  this->connect(
    this->Manager, &pqHapticsManager::engagedChanged, this, &pqHapticsActions::followHand);
  this->connect(
    this->Manager, &pqHapticsManager::choiceChanged, this, &pqHapticsActions::followSelection);
  this->followSelection();
  this->followHand();
}

QAction* pqHapticsActions::add(
  const char* name, const QString& text, const QKeySequence& keys, const QString& tip)
{
  auto* action = new QAction(text, this);
  action->setObjectName(name);
  action->setShortcut(keys);
  action->setAutoRepeat(false); // one press of a key is one action, however long it is held
  action->setToolTip(tip);
  action->setStatusTip(tip);
  this->Actions.append(action);
  return action;
}

void pqHapticsActions::makeRunning()
{
  pqHapticsManager* manager = this->Manager;
  // triggered(), not toggled(): only what a user does, not an action following the hand.
  this->Touch = this->add("actionTouch", "Touch", QKeySequence("Ctrl+Shift+T"), TouchTip);
  this->Touch->setIcon(QIcon(":/Haptics/Touch.svg"));
  this->Touch->setCheckable(true);
  this->connect(this->Touch, &QAction::triggered, manager,
    [this, manager](bool on)
    {
      on ? manager->touch() : manager->setEngaged(false);
      this->followSelection();
    });

  this->Engage = this->add("actionHapticEngage", "Engage", QKeySequence("Ctrl+Shift+E"),
    "Start the device on what is touchable in the active view, or release it: zero force");
  this->Engage->setCheckable(true);
  this->connect(this->Engage, &QAction::triggered, manager,
    [this, manager](bool on)
    {
      manager->setEngaged(on);
      this->followHand();
    });

  this->Press = this->add("actionHapticPress", "Press", QKeySequence("Shift+P"),
    "Let the mouse hand press, as the held space bar does, until this is chosen again");
  this->Press->setCheckable(true);
  this->connect(this->Press, &QAction::triggered, manager,
    [manager](bool on)
    {
      if (vtkHapticDevice* device = manager->viewDevice())
      {
        device->SetPressed(on);
      }
    });

  this->Clutch = this->add("actionHapticClutch", "Clutch", QKeySequence("K"),
    "While it is on, nothing is touched and the hand in the picture stays");
  this->Clutch->setCheckable(true);
  this->connect(this->Clutch, &QAction::triggered, manager,
    [manager](bool on) { manager->set("Haptic Clutch", "Clutched", on); });
}

void pqHapticsActions::makeMarking()
{
  pqHapticsManager* manager = this->Manager;
  this->Drop = this->add("actionHapticDropLandmark", "Drop Landmark", QKeySequence("L"),
    "Mark the point that is touched; the hand stays where it is");
  this->connect(
    this->Drop, &QAction::triggered, manager, [manager] { manager->command("DropLandmark"); });
  this->RemoveLast = this->add("actionHapticRemoveLandmark", "Remove Last Landmark",
    QKeySequence("Shift+L"), "Take the last landmark away");
  this->connect(this->RemoveLast, &QAction::triggered, manager,
    [manager] { manager->command("RemoveLastLandmark"); });
  this->LandmarksToSource = this->add("actionHapticLandmarksToSource", "Landmarks to Source",
    QKeySequence(), "Make a source of the landmarks, with force, normal and cell at each");
  this->connect(this->LandmarksToSource, &QAction::triggered, manager,
    [manager]
    {
      if (vtkHapticScene* hand = manager->hand())
      {
        haptics::MakeLandmarksSource(hand->GetLandmarks()->GetOutput());
      }
    });

  this->Paint = this->add("actionHapticPaint", "Paint Selection", QKeySequence("P"),
    "While it is on, or its key is held, the cells that are touched are added to ParaView's "
    "selection");
  this->Paint->setCheckable(true);
  this->SelectTouched =
    this->add("actionHapticSelectTouched", "Select Touched Cell", QKeySequence(),
      "While it is on, the cell that is touched is ParaView's selection: sources that are linked "
      "with "
      "this one, and spreadsheets that show only selected elements, follow the hand");
  this->SelectTouched->setCheckable(true);
  for (QAction* action : { this->Paint, this->SelectTouched })
  {
    QAction* other = action == this->Paint ? this->SelectTouched : this->Paint;
    this->connect(action, &QAction::triggered, other, [other] { other->setChecked(false); });
  }
  this->Draw = this->add("actionHapticDraw", "Draw Curves", QKeySequence("C"),
    "While it is on, or its key is held, each stroke becomes a curve on the surface; then a source "
    "of "
    "them, with force and data along each");
  this->Draw->setCheckable(true);
  this->connect(this->Draw, &QAction::triggered, manager->pen(), &pqHapticsPen::draw);
}

void pqHapticsActions::makeKeeping()
{
  pqHapticsManager* manager = this->Manager;
  pqHapticsRecorder* recorder = manager->recorder();
  this->Record = this->add("actionHapticRecord", "Record...", QKeySequence("Ctrl+Shift+R"),
    "Write every tick of what the device does to a file, from the next Engage until it is "
    "released; choose the file as the device to play it");
  this->Record->setCheckable(true);
  this->connect(this->Record, &QAction::triggered, recorder, &pqHapticsRecorder::arm);
  this->KeepTrace = this->add("actionHapticKeepTrace", "Keep Trace", QKeySequence(),
    "Keep every tick of the hand, up to ten minutes, for Trace to Source; begins anew each time");
  this->KeepTrace->setCheckable(true);
  this->connect(this->KeepTrace, &QAction::triggered, manager,
    [manager](bool on) { manager->set("Keep Haptic Trace", "RecordTrace", on); });
  this->TraceToSource = this->add("actionHapticTraceToSource", "Trace to Source", QKeySequence(),
    "Make a source of the way of the hand and the forces on it while Keep Trace was on");
  this->connect(this->TraceToSource, &QAction::triggered, manager,
    [manager]
    {
      if (vtkHapticScene* hand = manager->hand())
      {
        haptics::MakeTraceSource(hand->GetTrace());
      }
    });
  this->PlotForce = this->add("actionHapticPlotForce", "Plot Trace", QKeySequence(),
    "Make a source of the trace, and a line chart of the force over time next to the view");
  this->connect(this->PlotForce, &QAction::triggered, manager,
    [manager]
    {
      vtkHapticScene* hand = manager->hand();
      if (vtkSMProxy* trace = hand ? haptics::MakeTraceSource(hand->GetTrace()) : nullptr)
      {
        haptics::PlotTrace(trace);
      }
    });
  this->ForceChart = this->add("actionHapticForceChart", "Force Chart",
    QKeySequence("Ctrl+Shift+F"), "Show the force of the last ten seconds while the hand touches");
  this->ForceChart->setCheckable(true);
  this->connect(this->ForceChart, &QAction::triggered, this, &pqHapticsActions::showForceChart);
}

void pqHapticsActions::makeLearning()
{
  auto* menu = new pqHapticsExamples(this->Manager, nullptr);
  // The window is not there yet where ParaView loads the plugin as it starts.
  QTimer::singleShot(
    0, menu, [menu] { menu->setParent(pqCoreUtilities::mainWidget(), menu->windowFlags()); });
  QAction* examples = menu->menuAction();
  examples->setObjectName("actionHapticExamples");
  this->Actions.append(examples);
  this->Tutorial = new QAction("Haptics Tutorial", this);
  this->Tutorial->setObjectName("actionHapticTutorial");
  this->Tutorial->setStatusTip(
    "Touch a contour in ten minutes; and a page for each filter and property");
#ifndef HAPTICS_HAS_HELP
  this->Tutorial->setEnabled(false);
  this->Tutorial->setStatusTip(
    "This plugin was built without the tools of Qt that make help pages");
#endif
  this->connect(
    this->Tutorial, &QAction::triggered, this, [] { pqHelpReaction::showHelp(TutorialPage); });
}

/// Made when it is first asked for.
void pqHapticsActions::showForceChart(bool show)
{
  if (!this->Chart)
  {
    auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
    this->Chart = new pqHapticsForceChart(window);
    window->addDockWidget(Qt::BottomDockWidgetArea, this->Chart);
    this->connect(this->Chart, &QDockWidget::visibilityChanged, this->ForceChart,
      [this] { this->ForceChart->setChecked(!this->Chart->isHidden()); });
  }
  this->Chart->setVisible(show);
}

void pqHapticsActions::followSelection()
{
  const QString reason = this->Manager->whyNotTouch();
  const bool isTouched = this->Manager->isTouchingSelection();
  this->Touch->setChecked(isTouched);
  this->Touch->setEnabled(isTouched || reason.isEmpty());
  this->Touch->setToolTip(isTouched || reason.isEmpty() ? TouchTip : "Touch: " + reason);
}

void pqHapticsActions::followHand()
{
  vtkPVHapticScene* scene = this->Manager->clientScene();
  vtkHapticDevice* device = this->Manager->viewDevice();
  const bool isEngaged = this->Manager->isEngaged();
  const int landmarks = scene ? scene->GetRecords()->GetNumberOfLandmarks() : 0;
  this->Engage->setChecked(isEngaged);
  this->Press->setEnabled(isEngaged && device);
  this->Press->setChecked(device && device->GetPressed());
  this->Clutch->setEnabled(isEngaged);
  this->Clutch->setChecked(scene && scene->GetWorkspace()->GetClutched());
  this->Drop->setEnabled(isEngaged && scene->GetReadings()->GetTouching());
  this->RemoveLast->setEnabled(landmarks > 0);
  this->LandmarksToSource->setEnabled(landmarks > 0);
  this->Paint->setEnabled(isEngaged);
  this->SelectTouched->setEnabled(isEngaged);
  this->Draw->setEnabled(isEngaged);
  this->Draw->setChecked(this->Manager->pen()->isDrawing());
  this->Record->setChecked(this->Manager->recorder()->isArmed());
  const bool keepsTrace = scene && scene->GetRecords()->GetRecordTrace();
  this->KeepTrace->setChecked(keepsTrace);
  this->HasTrace = this->HasTrace || (keepsTrace && isEngaged);
  this->TraceToSource->setEnabled(scene && this->HasTrace);
  this->PlotForce->setEnabled(scene && this->HasTrace);
}
