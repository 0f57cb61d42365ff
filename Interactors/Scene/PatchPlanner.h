#ifndef Haptics_PatchPlanner_h
#define Haptics_PatchPlanner_h

#include "haptics/Surface/SurfacePatch.h"
#include "vtkHapticsSceneModule.h"

#include <optional>

namespace haptics
{
/// Where a hand is at a time; in the frame of the surface's points.
struct HandState
{
  double Time = 0.0; ///< [s]
  Vec3 Hip{};
  Vec3 Position{}; ///< the god-object
  /// Whether the surface has gone over it, and the patch does not show where to: Contact::IsAstray.
  bool IsAstray = false;
  bool IsWaiting = false; ///< for data: Contact::AwaitsData
};

struct PatchRequest
{
  PatchRegion Region;
  double Time = 0.0; ///< when it was asked for [s]
  /// Whether it is to reach the surface's place that is nearest to the start of its line.
  bool IsUpToSurface = false;
};

/// @brief Says which patch of a surface a moving hand needs next, and when to ask for it.
///
/// With R the radius, v the hand's velocity and L how long an answer takes (measured, and one more
/// look), a patch is all that comes within R, and as far as the god-object lags behind, of the line
///
///     god-object o=========o hip + v L
///
/// It is asked for when the hand, where it will be after L, has less than R / 2 left in the patch
/// in force; so none is while a hand stays in the middle. The god-object is in every patch: what it
/// has not seen it cannot pass. An answer that does not come within four times L, or a quarter of a
/// second, is taken for lost, and what is needed then is asked for; each loss in a row doubles that
/// time, up to two seconds. One that comes all the same is as welcome. Data are there in time while
/// a hand's acceleration a, with I between two looks, keeps to a ((L + I)^2 / 2 + (L + I) I) < R
/// / 2. A hand that waits has its god-object far behind, which catches up along the line: a patch
/// is wider by 2 R for that at most, and by twice as much in each further one until it has. A
/// god-object that a surface has gone over needs, once, a patch that reaches up to that. GUI
/// thread; in whatever time its caller has.
class VTKHAPTICSSCENE_EXPORT PatchPlanner
{
public:
  /// `radius`: R [unit of the surface's points], > 0. `pause`: after an answer nothing is asked for
  /// so many times as long as it took, >= 0. A source that lets its caller wait takes 1 / (1 +
  /// pause) of its time at most; a patch reaches ahead by as much more.
  explicit PatchPlanner(double radius, double pause = 0.0)
    : Radius(radius)
    , Pause(pause)
  {
  }

  /// What to ask for now; nothing while the patch in force will do, or one is on its way.
  std::optional<PatchRequest> Plan(const HandState& hand);
  /// What was asked for has come.
  void Receive(double time, const PatchRequest& request);
  /// The surface is another one, or has another shape: what is in force will not do.
  void Renew() { this->InForce.reset(); }
  /// Nothing is in force, and nothing on its way.
  void Forget();

  /// How long answers take [s].
  double Latency() const { return this->Delay; }
  /// How many were taken for lost.
  int NumberOfLosses() const { return this->Losses; }
  bool IsWaiting() const { return this->IsAsking; }

private:
  double Radius;
  double Pause;
  double Delay = 0.1;     ///< before any is known
  double LastDelay = 0.0; ///< of the last answer
  double AnsweredAt = 0.0;
  double AskedAt = 0.0;
  bool IsAsking = false;
  int Losses = 0;
  int LossesInARow = 0;
  int PatchesOfWait = 0; ///< asked for since the hand waits
  std::optional<PatchRequest> InForce;
  std::optional<HandState> Last;
  Vec3 Velocity{};
  double Interval = 0.0; ///< between two looks [s]
};
}

#endif
