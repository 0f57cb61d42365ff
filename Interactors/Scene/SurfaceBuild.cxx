#include "haptics/Scene/SurfaceBuild.h"

#include "haptics/Contact/GodObject.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace haptics
{
SurfaceBuild::SurfaceBuild(std::shared_ptr<SurfacePreparation> preparation, const Matrix4& matrix)
  : Prepared(std::move(preparation))
  , Baked(matrix)
  , IsNew(!this->Prepared->Surface())
{
}

void SurfaceBuild::DeformFrom(std::shared_ptr<const TriangleSurface> from,
  std::shared_ptr<SurfaceDeformer> deformer, double duration, double largestSpeed)
{
  this->Before = std::move(from);
  this->Shaper = std::move(deformer);
  this->Duration = duration;
  this->LargestSpeed = largestSpeed;
}

bool SurfaceBuild::Deform()
{
  std::vector<Vec3> points;
  if (!this->Before || !this->Report(0.0) || !this->Prepared->Follow(points))
  {
    return false;
  }
  for (Vec3& point : points)
  {
    point = Transformed(this->Baked, point);
  }
  if (!this->Shaper)
  {
    this->Shaper = std::make_shared<SurfaceDeformer>(this->Before);
  }
  const double way = this->Shaper->LongestWay(points);
  this->JumpedBy = way > this->LargestSpeed * LongestMotion ? way : 0.0;
  const double needed = GodObject::Haste * way / this->LargestSpeed; // it may be hastened
  std::string error; // whatever it is, building anew helps or says why not
  this->Built = this->JumpedBy > 0.0
    ? this->Shaper->Replace(std::move(points), error)
    : this->Shaper->Deform(std::move(points), std::max(this->Duration, needed), error);
  return this->Built != nullptr;
}

void SurfaceBuild::Work()
{
  try
  {
    this->HasDeformed = this->Deform();
    if (this->HasDeformed)
    {
      this->Outcome = CleaningResult::Done;
      return;
    }
    this->Shaper.reset();
    this->BuildAnew();
  }
  catch (const std::bad_alloc&)
  {
    this->Outcome = CleaningResult::Failed;
    this->Built.reset();
    this->ErrorText = "memory ran out while the surface was built; decimate or clip it";
  }
}

void SurfaceBuild::BuildAnew()
{
  const auto report = [this](double fraction)
  { return this->Report(fraction) && (!this->Listener || this->Listener(fraction)); };
  if (!report(0.0))
  {
    return;
  }
  this->Outcome = this->IsNew ? this->Prepared->Run(report) : CleaningResult::Done;
  if (this->Outcome == CleaningResult::Done)
  {
    this->Built = this->Prepared->Surface();
    if (this->Baked != IdentityMatrix)
    {
      this->Bake(*this->Built);
    }
  }
}

void SurfaceBuild::Bake(const TriangleSurface& local)
{
  const Matrix4& m = this->Baked;
  TriangleMesh mesh;
  mesh.Triangles = local.Triangles();
  mesh.Points.reserve(local.Points().size());
  const Vec3& o = local.Origin();
  for (const Vec3& p : local.Points())
  {
    mesh.Points.push_back(Transformed(m, { p[0] + o[0], p[1] + o[1], p[2] + o[2] }));
  }
  if (Determinant(m) < 0.0) // a mirror turns every front into a back
  {
    for (Triangle& triangle : mesh.Triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, std::hypot(m[axis], m[4 + axis], m[8 + axis]));
  }
  SurfaceOptions options;
  if (local.TouchedSide() != Side::Mixed)
  {
    options.TouchedSide = local.TouchedSide();
  }
  else
  {
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      const bool hasBack = local.TouchesBack(static_cast<std::int32_t>(i));
      mesh.Sides.push_back(hasBack ? Side::Both : Side::Front);
    }
  }
  options.Engine = local.Engine().Kind();
  // The longest axis bounds how a gap grows up to a factor of sqrt(3).
  options.CrackWidth = this->Prepared->CrackWidth() * longest * std::sqrt(3.0);
  this->Built = TriangleSurface::Build(std::move(mesh), options, this->ErrorText);
  if (!this->Built)
  {
    this->Outcome = CleaningResult::Failed;
  }
}
}
