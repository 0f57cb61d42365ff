#include "haptics/Scene/HapticSurface.h"

#include "vtkBoundingBox.h"

#include <utility>

namespace haptics
{
HapticSurface::HapticSurface(int id, std::unique_ptr<SurfaceSource> source)
  : Identifier(id)
  , Source(std::move(source))
  , Place(this->Source->Moves())
  , Geometry(*this->Source, this->Place)
{
}

bool HapticSurface::Pull(const PullSettings& settings, std::string& error)
{
  const Snapshot before = this->TouchableSurface();
  const Properties propertiesBefore = this->TouchedProperties();
  PullReport report;
  this->Follow(settings, report);
  error = report.Error;
  if (!error.empty())
  {
    error += std::string(error.back() == '.' ? "" : ".") +
      (this->TouchableSurface() ? " What was touched before stays in force."
                                : " It cannot be touched.");
  }
  if (this->Geometry.Snapshot())
  {
    this->Geometry.TakeFilterError();
    this->Material.Follow(this->Filter(), this->Prepared(), this->Geometry.Snapshot());
    report.Note(this->Geometry.TakeFilterError());
  }
  error += (error.empty() || report.Notice.empty() ? "" : " ") + report.Notice;
  return this->TouchableSurface() != before || this->TouchedProperties() != propertiesBefore;
}

void HapticSurface::Follow(const PullSettings& settings, PullReport& report)
{
  const bool wasUnseen = !this->IsThere();
  this->Place.BeginPull();
  this->IsShown = this->Source->IsShown();
  this->Geometry.TakeDoneBuild(settings, report);
  if (!this->IsShown || !this->Geometry.Connect(report))
  {
    return;
  }
  const bool hasMoved = this->Place.Take(this->Source->Matrix());
  const bool isCarried = std::exchange(this->IsCarried, false);
  if (hasMoved && this->Geometry.Snapshot())
  {
    PullSettings moving = settings;
    moving.IsLive = settings.IsLive && !isCarried;
    this->Place.Follow(*this->Geometry.Snapshot(), moving, report);
  }
  if (wasUnseen)
  {
    this->Place.JumpToPose();
  }
  this->Geometry.Follow(hasMoved, wasUnseen, settings, report);
}

std::optional<RayHit> HapticSurface::CastRay(const Vec3& from, const Vec3& direction)
{
  const Snapshot touched = this->TouchableSurface();
  if (!touched || this->IsInPatches())
  {
    return touched ? this->Geometry.CastRayThroughPatches(from, direction) : std::nullopt;
  }
  const RigidPose& pose = this->Pose();
  std::optional<RayHit> hit =
    haptics::CastRay(*touched, pose.PointToSurface(from), pose.VectorToSurface(direction));
  if (hit)
  {
    hit->Normal = pose.VectorToWorld(hit->Normal);
  }
  return hit;
}

void HapticSurface::AddBounds(vtkBoundingBox& box) const
{
  const Snapshot touched = this->TouchableSurface();
  if (this->Geometry.AddBoundsOfPatches(box))
  {
    return;
  }
  if (!touched)
  {
    this->Geometry.AddBoundsOfBuild(box);
    return;
  }
  const Vec3& o = touched->Origin();
  for (const Vec3& p : touched->Points())
  {
    box.AddPoint(this->Pose().PointToWorld({ p[0] + o[0], p[1] + o[1], p[2] + o[2] }).data());
  }
}
}
