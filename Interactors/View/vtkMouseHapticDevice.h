/**
 * @class   vtkMouseHapticDevice
 * @brief   touch without hardware: the mouse is the hand
 *
 * The haptic interface point (HIP) hovers over the surface under the cursor. One gesture presses:
 * - the space bar, held, presses PressDepth into the surface; moving the mouse strokes it at that
 *   depth. Let go, there is no force at once. Shift with the left mouse button does the same, for
 *   touchpads that rest while one types;
 * - the wheel, meanwhile, sets how deep. Turned alone it presses WheelStep deeper with every notch,
 *   and stays there; turned back, or after the space bar, the hand is in the air again. With Ctrl
 *   it zooms as ever.
 *
 * "Deep" is along the surface's normal, so that the force is stiffness times depth on a flat
 * surface, wherever one looks from.
 *
 * A hand in the air does not travel: it is put down at the place that the cursor shows, which lies
 * in plain view, so that it never goes through anything, nor gets behind or inside of it. Where
 * the cursor goes on behind an edge, the hand lifts and is put down there. It waits where it is
 * - while a mouse button is held, as the mouse is the camera's then, and while the camera moves;
 * - where no surface is under the cursor; what was pressed is let go, and pressed again when the
 *   cursor comes back. GetWaiting() and GetStatusMessage() report it.
 *
 * While the hand carries something (vtkHapticGrip) it moves in the plane of the view that
 * it lies in, is drawn to no surface, and goes as deep as the wheel says.
 *
 * A space bar that is held repeats itself: a release that a press follows at once is none. The
 * mouse asks its interactor for a timer for that.
 *
 * What it is not: a mouse cannot push back. The force that a haptic device would give is computed
 * all the same, at 1 kHz, and shown: as the arrow of vtkGodObjectActor, and as a bar and a number
 * by vtkHapticOverlay. The servo draws the pressing hand to the mouse's position smoothly, as an
 * arm would move, with the time constant Smoothing: 60 mouse events a second would come through as
 * steps. Where the god-object cannot follow, as at a fold, the hand gives way: it stays within 1.15
 * of the depth that was asked for, and is placed anew once that has lasted for 50 ms.
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
#include "vtkHapticsViewModule.h"
#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <array>
#include <memory>

class vtkCallbackCommand;
class vtkHapticScene;
class vtkRenderWindowInteractor;
class vtkRenderer;

class VTKHAPTICSVIEW_EXPORT vtkMouseHapticDevice : public vtkHapticDevice
{
public:
  static vtkMouseHapticDevice* New();
  vtkTypeMacro(vtkMouseHapticDevice, vtkHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  bool Open() override;
  void Close() override;
  void FindDevices(vtkStringArray* ids, vtkStringArray* states) override;
  bool GivesForce() override { return false; }
  void StartInFront() override;
  bool UsesView() override { return true; }
  bool HasView() override;
  void ConnectView(vtkRenderWindowInteractor* interactor, vtkHapticScene* scene) override;

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
  /**
   * The renderer whose surfaces the mouse touches; over another one, as over another subplot, the
   * hand waits. Null, the default: whichever is under the cursor. Not kept alive.
   */
  void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /** How much deeper a notch of the wheel presses, device frame [m]. Default 0.001; 1e-6 to 0.05.
   */
  vtkSetClampMacro(WheelStep, double, 1e-6, 0.05);
  vtkGetMacro(WheelStep, double);
  ///@}
  ///@{
  /**
   * How deep the space bar presses, device frame [m]; the wheel changes it while it is held.
   * Default 0.003; 1e-6 to 0.05.
   */
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
   * place and do nothing where the interactor or the scene is missing. What SetPressed() begins
   * stays while the mouse is outside of the window; what a held key or button begins ends there.
   */
  void MoveTo(int x, int y);
  void Turn(int notches);
  void SetPressed(bool pressed) override;
  bool GetPressed() override { return this->Pressed; }
  ///@}
  /** Whether the hand waits: there is no surface under the cursor, or the camera is being moved. */
  vtkGetMacro(Waiting, bool);
  /** What the hand waits for, in plain words; empty where it does not. */
  const char* GetStatusMessage() const override;

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
  struct Place;

  static void OnEvent(vtkObject* caller, unsigned long event, void* clientData, void* callData);
  bool IsInUse();
  bool Handle(unsigned long event, void* callData);
  void HandleTimer(void* callData);
  bool HandleButton(unsigned long event);
  static void OnPassiveEvent(
    vtkObject* caller, unsigned long event, void* clientData, void* callData);
  void HandleSpace(bool down);
  void ForgetRelease();
  bool IsCarrying();
  bool Look(View& view);
  bool IsElsewhere();
  bool Find(const View& view);
  void Follow(bool mustPlace);
  void Carry(const View& view, double change);
  bool IsSmooth(const View& view, const Place& before);
  void Press(bool isPlaced);
  void Deepen(double depth);
  void WatchContact();
  bool IsHidden(const View& view, const double place[3]);
  double PressingDepth();
  double Scale();
  void ToDevice(const double world[3], double device[3]);
  void Want(const double world[3], const double* place);
  void MoveHand(const double target[3]);
  double MostDepth();

  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  vtkWeakPointer<vtkHapticScene> Scene;
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkNew<vtkCallbackCommand> Callback;
  vtkNew<vtkCallbackCommand> PassiveCallback;
  std::shared_ptr<MouseChannel> Mouse;
  std::array<double, 3> Target{ { 0.0, 0.0, 0.05 } };
  int Cursor[2] = { 0, 0 };
  bool Pressed = false;
  bool IsHeld = false; ///< Pressed, by a key or button that is held
  bool Waiting = false;
  bool IsPressing = false;              ///< the hand is to be in the surface
  bool ShiftPresses = false;            ///< the left button does, with Shift
  unsigned int ButtonsHeld = 0;         ///< of the mouse, for the camera: a bit each
  int ReleaseTimer = 0;                 ///< runs out where the space bar was really let go
  int TimerThatRanOut = 0;              ///< just now
  double WheelDepth = 0.0;              ///< that the wheel alone has pressed [m], device frame
  double Hover[3] = { 0.0, 0.0, 0.0 };  ///< over the surface where the cursor was last [world unit]
  double Hit[3] = { 0.0, 0.0, 0.0 };    ///< that place of the surface
  double Normal[3] = { 0.0, 0.0, 1.0 }; ///< there, towards the viewer
  int FoundAt[2] = { 0, 0 };            ///< the cursor then
  vtkMTimeType LookedAt = 0;            ///< the camera's time then
  double Pixel = 0.0;                   ///< its width there [world unit]
  double Extra = 0.0;       ///< deeper than asked for, where the surface yields [world unit]
  double AstraySince = 0.0; ///< [s] the hand has not been where the cursor is; 0: it is there
  double WheelStep = 0.001;
  double PressDepth = 0.003;
  double Smoothing = 0.012;
};

#endif
