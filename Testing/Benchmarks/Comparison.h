#ifndef Haptics_Comparison_h
#define Haptics_Comparison_h

#include "ContactMethod.h"
#include "haptics/Surface/TriangleSurface.h"

#include <functional>
#include <memory>
#include <vector>

namespace haptics::testing
{
/// A way of the HIP over a surface and where the god-object has to be: the oracle's answer, the
/// constrained gradient flow (Oracle.h), worked out once for all methods.
struct Stroke
{
  std::shared_ptr<const TriangleSurface> Surface; ///< Front, at the origin's frame
  std::vector<Vec3> Hips;
  std::vector<Vec3> Right;
  /// Whether the tick counts: the oracle presses by more than 0.2 mm (0.1 N at 500 N/m, so that a
  /// direction means something) and is not slipping off, which happens at no speed in particular.
  std::vector<char> Counts;
};

Stroke MakeReference(const TriangleMesh& mesh, std::vector<Vec3> hips);

/// What was measured in the ticks that count.
struct Samples
{
  long Contacts = 0;
  /// Times that contact was lost: the point lies more than 0.2 um inside the surface (exact
  /// parity), or there is no force, or one against the oracle's. The point is then put back.
  long Leaks = 0;
  long Singular = 0;
  std::vector<double> Position;  ///< E_p [m]
  std::vector<double> Direction; ///< E_theta [deg]
  std::vector<double> Magnitude; ///< E_F, 1: all of the force
  std::vector<double> Times;     ///< of every tick, contact or not [us]

  void Add(const Samples& other);
};

/// Counts a tick in contact: where the point is held and where it should be.
void AddSample(Samples& samples, const Vec3& hip, const Vec3& held, const Vec3& right);

/// Runs a method over a stroke once to compare and `replays` times to take times, each as if newly
/// made. All replays do the same, so a tick's time is the least of them: what the method needs, and
/// not what else the machine did.
Samples Compare(ContactMethod& method, const Stroke& stroke, int replays);

/// The same times alone [us]. `afterTick` is not timed.
std::vector<double> TimesOf(
  ContactMethod& method, const std::vector<Vec3>& hips, int replays,
  const std::function<void(std::size_t)>& afterTick = [](std::size_t) {});
}

#endif
