#include "haptics/Contact/SeparatingPlanes.h"

#include "haptics/Math/LaneMask.h"
#include "haptics/Math/VectorClones.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace haptics
{
namespace
{
// By value and without std::min's references, so that loops over them become vector instructions.
HAPTICS_ALWAYS_INLINE float Less(float x, float y)
{
  return x < y ? x : y;
}
HAPTICS_ALWAYS_INLINE float More(float x, float y)
{
  return x > y ? x : y;
}
HAPTICS_ALWAYS_INLINE float Choose(bool first, float x, float y)
{
  return first ? x : y;
}
/// A direction whose square is smaller has lost digits, and serves none.
constexpr float SmallestSquare = 1e-30F;
/// What float32 makes of a distance from a plane errs by less than 13 roundings (2^-24) of a unit
/// while the centre is within 2 units of the origin: 4 come of the normal, 2 of the place, 6 of the
/// products and sums, 1 of the offset. A way's share errs by as much of its length, a bound by a
/// few roundings of the way travelled.
constexpr float Error = 0x1p-20F;

/// Half of the lanes, as wide a vector of doubles as there is a register for.
using HalfOfDoubles = double __attribute__((vector_size(4 * SeparatingPlanes::Width)));
using HalfOfReals = float __attribute__((vector_size(2 * SeparatingPlanes::Width)));

/// The least of eight: a macro, as older machines' functions cannot take wide vectors alike.
#define HAPTICS_LEAST(values, least)                                                               \
  do                                                                                               \
  {                                                                                                \
    float all[SeparatingPlanes::Width];                                                            \
    std::memcpy(all, &(values), sizeof(all));                                                      \
    for (int half = SeparatingPlanes::Width / 2; half > 0; half /= 2)                              \
    {                                                                                              \
      for (int k = 0; k < half; ++k)                                                               \
      {                                                                                            \
        all[k] = all[k] < all[k + half] ? all[k] : all[k + half];                                  \
      }                                                                                            \
    }                                                                                              \
    (least) = all[0];                                                                              \
  } while (false)
}

SeparatingPlanes::SeparatingPlanes(std::int32_t capacity)
{
  const auto groups = static_cast<std::size_t>((capacity + Width - 1) / Width);
  this->Planes.resize(groups);
  this->Least.resize(groups);
  this->Found.resize(Width * groups);
}

void SeparatingPlanes::Restart(const Vector& origin, double radius)
{
  this->Groups = 0;
  this->Origin = origin;
  this->PerUnit = std::exp2(-std::ceil(std::log2(radius)));
  this->Way = 0.0F;
  this->Travel(origin, 0.0);
}

void SeparatingPlanes::Travel(const Vector& x, double length)
{
  this->Centre = x;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Place[axis] = static_cast<float>((x[axis] - this->Origin[axis]) * this->PerUnit);
  }
  this->Way += static_cast<float>(length * this->PerUnit) * (1.0F + Error);
}

void SeparatingPlanes::Set(std::int32_t i, const Vector& normal, double distance)
{
  Group& group = this->Planes[i / Width];
  const std::int32_t lane = i % Width;
  for (int axis = 0; axis < 3; ++axis)
  {
    group.Normal[axis][lane] = static_cast<float>(normal[axis]);
  }
  const double over = glm::dot(normal, this->Centre - this->Origin) - distance;
  group.Offset[lane] = static_cast<float>(over * this->PerUnit);
  const float bound = static_cast<float>(distance * this->PerUnit) + this->Way;
  group.Bound[lane] = bound;
  this->Least[i / Width] = std::min(this->Least[i / Width], bound);
}

/// The bound of what may be so near.
float SeparatingPlanes::Farthest(double distance) const
{
  const float way = this->Way + static_cast<float>(distance * this->PerUnit);
  return way + Error * (1.0F + way);
}

/// Of the nearest points of the three edges and of the plane within them, as BallFacet, but for
/// both sides and in float32: a plane that is less good separates all the same.
HAPTICS_VECTOR_CLONES
void SeparatingPlanes::Add(const Corners& corners, std::int32_t count)
{
  float units[9][Width]; // the corners, from the origin
  for (int k = 0; k < 9; ++k)
  {
    const double origin = this->Origin[k % 3];
    for (int half = 0; half < Width; half += Width / 2)
    {
      HalfOfDoubles places;
      std::memcpy(&places, &corners.Axes[k][half], sizeof(places));
      const auto values = __builtin_convertvector((places - origin) * this->PerUnit, HalfOfReals);
      std::memcpy(&units[k][half], &values, sizeof(values));
    }
  }
  Group& group = this->Planes[this->Groups];
  float normalX[Width], normalY[Width], normalZ[Width], bounds[Width];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep // all arrays are apart
#endif
  for (int i = 0; i < Width; ++i)
  {
    const float aX = units[0][i], aY = units[1][i], aZ = units[2][i];
    const float bX = units[3][i], bY = units[4][i], bZ = units[5][i];
    const float cX = units[6][i], cY = units[7][i], cZ = units[8][i];
    const float abX = bX - aX, abY = bY - aY, abZ = bZ - aZ;
    const float bcX = cX - bX, bcY = cY - bY, bcZ = cZ - bZ;
    const float caX = aX - cX, caY = aY - cY, caZ = aZ - cZ;
    // Where an edge is a point, 0/0 is taken for 0.
    const float onAb = Less(
      More(-(aX * abX + aY * abY + aZ * abZ) / (abX * abX + abY * abY + abZ * abZ), 0.0F), 1.0F);
    const float onBc = Less(
      More(-(bX * bcX + bY * bcY + bZ * bcZ) / (bcX * bcX + bcY * bcY + bcZ * bcZ), 0.0F), 1.0F);
    const float onCa = Less(
      More(-(cX * caX + cY * caY + cZ * caZ) / (caX * caX + caY * caY + caZ * caZ), 0.0F), 1.0F);
    // From the nearest points to the origin.
    const float awayAbX = -aX - onAb * abX, awayAbY = -aY - onAb * abY, awayAbZ = -aZ - onAb * abZ;
    const float awayBcX = -bX - onBc * bcX, awayBcY = -bY - onBc * bcY, awayBcZ = -bZ - onBc * bcZ;
    const float awayCaX = -cX - onCa * caX, awayCaY = -cY - onCa * caY, awayCaZ = -cZ - onCa * caZ;
    const float ab = awayAbX * awayAbX + awayAbY * awayAbY + awayAbZ * awayAbZ;
    const float bc = awayBcX * awayBcX + awayBcY * awayBcY + awayBcZ * awayBcZ;
    const float ca = awayCaX * awayCaX + awayCaY * awayCaY + awayCaZ * awayCaZ;
    const bool isBc = (bc < ab) & (bc <= ca);
    const bool isCa = (ca < ab) & (ca < bc);

    const float nX = caY * abZ - caZ * abY;
    const float nY = caZ * abX - caX * abZ;
    const float nZ = caX * abY - caY * abX;
    const float inAb =
      (nY * abZ - nZ * abY) * aX + (nZ * abX - nX * abZ) * aY + (nX * abY - nY * abX) * aZ;
    const float inBc =
      (nY * bcZ - nZ * bcY) * bX + (nZ * bcX - nX * bcZ) * bY + (nX * bcY - nY * bcX) * bZ;
    const float inCa =
      (nY * caZ - nZ * caY) * cX + (nZ * caX - nX * caZ) * cY + (nX * caY - nY * caX) * cZ;
    const float side = nX * aX + nY * aY + nZ * aZ > 0.0F ? -1.0F : 1.0F;
    const bool isOver = (inAb <= 0.0F) & (inBc <= 0.0F) & (inCa <= 0.0F);
    const float dX =
      Choose(isOver, side * nX, Choose(isBc, awayBcX, Choose(isCa, awayCaX, awayAbX)));
    const float dY =
      Choose(isOver, side * nY, Choose(isBc, awayBcY, Choose(isCa, awayCaY, awayAbY)));
    const float dZ =
      Choose(isOver, side * nZ, Choose(isBc, awayBcZ, Choose(isCa, awayCaZ, awayAbZ)));
    // As the direction's own coordinates would give it, but without waiting for those.
    const float squared =
      Choose(isOver, nX * nX + nY * nY + nZ * nZ, Choose(isBc, bc, Choose(isCa, ca, ab)));
    const float inverse = Choose(squared > SmallestSquare, 1.0F / std::sqrt(squared), 0.0F);
    const float uX = inverse * dX, uY = inverse * dY, uZ = inverse * dZ;
    const float distance = -More(
      uX * aX + uY * aY + uZ * aZ, More(uX * bX + uY * bY + uZ * bZ, uX * cX + uY * cY + uZ * cZ));
    const float farthest = More(
      aX * aX + aY * aY + aZ * aZ, More(bX * bX + bY * bY + bZ * bZ, cX * cX + cY * cY + cZ * cZ));
    normalX[i] = uX;
    normalY[i] = uY;
    normalZ[i] = uZ;
    bounds[i] = distance - Error * std::sqrt(farthest);
  }
  std::memcpy(&group.Normal[0], normalX, sizeof(normalX));
  std::memcpy(&group.Normal[1], normalY, sizeof(normalY));
  std::memcpy(&group.Normal[2], normalZ, sizeof(normalZ));
  std::memcpy(&group.Bound, bounds, sizeof(bounds));
  group.Offset = -group.Bound;
  for (std::int32_t lane = count; lane < Width; ++lane)
  {
    group.Bound[lane] = HUGE_VALF; // what no triangle is for is never near
  }
  HAPTICS_LEAST(group.Bound, this->Least[this->Groups]);
  ++this->Groups;
}

HAPTICS_VECTOR_CLONES
std::int32_t SeparatingPlanes::FindNear(
  const Vector& way, double length, double reach, double limit)
{
  const auto wayX = static_cast<float>(way.x * this->PerUnit);
  const auto wayY = static_cast<float>(way.y * this->PerUnit);
  const auto wayZ = static_cast<float>(way.z * this->PerUnit);
  const auto units = static_cast<float>(length * this->PerUnit);
  const float fromX = this->Place[0], fromY = this->Place[1], fromZ = this->Place[2];
  const float travelled = this->Way;
  const float error = Error * (1.0F + units + travelled);
  const float farthest = travelled + static_cast<float>((reach + length) * this->PerUnit) + error;
  const float enough = static_cast<float>(reach * this->PerUnit) + error;
  // The last number that is not above the limit.
  const auto rounded = static_cast<float>(limit);
  const float latest = rounded > limit ? std::nextafter(rounded, 0.0F) : rounded;
  std::int32_t found = 0;
  for (std::int32_t g = 0; g < this->Groups; ++g)
  {
    if (this->Least[g] > farthest)
    {
      continue;
    }
    Group& group = this->Planes[g];
    const Reals over =
      (group.Normal[0] * fromX + group.Normal[1] * fromY + group.Normal[2] * fromZ) - group.Offset;
    const Reals along = group.Normal[0] * wayX + group.Normal[1] * wayY + group.Normal[2] * wayZ;
    const Reals least = over + (along < 0.0F ? along : Reals{});
    const Reals fromHere = over + (travelled - error);
    const Reals bound = group.Bound > fromHere ? group.Bound : fromHere;
    group.Bound = bound;
    HAPTICS_LEAST(bound, this->Least[g]);
    unsigned lanes = MaskOf((least < enough) & (bound <= farthest));
    if (lanes == 0)
    {
      continue;
    }
    const Reals left = (over - enough) * (1.0F - Error);
    const Reals entries = left > 0.0F ? left / -along : Reals{};
    lanes &= MaskOf(entries <= latest);
    EightLanes numbers;
    std::memcpy(&numbers, &entries, sizeof(numbers));
    EightLanes triangles = Width * g + EightLanes{ 0, 1, 2, 3, 4, 5, 6, 7 };
    PutSetFirst(lanes, numbers);
    PutSetFirst(lanes, triangles);
    WritePairs(numbers, triangles, &this->Found[found]); // what follows is overwritten too
    found += __builtin_popcount(lanes);
  }
  return found;
}
}
