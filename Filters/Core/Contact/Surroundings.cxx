#include "haptics/Contact/Surroundings.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// A tip is a ball from so many of the largest clearance on: smaller ones are in float64's noise,
/// or narrower than the cracks that are to be closed.
constexpr double SmallestTip = 16.0;
/// A ball is no larger than so many of the largest surface's radius: all of that is as good as a
/// point of it then, and its own rounding is far below that.
constexpr double LargestTip = 0x1p20;
}

Surroundings::Surroundings(std::vector<TouchedSurface> surfaces, Tip tip)
  : Surfaces(std::move(surfaces))
{
  if (!this->Surfaces.empty())
  {
    const TouchedSurface& first = this->Surfaces.front();
    const Vec3& origin = first.Surface->Origin();
    this->Origin = ToVector(first.Motion ? first.Motion->Read().Pose.PointToWorld(origin) : origin);
  }
  this->HasProperties = std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const TouchedSurface& touched) { return touched.Properties != nullptr; });
  this->Sets.reserve(this->Surfaces.size());
  for (const TouchedSurface& touched : this->Surfaces)
  {
    const auto index = static_cast<std::int32_t>(this->Sets.size());
    this->Sets.emplace_back(touched.Surface, index, this->FrameOf(index, RigidPose()));
    if (tip == Tip::Ball)
    {
      this->Balls.emplace_back(*touched.Surface, index);
    }
    if (!touched.IsGripped)
    {
      ++this->TouchableCount;
      this->SharingUnit = std::max(this->SharingUnit, touched.Surface->Clearance());
      this->HasPatches = this->HasPatches || touched.Surface->Patch() != nullptr;
    }
  }
  this->CountAll();
}

double Surroundings::UsableRadius(double radius) const
{
  if (this->Balls.empty() || !(radius > SmallestTip * this->SharingUnit) || !std::isfinite(radius))
  {
    return 0.0;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < this->TouchableCount; ++i)
  {
    largest = std::max(largest, this->Surfaces[i].Surface->Radius());
  }
  return std::min(radius, LargestTip * largest);
}

SurfaceFrame Surroundings::FrameOf(std::int32_t surface, const RigidPose& pose) const
{
  const TriangleSurface& touched = *this->Surfaces[surface].Surface;
  return SurfaceFrame(pose, ToVector(touched.Origin()), touched.Radius(), this->Origin);
}

double Surroundings::KnownPart(const Vector& hip) const
{
  double known = 1.0;
  for (std::size_t i = 0; i < this->TouchableCount; ++i)
  {
    known = std::min(known, this->Sets[i].KnownPart(hip, this->TipRadius));
  }
  return known;
}

bool Surroundings::IsKnown(const Vector& place) const
{
  return std::all_of(this->Sets.begin() + static_cast<std::ptrdiff_t>(this->First),
    this->Sets.begin() + static_cast<std::ptrdiff_t>(this->Last),
    [&](const WorkingSet& set) { return set.IsKnown(place, this->TipRadius); });
}

std::optional<Vector> Surroundings::UnknownPlace() const
{
  for (std::size_t i = 0; this->HasPatches && i < this->TouchableCount; ++i)
  {
    const Vector place = this->Sets[i].Frame().PointToScene(this->Sets[i].LocalPosition());
    if (!this->IsKnown(place))
    {
      return place;
    }
  }
  return std::nullopt;
}

/// Whether what encloses space encloses another place as it does the god-object's.
bool Surroundings::IsOnSameSide(const Vector& other)
{
  this->RenewBudget();
  return std::all_of(this->Sets.begin(), this->Sets.begin() + this->TouchableCount,
    [&](WorkingSet& set) { return set.IsOnSameSide(other, this->Budget); });
}

void Surroundings::MoveSetsTo(const Vector& place)
{
  for (std::size_t i = this->First; i < this->Last; ++i)
  {
    this->Sets[i].MoveTo(place);
  }
}

/// A ball that overlaps, as it was put there, has grown, or has come through a back, counts as the
/// largest about its centre that does not.
void Surroundings::FitBall()
{
  double fit = this->TipRadius;
  for (std::size_t i = this->First; i < this->Last; ++i)
  {
    fit = std::min(fit, this->Balls[i].LargestFit(this->Sets[i], this->TipRadius, this->Budget));
  }
  this->IsFit = fit >= this->TipRadius * (1.0 - Tolerance);
  this->BallRadius = this->IsFit ? this->TipRadius : fit;
}

/// Whether the last cast passed a facet from its back, which the ball overlaps then.
bool Surroundings::HasComeThrough() const
{
  return std::any_of(this->Balls.begin() + static_cast<std::ptrdiff_t>(this->First),
    this->Balls.begin() + static_cast<std::ptrdiff_t>(this->Last),
    [](const BallSet& ball) { return ball.HasComeThrough(); });
}

/// For what is asked of surfaces where the ball touches them: has them see it there, as a point.
void Surroundings::StandAt(const Vector& place)
{
  for (std::size_t i = 0; this->IsBall() && i < this->TouchableCount; ++i)
  {
    this->Sets[i].Place(place);
  }
}

Vector Surroundings::LocalTouch(const Constraint& constraint) const
{
  const WorkingSet& set = this->Sets[constraint.Surface];
  return this->IsBall() ? set.LocalPosition() -
      this->BallRadius * set.Frame().VectorToLocal(ToVector(constraint.Normal))
                        : set.LocalPosition();
}
}
