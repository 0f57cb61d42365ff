/**
 * @class   vtkHapticGrip
 * @brief   What the hand of a vtkHapticScene carries: a surface whose actor goes along with it.
 *
 * The hand holds the surface by the point where the god-object is. Its actor, or the part of an
 * assembly, goes where the god-object goes at each vtkHapticScene::Update() or Step(): the device
 * has no more than three degrees of freedom, so nothing turns. All else is touched as ever, and
 * holds hand and part back: a point collides, not the part. What is carried is not touched, and
 * free of all else there is no force on the hand.
 *
 * Let go, it is touched again from where it is, with the hand on the side where it was. The scene
 * lets go by itself where the surface is hidden or removed, the clutch is pressed, another is
 * gripped or the servo stops. Gripping and letting go take effect at once, and are events of the
 * scene: vtkHapticScene::GripEvent and LetGoEvent.
 *
 * Of the actor its position is changed, in whatever frame its user matrix or its assembly puts it;
 * to undo a move set the position that it had at GripEvent.
 *
 * A scene hands one out by vtkHapticScene::GetGrip(). One that no scene has, or whose scene is
 * gone, finds nothing to grip.
 *
 * Errors go through vtkErrorMacro and to GetErrorMessage(), and are errors of the scene too.
 *
 * GUI thread.
 *
 * @sa vtkHapticScene
 */
#ifndef Haptics_vtkHapticGrip_h
#define Haptics_vtkHapticGrip_h

#include "vtkHapticsSceneModule.h"
#include "vtkObject.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>

namespace haptics
{
class CarriedSurface;
class GrippingHand;
struct TickRecord;
}

class VTKHAPTICSSCENE_EXPORT vtkHapticGrip : public vtkObject
{
public:
  static vtkHapticGrip* New();
  vtkTypeMacro(vtkHapticGrip, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Grips the surface that is touched, or the one with this id, touched or not; what was gripped
   * before is let go. False and an error where nothing is touched, there is no such surface, or it
   * has no actor, is hidden, or no hand is there: released, or clutched.
   */
  bool Take();
  bool TakeSurface(int id);
  ///@}
  /** Lets go; does nothing where nothing is gripped. */
  void LetGo();
  /** The id of the surface that the hand carries; -1 for none. */
  int GetSurface();

  ///@{
  /**
   * The device's button that grips what is touched while it is held. Default 2; -1 for none, at
   * most 31. Of a surface without an actor it is a warning, once for each.
   */
  vtkSetClampMacro(Button, int, -1, 31);
  vtkGetMacro(Button, int);
  ///@}

  /** What went wrong last; empty after a call that succeeded. */
  const char* GetErrorMessage() { return this->ErrorMessage.c_str(); }

#ifndef __VTK_WRAP__
  ///@{
  /**
   * For the scene, C++ only: its hand (null when that is gone); each tick, in turn; the number of
   * each god-object that is published; the device's buttons after each update.
   */
  void SetHand(haptics::GrippingHand* hand);
  void OnTick(const haptics::TickRecord& tick);
  void OnPublished(std::uint64_t generation);
  void OnButtons(unsigned int buttons);
  /** Moves the actor to where the hand has it; true where it has moved. */
  bool Carry();
  /** Lets go of what cannot be touched any more; its id, or -1 where that is not so. */
  int ReleaseMissing();
  ///@}
#endif

protected:
  vtkHapticGrip();
  ~vtkHapticGrip() override;

private:
  vtkHapticGrip(const vtkHapticGrip&) = delete;
  void operator=(const vtkHapticGrip&) = delete;

  bool Fail(const std::string& message);

  haptics::GrippingHand* Hand = nullptr;
  std::unique_ptr<haptics::CarriedSurface> Object;
  int Button = 2;
  bool IsButtonHeld = false;
  std::set<int> WarnedOf; // surfaces without an actor, for which a button cannot grip
  std::string ErrorMessage;
};

#endif
