/**
 * @class   vtkMouseHapticDevice
 * @brief   touch without hardware: the mouse is the hand
 *
 * The mouse moves the haptic interface point (HIP) in the plane of the view that it lies in, so
 * that it stays under the cursor. What moves it towards the surface and into it:
 * - the wheel: the first notch goes down to the surface under the cursor, every further one presses
 *   WheelStep deeper; turned back it lifts in the same steps. With Ctrl held it zooms as ever;
 * - the space bar, held: presses PressDepth into the surface under the cursor and follows the
 *   surface while the mouse moves: a stroke. Let go, the hand lifts off.
 *
 * While the hand carries something (vtkHapticScene::Grip()) it is drawn to no surface, and goes as
 * deep as the wheel says.
 *
 * A space bar that is held repeats itself: a release that a press follows at once is none. The
 * mouse asks its interactor for a timer for that.
 *
 * While a mouse button is held the mouse belongs to the camera, and the hand stays.
 *
 * What it is not: a mouse cannot push back. The force that a haptic device would give is computed
 * all the same, at 1 kHz, and shown: as the arrow of vtkGodObjectActor, and as a bar and a number
 * by vtkHapticOverlay. The servo draws the hand to the mouse's position smoothly, as an arm would
 * move, with the time constant Smoothing: 60 mouse events a second would be felt as steps.
 *
 * vtkInteractorStyleHaptic connects it where it is the device of its scene. Without one, call
 * SetInteractor() and SetScene().
 *
 * Device frame: x right, y up, z towards the viewer, as vtkHapticScene::FitWorkspace() maps it [m].
 * Opening never fails. GUI thread.
 *
 * @sa vtkHapticScene vtkHapticOverlay vtkInteractorStyleHaptic
 */
#ifndef Haptics_vtkMouseHapticDevice_h
#define Haptics_vtkMouseHapticDevice_h

#include "vtkHapticDevice.h"
#include "vtkHapticsInteractorsModule.h"
#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <array>
#include <memory>

class vtkCallbackCommand;
class vtkHapticScene;
class vtkRenderWindowInteractor;
class vtkRenderer;

class VTKHAPTICSINTERACTORS_EXPORT vtkMouseHapticDevice : public vtkHapticDevice
{
public:
  static vtkMouseHapticDevice* New();
  vtkTypeMacro(vtkMouseHapticDevice, vtkHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  bool Open() override;
  void Close() override;

  ///@{
  /** Whose mouse and keys move the hand; null by default. Not kept alive. */
  void SetInteractor(vtkRenderWindowInteractor* interactor);
  vtkRenderWindowInteractor* GetInteractor();
  ///@}

  ///@{
  /** The scene that the hand touches, for its frame and surfaces; null by default. Not kept alive.
   */
  void SetScene(vtkHapticScene* scene);
  vtkHapticScene* GetScene();
  ///@}

  ///@{
  /** How deep a notch of the wheel presses, device frame [m]. Default 0.001; 1e-6 to 0.05. */
  vtkSetClampMacro(WheelStep, double, 1e-6, 0.05);
  vtkGetMacro(WheelStep, double);
  ///@}
  ///@{
  /** How deep the space bar presses, device frame [m]. Default 0.003; 1e-6 to 0.05. */
  vtkSetClampMacro(PressDepth, double, 1e-6, 0.05);
  vtkGetMacro(PressDepth, double);
  ///@}
  ///@{
  /**
   * Time constant with which the hand comes to where the mouse says [s]. Default 0.012; 0 (at once)
   * to 1. Read by Open().
   */
  vtkSetClampMacro(Smoothing, double, 0.0, 1.0);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * What mouse, wheel and space bar do, for scripts. MoveTo() takes a place in the window [pixel,
   * from the lower left]; Turn() notches of the wheel, forwards > 0; both use the renderer at that
   * place and do nothing where the interactor or the scene is missing.
   */
  void MoveTo(int x, int y);
  void Turn(int notches);
  void SetPressed(bool pressed);
  vtkGetMacro(Pressed, bool);
  ///@}

  ///@{
  /** Where the hand is drawn to, device frame [m]. Default the front of the workspace's middle. */
  void SetTarget(double x, double y, double z);
  void GetTarget(double target[3]);
  ///@}

protected:
  vtkMouseHapticDevice();
  ~vtkMouseHapticDevice() override;

private:
  vtkMouseHapticDevice(const vtkMouseHapticDevice&) = delete;
  void operator=(const vtkMouseHapticDevice&) = delete;

  class MouseChannel;
  struct View;

  static void OnEvent(vtkObject* caller, unsigned long event, void* clientData, void* callData);
  bool IsInUse();
  bool Handle(unsigned long event, void* callData);
  void HandleSpace(bool down);
  void ForgetRelease();
  bool Look(View& view);
  void MoveWithin(const View& view, double depth);
  double Scale();
  double DepthOfTarget(const View& view);
  bool DepthOfSurface(const View& view, double& depth);

  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  vtkWeakPointer<vtkHapticScene> Scene;
  vtkNew<vtkCallbackCommand> Callback;
  std::shared_ptr<MouseChannel> Mouse;
  std::array<double, 3> Target{ { 0.0, 0.0, 0.05 } };
  int Cursor[2] = { 0, 0 };
  bool Pressed = false;
  int ReleaseTimer = 0; ///< runs out where the space bar was really let go
  double WheelStep = 0.001;
  double PressDepth = 0.003;
  double Smoothing = 0.012;
};

#endif
