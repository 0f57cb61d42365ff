#ifndef Haptics_SurfaceInPatches_h
#define Haptics_SurfaceInPatches_h

#include "AnalyticSurfaces.h"
#include "ProfileSurfaces.h"
#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Math/VectorMath.h"
#include "haptics/Surface/SurfaceSide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace haptics::testing
{
using SurfacePointer = std::shared_ptr<const TriangleSurface>;

/// A surface, and patches of it.
class SurfaceInPatches
{
public:
  explicit SurfaceInPatches(TriangleMesh mesh)
    : Mesh(std::move(mesh))
    , Surface(MakeSurface(Mesh, Side::Automatic))
    , Record(std::make_shared<const WholeSurface>(Surface->Whole()))
  {
  }

  SurfacePointer Whole() const { return this->Surface; }

  /// `enclosure`: of a surface that encloses; by default the patch encloses nothing.
  SurfacePointer Patch(const PatchRegion& region, const PatchEnclosure& enclosure = {}) const
  {
    TriangleMesh mesh;
    std::vector<std::int32_t> places(this->Mesh.Points.size(), -1);
    for (std::size_t i = 0; i < this->Mesh.Triangles.size(); ++i)
    {
      Triangle t = this->Mesh.Triangles[i];
      Vec3 low = this->Mesh.Points[t[0]];
      Vec3 high = low;
      for (const std::int32_t corner : t)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], this->Mesh.Points[corner][axis]);
          high[axis] = std::max(high[axis], this->Mesh.Points[corner][axis]);
        }
      }
      if (!region.MeetsBox(low, high))
      {
        continue;
      }
      for (std::int32_t& corner : t)
      {
        if (places[corner] < 0)
        {
          places[corner] = static_cast<std::int32_t>(mesh.Points.size());
          mesh.Points.push_back(this->Mesh.Points[corner]);
        }
        corner = places[corner];
      }
      mesh.Triangles.push_back(t);
      mesh.Ids.push_back(static_cast<std::int64_t>(i));
    }
    SurfaceOptions options;
    options.Whole = this->Record;
    options.Region = region;
    options.Enclosure = enclosure;
    std::string error;
    SurfacePointer patch = TriangleSurface::Build(std::move(mesh), options, error);
    EXPECT_TRUE(patch) << error;
    return patch;
  }
  /// A patch that encloses what the whole does; `isUpToSurface`: it reaches the place of that which
  /// is nearest to the region's start.
  SurfacePointer EnclosedPatch(PatchRegion region, bool isUpToSurface) const
  {
    const Vector start = ToVector(region.From);
    PatchEnclosure enclosure;
    enclosure.IsCounted = true;
    enclosure.Anchor = region.From;
    const Vector outside = start + 10.0 * this->Record->Diagonal * Vector(0.57, 0.61, 0.55);
    Vector nearest(HUGE_VAL);
    for (const Triangle& t : this->Mesh.Triangles)
    {
      const auto corner = [&](int k) { return ToVector(this->Mesh.Points[t[k]]); };
      enclosure.Count += CrossingOf(start, outside, corner(0), corner(1), corner(2));
      const Vector way = NearestToOrigin(corner(0) - start, corner(1) - start, corner(2) - start);
      nearest = glm::length(way) < glm::length(nearest) ? way : nearest;
    }
    if (isUpToSurface)
    {
      enclosure.Middle = region.From;
      enclosure.HollowRadius = glm::length(nearest);
      region.From = ToVec3(start + nearest);
      region.Radius += region.DistanceTo(enclosure.Middle);
    }
    return this->Patch(region, enclosure);
  }
  SurfacePointer Ball(const Vec3& centre, double radius) const
  {
    return this->Patch({ centre, centre, radius });
  }

private:
  TriangleMesh Mesh;
  SurfacePointer Surface;
  std::shared_ptr<const WholeSurface> Record;
};

/// A block of half size 60 mm with rough ground on top [m].
inline TriangleMesh RoughBlock(int cells)
{
  return HeightBlock(
    [](double x, double y) {
      return 0.002 * std::sin(400.0 * x) * std::cos(310.0 * y) + 0.0007 * std::sin(1900.0 * x + y);
    },
    0.06, cells);
}
}

#endif
