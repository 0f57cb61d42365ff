#ifndef Haptics_SurfaceFrame_h
#define Haptics_SurfaceFrame_h

#include "haptics/Math/RigidPose.h"
#include "haptics/Math/VectorMath.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace haptics
{
inline glm::dquat ToQuaternion(const RigidPose& pose)
{
  return { pose.Rotation[0], pose.Rotation[1], pose.Rotation[2], pose.Rotation[3] };
}

/// The pose at a fraction of the way between two, 0 to 1: the pivot, a point of the surface's
/// frame, goes straight and the rest turns evenly about it.
inline RigidPose Interpolated(
  const RigidPose& from, const RigidPose& to, const Vector& pivot, double fraction)
{
  RigidPose pose = from;
  if (from.Rotation == to.Rotation)
  {
    pose.Translation =
      ToVec3(glm::mix(ToVector(from.Translation), ToVector(to.Translation), fraction));
    return pose;
  }
  const glm::dquat turned =
    glm::normalize(glm::slerp(ToQuaternion(from), ToQuaternion(to), fraction));
  pose.Rotation = { turned.w, turned.x, turned.y, turned.z };
  const Vec3 x = ToVec3(pivot);
  const Vector middle =
    glm::mix(ToVector(from.PointToWorld(x)), ToVector(to.PointToWorld(x)), fraction);
  pose.Translation = ToVec3(middle - ToVector(pose.VectorToWorld(x)));
  return pose;
}

/// @brief From the scene frame to the local frame of a surface that may have moved, and back.
///
/// A surface that is not turned costs one subtraction, as one that stands still always did.
class SurfaceFrame
{
public:
  SurfaceFrame() = default;
  /// `surfaceOrigin`: of the surface's local frame, before it moved; `sceneOrigin`: in the world.
  SurfaceFrame(const RigidPose& pose, const Vector& surfaceOrigin, double surfaceRadius,
    const Vector& sceneOrigin)
    : IsTurned(pose.Rotation != RigidPose().Rotation)
    , Negligible(NegligibleShare * surfaceRadius)
  {
    if (this->IsTurned)
    {
      this->ToSceneAxes = glm::mat3_cast(ToQuaternion(pose));
      this->ToLocalAxes = glm::transpose(this->ToSceneAxes);
    }
    this->Offset = (this->VectorToScene(surfaceOrigin) + ToVector(pose.Translation)) - sceneOrigin;
  }

  Vector VectorToScene(const Vector& v) const { return this->IsTurned ? this->ToSceneAxes * v : v; }
  Vector VectorToLocal(const Vector& v) const { return this->IsTurned ? this->ToLocalAxes * v : v; }
  Vector PointToScene(const Vector& x) const { return this->VectorToScene(x) + this->Offset; }
  /// The same point always rounds to the same local point.
  Vector PointToLocal(const Vector& x) const
  {
    const Vector d = x - this->Offset;
    return WithoutNegligible(this->IsTurned ? this->ToLocalAxes * d : d, this->Negligible);
  }
  /// The surface's origin in the scene frame.
  const Vector& Origin() const { return this->Offset; }

private:
  bool IsTurned = false;
  double Negligible = 0.0;
  glm::dmat3 ToSceneAxes{ 1.0 };
  glm::dmat3 ToLocalAxes{ 1.0 };
  Vector Offset{ 0 };
};
}

#endif
