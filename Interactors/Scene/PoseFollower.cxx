#include "haptics/Scene/PoseFollower.h"

#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
bool PoseFollower::Take(const Matrix4& matrix)
{
  const bool isOther = !AreSame(matrix, this->LastMatrix);
  this->LastMatrix = matrix;
  return isOther;
}

/// Whether the matrix can be followed or baked at all; else refused, which is an error once.
bool PoseFollower::Check(PullReport& report)
{
  const double determinant = Determinant(this->LastMatrix);
  const bool isGood = std::isfinite(determinant) && determinant != 0.0;
  if (!isGood && this->Now != State::Refused)
  {
    report.Fail("the actor's matrix flattens it or is not finite; check its scale and user matrix");
    this->Now = State::Refused;
  }
  return isGood;
}

void PoseFollower::Follow(
  const TriangleSurface& inForce, const PullSettings& settings, PullReport& report)
{
  if (!this->Check(report))
  {
    return;
  }
  const std::optional<RigidPose> pose = FindPose(this->LastMatrix, this->BakedMatrix);
  this->Now = pose ? State::Follows : State::NeedsBaking;
  if (pose)
  {
    this->MoveTo(*pose, inForce, settings, report);
  }
}

void PoseFollower::MoveTo(const RigidPose& pose, const TriangleSurface& inForce,
  const PullSettings& settings, PullReport& report)
{
  if (pose == this->Placed)
  {
    return;
  }
  const double duration = settings.DurationSince(this->LastMoved);
  this->LastMoved = settings.Now;
  const double way = this->LengthOfWay(inForce, pose);
  const double largestSpeed = PullSettings::LargestSpeed * settings.Scale;
  const bool isTooFast = settings.IsLive && way > largestSpeed * LongestMotion;
  if (!settings.IsLive || isTooFast)
  {
    this->Moving->JumpTo(pose);
  }
  else
  {
    this->Moving->SetLargestSpeed(largestSpeed);
    this->Moving->MoveTo(pose, duration);
  }
  this->Placed = pose;
  this->IsElsewhere = true;
  this->Jump.Look("It", isTooFast ? way : 0.0, settings, report);
}

double PoseFollower::LengthOfWay(const TriangleSurface& inForce, const RigidPose& pose) const
{
  const Vec3 from = this->Placed.PointToWorld(inForce.Origin());
  const Vec3 to = pose.PointToWorld(inForce.Origin());
  double cosine = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    cosine += pose.Rotation[i] * this->Placed.Rotation[i];
  }
  const double angle = 2.0 * std::acos(std::min(1.0, std::abs(cosine)));
  return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) + angle * inForce.Radius();
}

void PoseFollower::JumpToPose()
{
  if (this->Moving)
  {
    this->Moving->JumpTo(this->Placed);
  }
}

std::optional<Matrix4> PoseFollower::MatrixToBake(bool hasSnapshot, PullReport& report)
{
  if (!this->Check(report))
  {
    return std::nullopt;
  }
  if (hasSnapshot && FindPose(this->LastMatrix, this->BakedMatrix))
  {
    return this->BakedMatrix;
  }
  return FindPose(this->LastMatrix, IdentityMatrix) ? IdentityMatrix : this->LastMatrix;
}

void PoseFollower::Rebase(const TriangleSurface& inForce, const Matrix4& baked, double now)
{
  this->BakedMatrix = baked;
  // Where the actor has been scaled meanwhile, the next build is for that.
  const std::optional<RigidPose> pose = FindPose(this->LastMatrix, baked);
  this->Now = pose ? State::Follows : State::NeedsBaking;
  this->Placed = pose.value_or(this->Placed);
  this->Moving = this->Moves
    ? std::make_shared<SurfaceMotion>(this->Placed, inForce.Origin(), inForce.Radius())
    : nullptr;
  this->LastMoved = now;
}

Vec3 PoseFollower::PointInGeometry(const Vec3& point) const
{
  if (this->BakedMatrix == IdentityMatrix)
  {
    return point;
  }
  Matrix4 inverse;
  vtkMatrix4x4::Invert(this->BakedMatrix.data(), inverse.data());
  return Transformed(inverse, point);
}
}
