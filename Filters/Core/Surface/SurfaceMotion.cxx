#include "haptics/Surface/SurfaceMotion.h"

#include "haptics/Math/CoordinateRange.h"
#include "haptics/Surface/SurfaceFrame.h"

#include <algorithm>

namespace haptics
{
namespace
{
RigidPose Normalised(RigidPose pose)
{
  const double length = glm::length(ToQuaternion(pose));
  // One that is as good as a unit already is kept bit for bit.
  if (std::abs(length - 1.0) > 4.0 * UnitRoundoff)
  {
    for (double& x : pose.Rotation)
    {
      x /= length;
    }
  }
  return pose;
}

template <class Numbers>
void Pack(const RigidPose& pose, Numbers& numbers, std::size_t at)
{
  std::copy(pose.Translation.begin(), pose.Translation.end(), numbers.begin() + at);
  std::copy(pose.Rotation.begin(), pose.Rotation.end(), numbers.begin() + at + 3);
}

template <class Numbers>
RigidPose Unpack(const Numbers& numbers, std::size_t at)
{
  RigidPose pose;
  std::copy_n(numbers.begin() + at, 3, pose.Translation.begin());
  std::copy_n(numbers.begin() + at + 3, 4, pose.Rotation.begin());
  return pose;
}

// Where in an order what stands.
constexpr std::size_t JumpAt = 0;
constexpr std::size_t TargetAt = 7;
constexpr std::size_t JumpsAt = 14;
constexpr std::size_t DurationAt = 15;
constexpr std::size_t SpeedAt = 16;
}

SurfaceMotion::SurfaceMotion(const RigidPose& pose, const Vec3& pivot, double radius)
  : Pivot(pivot)
  , Radius(radius)
  , Now(Normalised(pose))
  , Start(this->Now)
  , Target(this->Now)
{
  Pack(this->Now, this->Ordered, TargetAt);
  this->LastState.Pose = this->Now;
}

bool SurfaceMotion::IsValid(const RigidPose& pose) noexcept
{
  const double length = glm::length(ToQuaternion(pose));
  return IsInRange(pose.Translation) && std::isfinite(length) && length > 1e-100;
}

bool SurfaceMotion::MoveTo(const RigidPose& target, double duration)
{
  if (!IsValid(target) || !std::isfinite(duration) || duration < 0.0)
  {
    return false;
  }
  Pack(Normalised(target), this->Ordered, TargetAt);
  this->Ordered[DurationAt] = duration;
  this->Ordered[SpeedAt] = this->LargestSpeed;
  this->Orders.Write(this->Ordered);
  return true;
}

bool SurfaceMotion::JumpTo(const RigidPose& target)
{
  if (!IsValid(target))
  {
    return false;
  }
  // A servo that has not looked meanwhile sees the jump and what came after it.
  Pack(Normalised(target), this->Ordered, JumpAt);
  this->Ordered[JumpsAt] += 1.0;
  return this->MoveTo(target, 0.0);
}

bool SurfaceMotion::SetLargestSpeed(double speed)
{
  if (!(speed > 0.0))
  {
    return false;
  }
  this->LargestSpeed = speed;
  return true;
}

const SurfaceMotion::State& SurfaceMotion::Read()
{
  Report::Numbers numbers;
  if (this->Reports.Read(this->SeenReport, numbers))
  {
    this->LastState.Pose = Unpack(numbers, 0);
    this->LastState.IsMoving = numbers[PoseSize] != 0.0;
    this->LastState.IsSlowed = numbers[PoseSize + 1] != 0.0;
  }
  return this->LastState;
}

const RigidPose& SurfaceMotion::Advance(double dt) noexcept
{
  this->Take();
  if (this->Elapsed < this->Duration || this->Now != this->Target)
  {
    this->Elapsed += dt > 0.0 ? dt : 0.0;
    if (this->Elapsed < this->Duration)
    {
      this->Now = Interpolated(
        this->Start, this->Target, ToVector(this->Pivot), this->Elapsed / this->Duration);
    }
    else
    {
      this->Now = this->Target; // exactly
    }
    this->Publish();
  }
  return this->Now;
}

void SurfaceMotion::Take() noexcept
{
  Order::Numbers order;
  if (!this->Orders.Read(this->SeenOrder, order))
  {
    return;
  }
  const auto jumps = static_cast<std::uint64_t>(order[JumpsAt]);
  if (jumps != this->NumberOfJumps)
  {
    this->NumberOfJumps = jumps;
    this->Now = Unpack(order, JumpAt);
    this->Publish();
  }
  this->Start = this->Now;
  this->Target = Unpack(order, TargetAt);
  this->Elapsed = 0.0;
  const double fastest = this->Length(this->Target) / order[SpeedAt];
  this->IsSlowed = fastest > order[DurationAt];
  this->Duration = std::max(fastest, order[DurationAt]);
}

double SurfaceMotion::Length(const RigidPose& target) const noexcept
{
  const Vector way =
    ToVector(target.PointToWorld(this->Pivot)) - ToVector(this->Now.PointToWorld(this->Pivot));
  const double cosine = std::abs(glm::dot(ToQuaternion(this->Now), ToQuaternion(target)));
  return glm::length(way) + 2.0 * std::acos(std::min(cosine, 1.0)) * this->Radius;
}

void SurfaceMotion::Publish() noexcept
{
  Report::Numbers numbers{};
  Pack(this->Now, numbers, 0);
  numbers[PoseSize] = this->Now != this->Target;
  numbers[PoseSize + 1] = this->IsSlowed;
  this->Reports.Write(numbers);
}
}
