/**
 * @class   vtkHapticWorkspace
 * @brief   Where the reach of a haptic device lies in the world: transform, fit, scale, clutch.
 *
 * A scene hands one out by vtkHapticScene::GetWorkspace(). It moves the reach of the device of that
 * scene's servo; one that no scene has keeps its transform, moves nothing, and has no device to be
 * fitted to.
 *
 * Frames: the transform maps the device frame [m] to the world frame [world unit].
 *
 * Errors go through vtkErrorMacro and to GetErrorMessage(), and are errors of the scene too.
 *
 * GUI thread; the servo acts on each change at its next tick.
 *
 * @sa vtkHapticScene vtkHapticServo
 */
#ifndef Haptics_vtkHapticWorkspace_h
#define Haptics_vtkHapticWorkspace_h

#include "vtkCommand.h"
#include "vtkHapticsSceneModule.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <string>

class vtkCamera;
class vtkHapticServo;
class vtkMatrix4x4;

class VTKHAPTICSSCENE_EXPORT vtkHapticWorkspace : public vtkObject
{
public:
  static vtkHapticWorkspace* New();
  vtkTypeMacro(vtkHapticWorkspace, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Invoked after the clutch was pressed or let go. No call data.
  enum WorkspaceEvents
  {
    ClutchEvent = vtkCommand::UserEvent + 4400
  };

  ///@{
  /**
   * Device to world: rotation, uniform scale [world unit/m], translation. Default the identity: a
   * world unit is a metre in the hand; with SetUnitLength() the true size. False and an error where
   * the matrix is anything else (a mirror, a shear, not finite, null); the last one stays. The
   * god-object starts anew at the HIP, so that no force jumps. The matrix returned is not to be
   * changed.
   */
  bool SetTransform(vtkMatrix4x4* deviceToWorld);
  vtkMatrix4x4* GetTransform();
  ///@}
  ///@{
  /**
   * Length of a world unit [m]: 0.001 for surfaces in millimetres. A transform that was never set
   * nor fitted becomes that of the true size: 1000 world units a metre for 0.001. The scene hands
   * it on to its trace and its landmarks, as the unit of their lengths. Default 0: not known, and
   * as if 1. Range 1e-100 to 1e100; anything else is an error, and the last one stays.
   */
  void SetUnitLength(double metres);
  vtkGetMacro(UnitLength, double);
  ///@}
  /** How long a metre in the hand is in the world [world unit/m]; 1 by default. */
  double GetScale();
  /** Whether the transform was ever set or fitted; scaling and clutching do not count. */
  vtkGetMacro(Chosen, bool);

  /**
   * Maps what the device reaches to a box (xmin, xmax, ymin, ymax, zmin, zmax) in the world frame,
   * as small as holds it. The device's x, y, z axes become the camera's right, up and towards the
   * viewer, or the world's axes without a camera. False and an error where the box is not finite or
   * has no extent, or there is no device. vtkHapticScene::FitWorkspace() fits it to the surfaces.
   */
  bool Fit(const double bounds[6], vtkCamera* camera = nullptr);
  /**
   * Magnifies what the device reaches about the god-object: with a factor of 2 a movement goes
   * twice as far in the world. A contact stays, with its force. Before the first tick it is about
   * the origin of the device frame. False and an error where the factor is not finite and > 0.
   */
  bool Scale(double factor);
  /**
   * Puts the transform back to where it was set or fitted last, or to its default, and takes the
   * clutch off: what scaling and clutching have moved since is forgotten.
   */
  void Reset();

  ///@{
  /**
   * The clutch: while it is on nothing is touched, no force is asked for, and the hand in the
   * picture stays, so that the device can be moved back into the middle of its reach; a surface
   * that moves pushes it along. When it is let go the hand goes on from there. Default off.
   */
  void SetClutched(bool clutched);
  vtkGetMacro(Clutched, bool);
  ///@}
  ///@{
  /** The device's button that is the clutch while it is held. Default 1; -1 for none, at most 31.
   */
  vtkSetClampMacro(ClutchButton, int, -1, 31);
  vtkGetMacro(ClutchButton, int);
  ///@}

  /**
   * What went wrong last; empty after a call that succeeded.
   */
  const char* GetErrorMessage() { return this->ErrorMessage.c_str(); }

#ifndef __VTK_WRAP__
  ///@{
  /** For the scene, C++ only: whose device it is, and that device's buttons after each update. */
  void SetServo(vtkHapticServo* servo);
  void OnButtons(unsigned int buttons);
  ///@}
#endif

protected:
  vtkHapticWorkspace();
  ~vtkHapticWorkspace() override;

private:
  vtkHapticWorkspace(const vtkHapticWorkspace&) = delete;
  void operator=(const vtkHapticWorkspace&) = delete;

  bool Fail(const std::string& message);
  bool Move(vtkMatrix4x4* deviceToWorld);

  vtkSmartPointer<vtkHapticServo> Servo;
  vtkNew<vtkMatrix4x4> Transform;
  vtkNew<vtkMatrix4x4> Home; // as it was set or fitted last
  double UnitLength = 0.0;
  bool Chosen = false;
  bool Clutched = false;
  int ClutchButton = 1;
  bool IsButtonHeld = false;
  std::string ErrorMessage;
};

#endif
