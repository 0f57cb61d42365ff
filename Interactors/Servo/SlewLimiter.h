#ifndef Haptics_SlewLimiter_h
#define Haptics_SlewLimiter_h

#include "haptics/Math/Vec3.h"
#include "vtkHapticsServoModule.h"

namespace haptics
{
/// What a tick asks a SlewLimiter for, device frame.
struct SlewRequest
{
  Vec3 Force{};            ///< wanted [N]
  Vec3 Displacement{};     ///< of the god-object from the HIP [m]; zero in free space
  Vec3 Step{};             ///< of the HIP against the surface, since the last tick [m]
  double Stiffness = 0.0;  ///< behind the force [N/m]
  double Hardening = 0.0;  ///< by how much that has risen since the last tick, unpaid [N/m]
  double Reach = 0.0;      ///< by which the force may grow or turn in this tick [N]
  double SoftReach = 0.0;  ///< by which what was withheld may come back where nothing pays [N]
  double RestMotion = 0.0; ///< of a HIP that counts as at rest, at most [m]
  /// How much of the force may have come at once without the hand: surfaces or the workspace have
  /// changed [N]. Beyond SoftReach the force goes softly until it is the wanted one.
  double Change = 0.0;
  bool IsGiven = false; ///< nothing is known of the work that the hand has done for it
};

/// @brief Lets a force grow only so fast, and gives the hand no more work for it than it put in.
///
/// What is withheld acts like a wall that has given way: the spring is shorter by
/// o = withheld / K, and holds S = K (d - o)^2 / 2, d the depth of the HIP.
///
///     force
///       |     /  /
///       |    /  /      Going in faster than the limit lets the force grow, the wall gives way:
///       |   /  /       the hand puts in more than S. Going out it gets back S. What it has lost
///       |  /  /        is a credit that pays for the wall's coming back, as fast as the limit
///       | /  /         allows, to the full spring.
///       +---o------ d
///
/// So a limited force gives the hand no more on the way out than it took on the way in, and a hand
/// that bounces loses energy. (A force that grows slowly and falls at once, and no more than that,
/// makes energy: it shakes a hand.)
///
/// A hand at rest is to have its full force soon, though the credit may not be enough: to a hand
/// that is too slow for the limit to meet, what is left comes back softly. That is all that this
/// class ever gives; it keeps no motion up, since one that is met by the limit gets nothing.
///
/// What surfaces do to a hand by their own changes is their work: it comes softly, and is credited.
/// Nothing is withheld where no limit acts. Servo thread.
class VTKHAPTICSSERVO_EXPORT SlewLimiter
{
public:
  /// Forgets everything.
  void Restart() noexcept { *this = SlewLimiter(); }
  /// The device has let go of the last force: the next one grows from zero.
  void Release() noexcept { this->Last = {}; }
  /// The force [N] to ask for.
  Vec3 Limit(const SlewRequest& request) noexcept;

  /// Whether the last force was not the wanted one, or has just become it.
  bool IsLimiting() const noexcept { return this->Limiting; }
  /// Whether that is because something has changed under the hand.
  bool IsSoft() const noexcept { return this->Soft; }

private:
  void GiveBack(const SlewRequest& request, double along, double depth) noexcept;

  Vec3 Last{};           ///< the last force [N]
  double Withheld = 0.0; ///< of the wanted force, along the displacement [N]
  double Credit = 0.0;   ///< what the hand has lost to that [J]
  double Stored = 0.0;   ///< in the spring after the last tick [J]
  double Motion = 0.0;   ///< of late, the largest along the displacement in a tick [m]
  bool Soft = false;
  bool Limiting = false;
};
}

#endif
