#ifndef Haptics_SurfacePatch_h
#define Haptics_SurfacePatch_h

#include "haptics/Math/Vec3.h"
#include "haptics/Surface/SurfaceReport.h"
#include "vtkHapticsCoreModule.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace haptics
{
/// @brief All that is within a distance of a straight line: around where a hand is and will be.
struct PatchRegion
{
  Vec3 From{}; ///< the frame of the surface's points
  Vec3 To{};   ///< the same as From for a ball
  double Radius = 0.0;

  /// Distance of a point from the line.
  VTKHAPTICSCORE_EXPORT double DistanceTo(const Vec3& point) const noexcept;
  /// Whether a box meets the region; true also for some that only come near to a corner of it.
  VTKHAPTICSCORE_EXPORT bool MeetsBox(const Vec3& low, const Vec3& high) const noexcept;
  /// How much of the way from `from` to `to`, 0 to 1, a god-object at `from` may follow, so that
  /// nothing beyond the region matters: a god-object never comes farther from its HIP, so all that
  /// it can meet is in the ball about the HIP that it is on the rim of. 0 where `from` itself is
  /// beyond. `margin`: by which the region is taken to be smaller.
  VTKHAPTICSCORE_EXPORT double KnownPart(
    const Vec3& from, const Vec3& to, double margin) const noexcept;
};

/// @brief What belongs to a surface as a whole, where only a patch of it is in memory.
///
/// A patch that is built with it (SurfaceOptions::Whole) has the local frame, the clearance and the
/// side that the whole surface would have, so that contact with its triangles is the same, to the
/// last bit.
struct WholeSurface
{
  Vec3 Origin{};            ///< TriangleSurface::Origin()
  double Radius = 0.0;      ///< TriangleSurface::Radius()
  double Diagonal = 0.0;    ///< of the bounds
  double LongestEdge = 0.0; ///< of triangles that have an area
  double CrackWidth = 0.0;  ///< SurfaceOptions::CrackWidth, in use
  SurfaceReport Report;
  std::int64_t Triangles = 0;
  /// Another number after each change of the surface: patches with different ones are not of one
  /// surface.
  std::uint64_t Version = 0;
  ///@{
  /// The version of which this one is another shape: the same triangles, each point of which goes
  /// straight from where it was then to where it is. Radius and LongestEdge are of both shapes, the
  /// frame is that of the first in such a row. 0: of none.
  std::uint64_t Before = 0;
  double LongestWay = 0.0; ///< of a point, from that version on
  /// A coordinate of the local frame below it is 0; 0: NegligibleShare of Radius.
  double Negligible = 0.0;
  ///@}

  VTKHAPTICSCORE_EXPORT bool operator==(const WholeSurface& other) const noexcept;
};

/// @brief What a patch of a closed surface knows of that: how often it encloses one place.
///
/// A region is convex, so that the crossings of the straight way from there to any other place of
/// it, all of them in the patch, count what encloses that one.
struct PatchEnclosure
{
  bool IsCounted = false; ///< whether Anchor and Count are known
  Vec3 Anchor{};          ///< well in the region, and on no triangle; frame of the surface's points
  int Count = 0;          ///< of the whole surface: 1 inside, 0 outside
  /// Whether a surface that deforms may go over Anchor on its way: then Count is of its end only.
  bool IsSwept = false;
  /// A ball about Middle in which nothing of the whole surface is, and that one of the patch's
  /// triangles meets; 0: not known.
  double HollowRadius = 0.0;
  Vec3 Middle{};
};

/// @brief Which part of a whole surface a TriangleSurface is.
class SurfacePatch
{
public:
  /// `region` and `enclosure`: local frame; `margin`: what triangles outside of it can reach into
  /// it; `ids`: of the triangles in the whole surface, each once.
  SurfacePatch(std::shared_ptr<const WholeSurface> whole, const PatchRegion& region,
    const PatchEnclosure& enclosure, double margin, const std::vector<std::int64_t>& ids);

  const WholeSurface& Whole() const { return *this->Record; }
  /// Where everything is known that a god-object can meet, local frame.
  const PatchRegion& Region() const { return this->Known; }
  bool Knows(const Vec3& place) const noexcept
  {
    return this->Known.DistanceTo(place) <= this->Known.Radius;
  }
  const PatchEnclosure& Enclosure() const { return this->Sides; }
  /// Whether no triangle of the whole surface is nearer to a place than one of the patch at a
  /// `distance`.
  bool HoldsNearest(const Vec3& place, double distance) const noexcept;
  /// The triangle with an id; -1 where the patch does not have it.
  std::int32_t Find(std::int64_t id) const noexcept;
  std::int64_t IdOf(std::int32_t triangle) const { return this->Ids[triangle]; }

private:
  std::shared_ptr<const WholeSurface> Record;
  PatchRegion Known;
  PatchEnclosure Sides;
  std::vector<std::int64_t> Ids;
  std::vector<std::pair<std::int64_t, std::int32_t>> Sorted;
};
}

#endif
