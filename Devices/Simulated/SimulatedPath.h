#ifndef Haptics_SimulatedPath_h
#define Haptics_SimulatedPath_h

#include "vtkHapticsDevicesModule.h"

#include <array>
#include <string>
#include <vector>

namespace haptics
{
using DevicePoint = std::array<double, 3>; ///< device frame [m]

/// @brief Where a hand that follows a path is at a given time: straight between timed points.
///
/// Built on the GUI thread; At() may then be called from any thread.
///
/// A path without loop stays at its last point for ever. A looping one goes straight back from the
/// last point to the first, at its mean speed, and starts over.
class VTKHAPTICSDEVICES_EXPORT SimulatedPath
{
public:
  /// Follows the points at one speed [m/s]. False, with the cause in `error`: no point, a point
  /// that is not finite (named by its index), or a speed that is not finite and > 0.
  bool FollowAtSpeed(
    const std::vector<DevicePoint>& points, double speed, bool loop, std::string& error);

  /// Is at each point at its time [s], counted from the first. False, with the cause in `error`:
  /// no point, another number of times than points, a point or time that is not finite, or a time
  /// that is not after the one before it.
  bool FollowTimes(const std::vector<DevicePoint>& points, const std::vector<double>& times,
    bool loop, std::string& error);

  /// Position [m] at a time [s] since the start; before it, the first point. Wait-free, O(log n).
  DevicePoint At(double time) const noexcept;

  /// Time [s] of one pass, with the way back of a loop; 0 for a path of one point.
  double Duration() const { return this->Times.empty() ? 0.0 : this->Times.back(); }

private:
  void CloseLoop();

  std::vector<DevicePoint> Points;
  std::vector<double> Times; // strictly increasing from 0, one a point
  bool Loop = false;
};

/// True if every coordinate is finite.
VTKHAPTICSDEVICES_EXPORT bool IsFinite(const DevicePoint& point) noexcept;
/// Distance [m].
VTKHAPTICSDEVICES_EXPORT double Distance(const DevicePoint& a, const DevicePoint& b) noexcept;
}

#endif
