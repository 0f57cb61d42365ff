/**
 * @class   pqHapticsManager
 * @brief   What panel and toolbar have in common: the scene of the session and its hand.
 *
 * There is one hand, so there is one scene proxy (group "haptics", name "HapticScene") a session.
 * It is made when it is first needed; one that a state file or a script has registered is taken.
 * This class edits that proxy and never touches VTK objects but to read the state of the hand.
 *
 * The scene follows ParaView: its surfaces are the touchable representations of its view, and its
 * view is the active one, where that shows such a surface. The proxy itself sees to
 * it that the hand is released when the view is closed or the server goes away.
 *
 * While the hand is engaged, a device is being opened or a surface is being built, one timer looks
 * at the scene at most 60 times a second and renders where a picture would differ: at ParaView's
 * level of detail while the hand moves, in full when it rests. At other times nothing runs. Nothing
 * here waits or runs an event loop. GUI thread.
 *
 * Errors: a message box says what a user asked for and cannot have; what goes wrong later is
 * in ParaView's output window and in the panel.
 */
#ifndef Haptics_pqHapticsManager_h
#define Haptics_pqHapticsManager_h

#include "vtkWeakPointer.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QString>
#include <QTimer>

class pqHapticsPen;
class pqHapticsRecorder;
class pqOutputPort;
class pqUndoStack;
class pqView;
class QWidget;
class vtkHapticScene;
class vtkHapticDevice;
class vtkPVHapticScene;
class vtkSMProxy;
class vtkSMViewProxy;

class pqHapticsManager : public QObject
{
  Q_OBJECT
  using Superclass = QObject;

public:
  /** The one of this application; made by the first call. */
  static pqHapticsManager* instance();
  ~pqHapticsManager() override = default;

  /** The scene proxy of the active server; null while there is none. */
  vtkSMProxy* scene() const;
  /** The same, made where there is none; null without a server. */
  vtkSMProxy* makeScene();
  /** What has the values of scene(), or where there is none those that Touch begins with; null
   * without a server. */
  vtkSMProxy* values() const;
  ///@{
  /** What the proxy drives, to read from; null where scene() is. */
  vtkPVHapticScene* clientScene() const;
  vtkHapticScene* hand() const;
  ///@}

  /** The device, where the mouse and keys of a view move it; else null. */
  vtkHapticDevice* viewDevice() const;
  /** Never null. */
  pqHapticsRecorder* recorder() const { return this->Recorder; }
  /** Never null. */
  pqHapticsPen* pen() const { return this->Pen; }
  /** What shows the touched view, and has its keys; null where there is none. */
  QWidget* viewWidget() const;
  /** What is touched just now; null in free space. */
  pqOutputPort* touchedPort() const;

  /** Why what is selected cannot be touched in the active view; empty where it can. */
  QString whyNotTouch() const;
  /** Whether all that is selected is touched. */
  bool isTouchingSelection() const;

  /** Whether the hand is engaged, as of the last look at the scene. */
  bool isEngaged() const { return this->Engaged; }

  /** The device used last, as the proxy names it: "mouse" where there was none. */
  QString device() const;

  /** Looks at the scene this often at most [1/s]. */
  static constexpr int MaximumRate = 60;

public Q_SLOTS:
  /**
   * Makes the selected sources touchable in the active view, fits the workspace to them and engages
   * the device; adds them where it is engaged. Undo makes them untouchable again. Where that is not
   * possible nothing changes, and a message box says why.
   */
  void touch();
  /** Engages the hand on what is touchable in the active view, or releases it. */
  void setEngaged(bool engaged);
  /** Takes another device, by the name that the proxy has for it; releases the hand first. */
  void setDevice(const QString& device);
  /** Maps the device's workspace to the surfaces as the camera sees them. */
  void fit();
  /** Sets a property of the scene, which is made where there is none; undo knows it as `what`. */
  void set(const char* what, const char* property, double value);
  /** The same for what goes on while the hand is engaged: there is nothing to undo. */
  void setForNow(const char* property, int value);
  /** Runs a command of the scene, then shows what came of it. */
  void command(const char* property);
  /** Looks at the scene now. */
  void poll();
  /** Gives the keyboard to the touched view. */
  void focusView();
  /** Draws the views that show the hand, for what is drawn otherwise than before. */
  void redraw();
  /** Shows what cannot be done and what to do instead, in a message box that is not modal. */
  void complain(const QString& title, const QString& message);

Q_SIGNALS:
  /** scene() is another one, or none, or what it will begin with has changed. */
  void sceneChanged();
  void engagedChanged(bool engaged);
  /** The state of the scene may have changed. */
  void updated();
  /** What is selected, or whether it can be touched, may have changed. */
  void choiceChanged();

private:
  Q_DISABLE_COPY(pqHapticsManager)
  explicit pqHapticsManager(QObject* parent);

  void followUndo(pqUndoStack* stack);
  void adoptScene(vtkSMProxy* proxy);
  void findScene();
  bool followActiveView();
  bool look();
  int followSurfaces();
  void engage(const QString& title, bool anew, bool isDrawn);
  bool hasWork() const;
  void noticeState();
  void proveAsked();
  int numberOfLandmarks() const;
  void keepLandmarks();
  bool show(pqOutputPort* port, pqView* view, QString& problem);
  void bringSurfaces(bool isDrawn);
  void draw();
  void drawAll(vtkSMViewProxy* view);

  vtkWeakPointer<vtkSMProxy> Scene;
  vtkWeakPointer<vtkSMProxy> Begin; // whose changes are followed, see values()
  QPointer<pqView> View;
  pqHapticsRecorder* Recorder;
  pqHapticsPen* Pen;
  QTimer Timer{ this };
  QTimer Resting{ this }; // until the picture is drawn in full
  QElapsedTimer Drawn;    // since the last picture
  qint64 DrawingTime = 0; // that it took [ms]
  bool Engaged = false;
  int Landmarks = 0; // that undo knows of
  QString Asked;     // title of what the user asked for last, until it is seen to hold
};

#endif
