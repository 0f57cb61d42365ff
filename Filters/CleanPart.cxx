#include "haptics/Filters/CleanPart.h"

#include "haptics/Filters/SurfaceCleaner.h"
#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Math/VectorMath.h"
#include "haptics/Surface/SurfaceSide.h"

#include <string>
#include <utility>

namespace haptics
{
CleanPart::CleanPart(vtkPolyData* cells, const CleaningFrame& frame)
{
  CleaningOptions options;
  options.Frame = &frame;
  CleanedMesh cleaned;
  std::string error; // the survey of the whole surface has reported it
  if (CleanSurface(cells, options, {}, cleaned, error) == CleaningResult::Done)
  {
    this->Mesh = std::move(cleaned.Mesh);
  }
}

std::optional<int> CleanPart::CountCrossings(const Vec3& from, const Vec3& to) const
{
  int count = 0;
  for (const auto& [a, b, c] : this->Mesh.Triangles)
  {
    const int crossing = CrossingOf(ToVector(from), ToVector(to), ToVector(this->Mesh.Points[a]),
      ToVector(this->Mesh.Points[b]), ToVector(this->Mesh.Points[c]));
    if (crossing == 2)
    {
      return std::nullopt;
    }
    count += crossing;
  }
  return count;
}

std::optional<Vec3> CleanPart::NearestTo(const Vec3& place) const
{
  std::optional<Vec3> nearest;
  double best = HUGE_VAL;
  const Vector x = ToVector(place);
  for (const auto& [a, b, c] : this->Mesh.Triangles)
  {
    const Vector way = NearestToOrigin(ToVector(this->Mesh.Points[a]) - x,
      ToVector(this->Mesh.Points[b]) - x, ToVector(this->Mesh.Points[c]) - x);
    if (glm::length(way) < best)
    {
      best = glm::length(way);
      nearest = ToVec3(x + way);
    }
  }
  return nearest;
}
}
