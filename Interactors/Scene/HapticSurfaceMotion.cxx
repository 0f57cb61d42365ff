// How a HapticSurface follows its actor's matrix.
#include "haptics/Scene/HapticSurface.h"

#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace haptics
{
/// False where the snapshot needs another matrix baked into it.
bool HapticSurface::FollowMatrix(const PullSettings& settings, std::string& error)
{
  const double determinant = Determinant(this->LastMatrix);
  if (!std::isfinite(determinant) || determinant == 0.0)
  {
    this->RefuseMatrix(error);
    return true;
  }
  const std::optional<RigidPose> pose = FindPose(this->LastMatrix, this->Baked);
  if (pose)
  {
    this->LastMatrixError.clear();
    this->MoveTo(*pose, settings);
  }
  return pose.has_value();
}

void HapticSurface::RefuseMatrix(std::string& error)
{
  const std::string text =
    "the actor's matrix flattens it or is not finite; check its scale and user matrix";
  if (text != this->LastMatrixError)
  {
    error = text;
    this->LastMatrixError = text;
  }
}

void HapticSurface::MoveTo(const RigidPose& pose, const PullSettings& settings)
{
  if (pose == this->Placed)
  {
    return;
  }
  const double duration = settings.DurationSince(this->LastMoved);
  this->LastMoved = settings.Now;
  const double way = this->LengthOfWay(pose);
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
  this->TellJump("It", isTooFast ? way : 0.0, settings, this->HasToldJump);
}

/// Once, until a motion is no jump. `way`: of the jump [world unit]; 0: it is none.
void HapticSurface::TellJump(
  const char* what, double way, const PullSettings& settings, bool& wasTold)
{
  const bool isJump = way > 0.0;
  if (isJump && !wasTold)
  {
    std::ostringstream text;
    text.precision(3);
    text << what << " was moved by " << way / settings.Scale
         << " m in the hand from one update to the next, where a hand can be pushed by "
         << PullSettings::LargestSpeed * LongestMotion << " m at most ("
         << PullSettings::LargestSpeed << " m/s for " << LongestMotion
         << " s). It was put in its new place at once and has pushed nothing. "
         << "Move it in smaller steps, or let the device reach farther (ScaleWorkspace).";
    this->Notice += (this->Notice.empty() ? "" : " ") + text.str();
  }
  wasTold = isJump;
}

double HapticSurface::LengthOfWay(const RigidPose& pose) const
{
  const Vec3 from = this->Placed.PointToWorld(this->InForce->Origin());
  const Vec3 to = pose.PointToWorld(this->InForce->Origin());
  double cosine = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    cosine += pose.Rotation[i] * this->Placed.Rotation[i];
  }
  const double angle = 2.0 * std::acos(std::min(1.0, std::abs(cosine)));
  return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) +
    angle * this->InForce->Radius();
}

Vec3 HapticSurface::PointInActor(const Vec3& point) const
{
  if (this->Baked == IdentityMatrix)
  {
    return point;
  }
  Matrix4 inverse;
  vtkMatrix4x4::Invert(this->Baked.data(), inverse.data());
  return Transformed(inverse, point);
}
}
