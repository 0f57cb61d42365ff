/**
 * @class   vtkInteractorStyleHaptic
 * @brief   The trackball camera, with a haptic scene kept alive beside it.
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
 * - ?: show or hide the list of all keys
 *
 * A vtkMouseHapticDevice that is the scene's device is connected to the interactor; it takes the
 * wheel and the space bar for itself while it is open.
 *
 * When the interactor exits (the key q, or its window is closed) the scene is released: no force
 * stays on a device whose window is gone. GUI thread.
 *
 * @sa vtkHapticScene
 */
#ifndef vtkInteractorStyleHaptic_h
#define vtkInteractorStyleHaptic_h

#include "vtkHapticsInteractorsModule.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

class vtkCallbackCommand;
class vtkHapticScene;

class VTKHAPTICSINTERACTORS_EXPORT vtkInteractorStyleHaptic
  : public vtkInteractorStyleTrackballCamera
{
public:
  static vtkInteractorStyleHaptic* New();
  vtkTypeMacro(vtkInteractorStyleHaptic, vtkInteractorStyleTrackballCamera);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene that is kept up to date; by default one of its own, so never null. Null gives it a
   * new one. Its GetGodObjectActor() is the caller's to add to a renderer.
   */
  void SetScene(vtkHapticScene* scene);
  vtkHapticScene* GetScene();
  ///@}

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
  /** Renders that UpdateScene() has asked for. */
  vtkGetMacro(NumberOfRenders, vtkIdType);

  ///@{
  /** The protocol of vtkInteractorStyle. */
  void SetInteractor(vtkRenderWindowInteractor* interactor) override;
  void OnChar() override;
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
  void ConnectMouse();
  void ToggleHelp();
  void ToggleLook(char key);
  void StartTimer();
  void StopTimer();
  vtkRenderer* FindRenderer();
  void Watch(vtkRenderer* renderer);

  vtkSmartPointer<vtkHapticScene> Scene;
  vtkNew<vtkCallbackCommand> InteractorCallback;
  vtkNew<vtkCallbackCommand> ClippingRangeCallback;
  vtkWeakPointer<vtkRenderer> WatchedRenderer;
  double MaximumFrameRate = 60.0;
  int TimerId = 0;
  bool StartingTimer = false;
  vtkIdType NumberOfRenders = 0;
};

#endif
