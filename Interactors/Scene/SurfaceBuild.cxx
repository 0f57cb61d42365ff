#include "haptics/Scene/SurfaceBuild.h"

#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/SurfacePatch.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <optional>
#include <utility>

namespace haptics
{
namespace
{
/// The least and the largest factor by which a matrix stretches a vector.
std::pair<double, double> StretchesOf(const Matrix4& matrix)
{
  const double linear[3][3] = { { matrix[0], matrix[1], matrix[2] },
    { matrix[4], matrix[5], matrix[6] }, { matrix[8], matrix[9], matrix[10] } };
  double u[3][3];
  double stretches[3];
  double v[3][3];
  vtkMath::SingularValueDecomposition3x3(linear, u, stretches, v);
  const auto magnitude = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return { std::abs(*std::min_element(stretches, stretches + 3, magnitude)),
    std::abs(*std::max_element(stretches, stretches + 3, magnitude)) };
}

/// The options for a patch of a surface where a matrix takes it. `origin`: of the patch's frame.
void PlacePatch(
  const SurfacePatch& patch, const Vec3& origin, const Matrix4& matrix, SurfaceOptions& options)
{
  const auto [least, most] = StretchesOf(matrix);
  auto whole = std::make_shared<WholeSurface>(patch.Whole());
  whole->Origin = Transformed(matrix, whole->Origin);
  whole->Radius *= most;
  whole->Diagonal *= most;
  whole->LongestEdge *= most;
  whole->LongestWay *= most;
  whole->Negligible *= most;
  whole->CrackWidth = options.CrackWidth;
  options.Whole = std::move(whole);
  const auto placed = [&](const Vec3& p) {
    return Transformed(matrix, { p[0] + origin[0], p[1] + origin[1], p[2] + origin[2] });
  };
  options.Region = patch.Region();
  options.Region.From = placed(options.Region.From);
  options.Region.To = placed(options.Region.To);
  options.Region.Radius *= least; // all of that is known
  options.Enclosure = patch.Enclosure();
  options.Enclosure.Anchor = placed(options.Enclosure.Anchor);
  options.Enclosure.Middle = placed(options.Enclosure.Middle);
  // What is nearest before a matrix that stretches is taken for it after that.
  options.Enclosure.HollowRadius *= most;
}
}

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
  const double duration = this->DurationFor(this->Shaper->LongestWay(points));
  std::string error; // whatever it is, building anew helps or says why not
  this->Built = this->JumpedBy > 0.0 ? this->Shaper->Replace(std::move(points), error)
                                     : this->Shaper->Deform(std::move(points), duration, error);
  return this->Built != nullptr;
}

/// How long a deformation takes whose points go no farther than `way`, unless that is a jump.
double SurfaceBuild::DurationFor(double way)
{
  this->JumpedBy = way > this->LargestSpeed * LongestMotion ? way : 0.0;
  const double needed = GodObject::Haste * way / this->LargestSpeed; // it may be hastened
  return std::max(this->Duration, needed);
}

/// Has a patch deform from the version in force, where it is that in another shape.
void SurfaceBuild::DeformPatch()
{
  const PatchRecord* const patch = this->Prepared->PatchOf();
  const SurfacePatch* const before = this->Before ? this->Before->Patch() : nullptr;
  if (patch && before && patch->Whole.Before != 0 && patch->Whole.Before == before->Whole().Version)
  {
    const double duration =
      this->DurationFor(patch->Whole.LongestWay * StretchesOf(this->Baked).second);
    if (this->JumpedBy == 0.0)
    {
      this->Prepared->DeformOver(duration);
    }
  }
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
    this->DeformPatch();
    this->BuildAnew();
    const bool goesOn = this->Before && this->Built && this->Built->GoesOnFrom(*this->Before);
    if (this->Built && this->Built->Deforms() && !goesOn)
    {
      this->Built = this->Built->AtRest();
    }
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
  const ProgressCall report = [this](double fraction)
  { return this->Report(fraction) && (!this->Listener || this->Listener(fraction)); };
  if (!report(0.0))
  {
    return;
  }
  // A matrix has the surface built once more.
  const bool isBaked = this->Baked != IdentityMatrix;
  const double share = !this->IsNew ? 0.0 : isBaked ? 0.5 : 1.0;
  this->Outcome =
    this->IsNew ? this->Prepared->Run(PartOf(report, 0.0, share)) : CleaningResult::Done;
  if (this->Outcome == CleaningResult::Done)
  {
    this->Built = this->Prepared->Surface();
    if (isBaked)
    {
      this->Bake(*this->Built, PartOf(report, share, 1.0));
    }
  }
}

void SurfaceBuild::Bake(const TriangleSurface& local, const ProgressCall& progress)
{
  const Matrix4& m = this->Baked;
  TriangleMesh mesh;
  mesh.Triangles = local.Triangles();
  if (local.Patch())
  {
    mesh.Ids.reserve(mesh.Triangles.size());
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      mesh.Ids.push_back(local.Patch()->IdOf(static_cast<std::int32_t>(i)));
    }
  }
  const Vec3& o = local.Origin();
  const auto place = [&](const Vec3& p) {
    return Transformed(m, { p[0] + o[0], p[1] + o[1], p[2] + o[2] });
  };
  mesh.Points.reserve(local.Points().size());
  std::transform(
    local.Points().begin(), local.Points().end(), std::back_inserter(mesh.Points), place);
  if (local.Patch() && local.Deforms())
  {
    std::transform(local.StartPoints()->begin(), local.StartPoints()->end(),
      std::back_inserter(mesh.Starts), place);
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
  if (local.Patch())
  {
    PlacePatch(*local.Patch(), o, m, options);
    options.DeformDuration =
      local.Deforms() ? std::optional<double>(local.DeformDuration()) : std::nullopt;
  }
  this->Built = TriangleSurface::Build(std::move(mesh), options, this->ErrorText, progress);
  if (!this->Built)
  {
    this->Outcome = this->ErrorText.empty() ? CleaningResult::Aborted : CleaningResult::Failed;
  }
}
}
