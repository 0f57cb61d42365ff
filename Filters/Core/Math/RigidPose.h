#ifndef Haptics_RigidPose_h
#define Haptics_RigidPose_h

#include "haptics/Math/Vec3.h"

#include <array>

namespace haptics
{
/// @brief Where a surface's own frame is in the world: x_world = Rotation x + Translation.
///
/// No scale, shear or mirror: those are part of a surface's points. The identity by default.
struct RigidPose
{
  Vec3 Translation{};                           ///< [world unit]
  std::array<double, 4> Rotation{ 1, 0, 0, 0 }; ///< unit quaternion: w, x, y, z

  bool operator==(const RigidPose& other) const noexcept
  {
    return this->Translation == other.Translation && this->Rotation == other.Rotation;
  }
  bool operator!=(const RigidPose& other) const noexcept { return !(*this == other); }

  /// A vector of the surface's frame along the world's axes.
  Vec3 VectorToWorld(const Vec3& v) const noexcept { return Rotated(v, 1.0); }
  /// A vector of the world along the axes of the surface's frame.
  Vec3 VectorToSurface(const Vec3& v) const noexcept { return Rotated(v, -1.0); }
  /// A point of the surface's frame in the world.
  Vec3 PointToWorld(const Vec3& x) const noexcept
  {
    const Vec3 turned = this->VectorToWorld(x);
    return { turned[0] + this->Translation[0], turned[1] + this->Translation[1],
      turned[2] + this->Translation[2] };
  }
  /// A point of the world in the surface's frame.
  Vec3 PointToSurface(const Vec3& x) const noexcept
  {
    return this->VectorToSurface(
      { x[0] - this->Translation[0], x[1] - this->Translation[1], x[2] - this->Translation[2] });
  }

private:
  /// v + 2w (u x v) + 2u x (u x v); `sign` of u: -1 turns back.
  Vec3 Rotated(const Vec3& v, double sign) const noexcept
  {
    const double w = this->Rotation[0];
    const Vec3 u{ sign * this->Rotation[1], sign * this->Rotation[2], sign * this->Rotation[3] };
    const Vec3 a = Cross(u, v);
    const Vec3 b = Cross(u, a);
    return { v[0] + 2.0 * (w * a[0] + b[0]), v[1] + 2.0 * (w * a[1] + b[1]),
      v[2] + 2.0 * (w * a[2] + b[2]) };
  }
  static Vec3 Cross(const Vec3& a, const Vec3& b) noexcept
  {
    return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
  }
};
}

#endif
