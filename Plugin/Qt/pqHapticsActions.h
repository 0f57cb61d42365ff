/**
 * @class   pqHapticsActions
 * @brief   What a user does with the hand, as actions: in the menus Haptics and Help, and in the
 * toolbar.
 *
 * All of them are in the menu bar, so that ParaView's Customize Shortcuts lists them. An action is
 * disabled where it could do nothing; its tool tip says why then. GUI thread.
 *
 * @sa pqHapticsManager pqHapticsToolBar pqHapticsMenu
 */
#ifndef Haptics_pqHapticsActions_h
#define Haptics_pqHapticsActions_h

#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QPointer>

class QAction;
class pqHapticsForceChart;
class pqHapticsManager;

class pqHapticsActions : public QObject
{
  Q_OBJECT
  using Superclass = QObject;

public:
  /** The one of this application; made by the first call. */
  static pqHapticsActions* instance();
  ~pqHapticsActions() override = default;

  /** All of them, in the order of the menu. */
  QList<QAction*> all() const { return this->Actions; }
  /** What the hand does at once, each with an icon. */
  QList<QAction*> ofToolBar() const
  {
    return { this->Touch, this->Engage, this->Press, this->Drop, this->Clutch, this->Record };
  }
  /** Not one of all(): it belongs into the menu Help. */
  QAction* tutorial() const { return this->Tutorial; }
  QAction* paint() const { return this->Paint; }
  QAction* selectTouched() const { return this->SelectTouched; }

private Q_SLOTS:
  void followHand();
  void followSelection();

private:
  Q_DISABLE_COPY(pqHapticsActions)
  explicit pqHapticsActions(QObject* parent);

  QAction* add(const char* name, const QString& text, const QKeySequence& keys, const QString& tip);
  void makeRunning();
  void makeMarking();
  void makeKeeping();
  void makeLearning();
  void showForceChart(bool show);

  pqHapticsManager* Manager;
  bool HasTrace = false; // something was kept
  QPointer<pqHapticsForceChart> Chart;
  QList<QAction*> Actions;
  QAction* Touch = nullptr;
  QAction* Engage = nullptr;
  QAction* Press = nullptr;
  QAction* Clutch = nullptr;
  QAction* Drop = nullptr;
  QAction* RemoveLast = nullptr;
  QAction* LandmarksToSource = nullptr;
  QAction* Paint = nullptr;
  QAction* SelectTouched = nullptr;
  QAction* Draw = nullptr;
  QAction* Record = nullptr;
  QAction* KeepTrace = nullptr;
  QAction* TraceToSource = nullptr;
  QAction* PlotForce = nullptr;
  QAction* ForceChart = nullptr;
  QAction* Tutorial = nullptr;
};

#endif
