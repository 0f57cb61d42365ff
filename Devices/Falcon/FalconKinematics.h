#ifndef Haptics_FalconKinematics_h
#define Haptics_FalconKinematics_h

#include "vtkHapticsDevicesModule.h"

#include <array>
#include <cstdint>

namespace haptics
{
/// @brief The geometry of the Novint Falcon: a delta robot, after R. E. Stamper, "A three degree of
/// freedom parallel manipulator with only translational degrees of freedom", 1997.
///
/// Positions are in the device frame [m]: z points out of the device to the user; the legs are
/// about z at 105, -15 and -135 degrees. In the frame of a leg, u away from the axis, v across and
/// w = z, a crank of length a turns in the plane of u and w by theta1, and a parallelogram with
/// rods of length b swings in that plane by theta2 and out of it by theta3:
///
///              P = (u, v, w)
///             /   (u, w) = a (cos, sin) theta1 - (c, 0) + (d + e + b sin theta3) (cos, sin) theta2
///        b   /    v      = b cos theta3 - f
///           /
///     o----o theta2
///       a   theta1
///
/// Every function is pure, allocates nothing and may be called from any thread.
namespace FalconKinematics
{
using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>; ///< rows

/// Crank angle [rad] at an encoder count: 35 degrees at 0, 1280 counts a turn geared 7.72 to 1.
VTKHAPTICSDEVICES_EXPORT double AngleOfCount(std::int16_t count) noexcept;
/// The encoder count nearest to a crank angle [rad], clamped to what the encoder can hold.
VTKHAPTICSDEVICES_EXPORT std::int16_t CountOfAngle(double angle) noexcept;

/// Crank angles [rad] at a position. False, leaving them, where a leg does not reach so far.
VTKHAPTICSDEVICES_EXPORT bool Inverse(const Vector& position, Vector& angles) noexcept;

/// Position at three crank angles [rad], to 1e-10 m or better. Remembers nothing: no lag. False,
/// leaving it, where no position fits the angles or they are not finite.
VTKHAPTICSDEVICES_EXPORT bool Forward(const Vector& angles, Vector& position) noexcept;

/// d position / d angles [m/rad] at a pose that Forward() or Inverse() gave. False, leaving it, at
/// a singular pose.
VTKHAPTICSDEVICES_EXPORT bool Jacobian(
  const Vector& position, const Vector& angles, Matrix& jacobian) noexcept;

/// Torques at the cranks [N m] that make a force at the grip [N]: the Jacobian's transpose.
VTKHAPTICSDEVICES_EXPORT Vector Torques(const Matrix& jacobian, const Vector& force) noexcept;
}
}

#endif
