#ifndef Haptics_Testing_HandNoise_h
#define Haptics_Testing_HandNoise_h

#include "haptics/Contact/GodObject.h"

#include <memory>
#include <vector>

namespace haptics::testing
{
/// What a hand and its device add to a place that it holds.
struct HandNoise
{
  double Tremor = 0.0;  ///< amplitude on each axis [m], between 8 and 12 Hz
  double Encoder = 0.0; ///< step of each coordinate [m]; 0: none
};

/// A hand that is supported, and a common desktop device.
constexpr HandNoise RestingHand{ 50e-6, 55e-6 };

/// Places of a hand that holds `place` for `ticks` of 1 ms.
std::vector<Vec3> HoldStill(const Vec3& place, const HandNoise& noise, int ticks, unsigned seed);

struct RestingForce
{
  double Mean = 0.0;      ///< [N]
  double Deviation = 0.0; ///< standard, of the vector: sqrt(E|F - E F|^2) [N]
  /// Of the change from tick to tick: what buzzes [N].
  double Step = 0.0;
  /// Deviation over that of a spring from the hand to a point that stays: 1/sqrt(3) on a plane; up
  /// to 2 wherever the god-object moves no farther than the hand.
  double Gain = 0.0;
  bool IsTouching = false; ///< in every tick
};

/// The force on a hand that comes from `from` to `place` in a straight line and holds it there, by
/// a spring of 500 N/m. `radius`: of the tip [m], 0 for the point.
RestingForce Rest(const std::shared_ptr<const TriangleSurface>& surface, const Vec3& from,
  const Vec3& place, double radius, const HandNoise& noise, unsigned seed);
}

#endif
