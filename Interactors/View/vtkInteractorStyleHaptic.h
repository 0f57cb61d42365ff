/**
 * @class   vtkInteractorStyleHaptic
 * @brief   The trackball camera, that keeps a haptic scene up to date.
 *
 * Mouse and keys move the camera as in vtkInteractorStyleTrackballCamera. A repeating timer, at up
 * to MaximumFrameRate, updates the scene and renders where something has changed; nothing is
 * rendered while nothing moves. The scene does the work: this class only calls it.
 *
 * More keys:
 * - h: engage the haptic scene, or release it; the first time the device's workspace is fitted to
 *   the view, unless the scene has one already
 * - v: map the device's workspace to the surfaces as the camera sees them
 * - b: show or hide the trail behind the god-object
 * - d, z: drop a landmark, take the last one away
 * - c: the clutch
 * - x: grip what is touched and carry it, let it go
 * - +, -: scale the workspace about the hand
 * - 0: undo what scaling and clutching have done to the workspace
 * - o: see the hand through the surface or not
 * - t: highlight the triangles touched
 * - g: colour the force by its strength, with a legend
 * - ? or F1: show or hide the list of all keys
 * - q, e: end, as the window's close button and Ctrl-C do
 *
 * Keys are taken as they are typed on US, British, German, French, Italian, Spanish and Nordic
 * keyboards and on keypads, whatever VTK reports of them: on X11 before VTK 9.4 it reports keys as
 * they are without Shift.
 *
 * Where the scene's overlay is in the picture it says what the hand does (touching, waiting,
 * clutched, released, preparing), for a while what a key did that is not seen at once, and why one
 * did nothing; with a mouse also how to begin, until the first touch.
 *
 * A vtkMouseHapticDevice that is the scene's device is connected to the interactor; it takes the
 * wheel and the space bar for itself while it is open.
 *
 * When the interactor exits (the keys q and e, or its window is closed) the scene is released, so
 * that no force stays on a device whose window is gone, and the event loop ends: Start() returns.
 * Observers of ExitEvent with a higher priority than the style's come before that, while the window
 * is still there. SIGINT (Ctrl-C in the terminal) does the same while the event loop runs, and
 * GetInterrupted() returns true; a C++ program ends with
 * `return style->GetInterrupted() ? 130 : 0;`.
 *
 * Smoothness: the style draws what it or the camera has changed at the next tick of its timer, so
 * that no event waits for more than one picture, and rests between pictures where they take long.
 * GUI thread.
 *
 * @sa vtkHapticScene
 */
#ifndef Haptics_vtkInteractorStyleHaptic_h
#define Haptics_vtkInteractorStyleHaptic_h

#include "vtkHapticsViewModule.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <string>

class vtkCallbackCommand;
class vtkHapticScene;
class vtkHapticView;

class VTKHAPTICSVIEW_EXPORT vtkInteractorStyleHaptic : public vtkInteractorStyleTrackballCamera
{
public:
  static vtkInteractorStyleHaptic* New();
  vtkTypeMacro(vtkInteractorStyleHaptic, vtkInteractorStyleTrackballCamera);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene that is kept up to date; by default one of its own, so never null. Null gives it a
   * new one.
   */
  void SetScene(vtkHapticScene* scene);
  vtkHapticScene* GetScene();
  ///@}
  /** Shows the scene; its props are the caller's to add to a renderer. Never null. */
  vtkHapticView* GetView();

  ///@{
  /**
   * How often the scene is looked at, and rendered where it has changed, at most [1/s]. Default 60;
   * 1 to 240. A change takes effect at once.
   */
  void SetMaximumFrameRate(double rate);
  vtkGetMacro(MaximumFrameRate, double);
  ///@}

  /** Updates the scene; renders and returns true where anything changed. The timer calls it. */
  bool UpdateScene();

  /** The id of the repeating timer of the interactor; 0 while there is none. */
  vtkGetMacro(TimerId, int);
  /** Whether SIGINT (Ctrl-C) has ended the event loop. */
  vtkGetMacro(Interrupted, bool);
  /** Renders that UpdateScene() has asked for. */
  vtkGetMacro(NumberOfRenders, vtkIdType);

  ///@{
  /** The protocol of vtkInteractorStyle. */
  void SetInteractor(vtkRenderWindowInteractor* interactor) override;
  void OnChar() override;
  void OnMouseMove() override;
  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;
  void OnMiddleButtonDown() override;
  void OnMiddleButtonUp() override;
  void OnRightButtonDown() override;
  void OnRightButtonUp() override;
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;
  ///@}

protected:
  vtkInteractorStyleHaptic();
  ~vtkInteractorStyleHaptic() override;

private:
  vtkInteractorStyleHaptic(const vtkInteractorStyleHaptic&) = delete;
  void operator=(const vtkInteractorStyleHaptic&) = delete;

  static void OnInteractorEvent(
    vtkObject* caller, unsigned long event, void* clientData, void* callData);
  static void OnClippingRangeReset(
    vtkObject* caller, unsigned long event, void* clientData, void* callData);
  void ConnectDevice();
  void Exit();
  void RenderSoon();
  void Engage();
  void DropLandmark();
  void Refuse(const std::string& reason);
  void Notify(const std::string& what);
  void ShowStatus();
  std::string DescribeState();
  void ToggleGrip();
  void ToggleHelp();
  void ToggleLook(char key);
  void ToggleTrail();
  void FitWorkspace();
  void ScaleWorkspace(double factor);
  void Render(vtkRenderer* renderer);
  template <typename Function>
  void DrawLater(Function handle);
  void StartUpdateTimer();
  void StopUpdateTimer();
  vtkRenderer* FindRenderer();
  void Watch(vtkRenderer* renderer);

  vtkSmartPointer<vtkHapticScene> Scene;
  vtkNew<vtkHapticView> View;
  vtkNew<vtkCallbackCommand> InteractorCallback;
  vtkNew<vtkCallbackCommand> ClippingRangeCallback;
  vtkWeakPointer<vtkRenderer> WatchedRenderer;
  double MaximumFrameRate = 60.0;
  int TimerId = 0;
  int SleepingTimerId = 0; ///< after the event loop has ended
  bool StartingTimer = false;
  bool MustRender = false;
  bool HasTouched = false;   ///< the hint is not needed any more
  std::string Notice;        ///< what the last key did, or why it did nothing
  double NoticedUntil = 0.0; ///< [s] that is shown
  vtkMTimeType ShownOverlay = 0;
  bool Interrupted = false;
  std::uint32_t InterruptsBefore = 0;
  double RestsUntil = 0.0; ///< no picture before [s], vtkTimerLog's universal time
  vtkIdType NumberOfRenders = 0;
};

#endif
