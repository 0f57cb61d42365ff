#include "haptics/Contact/FacetTable.h"

#include "haptics/Math/Predicates.h"
#include "haptics/Math/VectorClones.h"
#include "haptics/Surface/CornerPrefetch.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace haptics
{
namespace
{
/// Columns are worked out in fours, without a rest: what is beyond the last row is infinitely far.
constexpr std::int32_t RowsAtOnce = 4;
HAPTICS_ALWAYS_INLINE std::int32_t WholeRows(std::int32_t count)
{
  return (count + RowsAtOnce - 1) / RowsAtOnce * RowsAtOnce;
}

/// Of x from planes whose offsets are relative to the same origin.
HAPTICS_VECTOR_CLONES
void DistancesFrom(const Vector& x, std::int32_t count, const double* nx, const double* ny,
  const double* nz, const double* offset, double* __restrict distances)
{
  const double x0 = x.x, x1 = x.y, x2 = x.z;
  const std::int32_t end = WholeRows(count);
  for (std::int32_t i = 0; i < end; ++i)
  {
    distances[i] = nx[i] * x0 + ny[i] * x1 + nz[i] * x2 - offset[i];
  }
}

/// One bit each.
constexpr auto Bits = []
{
  std::array<std::uint64_t, 64> bits{};
  for (std::size_t i = 0; i < bits.size(); ++i)
  {
    bits[i] = std::uint64_t(1) << i;
  }
  return bits;
}();

/// The same for up to 64 rows. Returns those whose distance is at most its limit.
HAPTICS_VECTOR_CLONES
std::uint64_t DistancesUpTo(const double* limits, const Vector& x, std::int32_t count,
  const double* nx, const double* ny, const double* nz, const double* offset,
  double* __restrict distances)
{
  const double x0 = x.x, x1 = x.y, x2 = x.z;
  const std::int32_t end = WholeRows(count);
  std::uint64_t rows = 0;
  for (std::int32_t i = 0; i < end; ++i)
  {
    const double distance = nx[i] * x0 + ny[i] * x1 + nz[i] * x2 - offset[i];
    distances[i] = distance;
    rows |= distance <= limits[i] ? Bits[i] : 0;
  }
  return rows;
}

/// See FacetTable::Limits. Returns the least distance from any plane, less its error.
HAPTICS_VECTOR_CLONES
double LimitsOf(std::int32_t count, const double* distance, const double* error,
  const double* clearance, double* __restrict limits)
{
  using Rows = double __attribute__((vector_size(sizeof(double) * RowsAtOnce)));
  Rows nearest = Rows{} + HUGE_VAL;
  for (std::int32_t i = 0; i < count; i += RowsAtOnce)
  {
    Rows d, e, c;
    std::memcpy(&d, distance + i, sizeof(d));
    std::memcpy(&e, error + i, sizeof(e));
    std::memcpy(&c, clearance + i, sizeof(c));
    const Rows half = 0.5 * c;
    const Rows least = half < d ? half : d;
    const Rows value = least > e ? least : e;
    const Rows limit = d < -e ? Rows{} - HUGE_VAL : value;
    std::memcpy(limits + i, &limit, sizeof(limit));
    const Rows away = (d < 0.0 ? -d : d) - e;
    nearest = away < nearest ? away : nearest;
  }
  return std::min(std::min(nearest[0], nearest[1]), std::min(nearest[2], nearest[3]));
}

/// The list of what short motions may touch is made for some so many times as long as the first.
constexpr double TimesShort = 16.0;
}

FacetTable::FacetTable(std::shared_ptr<const TriangleSurface> surface, std::size_t capacity)
  : Geometry(std::move(surface))
  , Triangles(capacity)
  , Flipped(capacity)
  , Widths(capacity)
  , Met((capacity + RowsInMask - 1) / RowsInMask)
{
  for (auto* values :
    { &this->NormalX, &this->NormalY, &this->NormalZ, &this->PlaneOffset, &this->Errors,
      &this->Clearances, &this->Distances, &this->TargetDistances, &this->Limits, &this->Low[0],
      &this->Low[1], &this->Low[2], &this->High[0], &this->High[1], &this->High[2] })
  {
    values->resize(WholeRows(static_cast<std::int32_t>(capacity)));
  }
}

void FacetTable::Clear(const Vector& centre)
{
  this->Middle = centre;
  this->Count = 0;
  this->LastTouched = -1;
  this->HasThinFacets = false;
  this->ShortReach = -1.0;
}

bool FacetTable::TakeOver(const FacetTable& previous)
{
  constexpr std::int32_t most = 4096;
  this->Clear(previous.Middle);
  const std::int32_t count = previous.Count;
  if (count > most || static_cast<std::size_t>(count) > this->Triangles.size())
  {
    return false;
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    this->Triangles[i] =
      this->Geometry.Surface().FindSame(previous.Geometry.Surface(), previous.Triangles[i]);
    if (this->Triangles[i] < 0)
    {
      return false;
    }
  }
  const auto copy = [count](const auto& from, auto& to)
  { std::copy_n(from.begin(), count, to.begin()); };
  copy(previous.Flipped, this->Flipped);
  copy(previous.Widths, this->Widths);
  copy(previous.NormalX, this->NormalX);
  copy(previous.NormalY, this->NormalY);
  copy(previous.NormalZ, this->NormalZ);
  copy(previous.PlaneOffset, this->PlaneOffset);
  for (int axis = 0; axis < 3; ++axis)
  {
    copy(previous.Low[axis], this->Low[axis]);
    copy(previous.High[axis], this->High[axis]);
  }
  copy(previous.Errors, this->Errors);
  copy(previous.Clearances, this->Clearances);
  copy(previous.Distances, this->Distances);
  copy(previous.TargetDistances, this->TargetDistances);
  copy(previous.Limits, this->Limits);
  std::copy_n(previous.Met.begin(), (count + RowsInMask - 1) / RowsInMask, this->Met.begin());
  this->From = previous.From;
  this->To = previous.To;
  this->IsFromMeasured = previous.IsFromMeasured;
  this->IsToMeasured = previous.IsToMeasured;
  this->IsToClear = previous.IsToClear;
  this->HasThinFacets = previous.HasThinFacets;
  this->LastTouched = previous.LastTouched;
  this->Count = count;
  this->Nearest = previous.Nearest;
  this->FillRest();
  return true;
}

double FacetTable::Fill(const TriangleList& found, const FacetBatch::Question& question)
{
  this->Clear(question.Centre);
  this->IsToMeasured = false;
  double nearest = HUGE_VAL;
  PrefetchCorners(this->Geometry.Surface(), found.Indices, found.Count);
  FacetBatch batch;
  for (std::int32_t start = 0; start < found.Count; start += FacetBatch::Capacity)
  {
    const std::int32_t size = std::min(FacetBatch::Capacity, found.Count - start);
    for (std::int32_t k = 0; k < size; ++k)
    {
      const auto [a, b, c] = this->Geometry.CornersOf(found.Indices[start + k]);
      batch.Set(k, a, b, c);
    }
    batch.Answer(size, question);
    for (std::int32_t k = 0; k < size; ++k)
    {
      if (!batch.Meets(k))
      {
        continue;
      }
      const std::int32_t i = this->Count;
      this->Triangles[i] = found.Indices[start + k];
      this->Flipped[i] = 0;
      this->Widths[i] = Width::Broad;
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Low[axis][i] = batch.Low(k, axis);
        this->High[axis][i] = batch.High(k, axis);
      }
      if (batch.IsWellKnown(k))
      {
        this->NormalX[i] = batch.Normal(k, 0);
        this->NormalY[i] = batch.Normal(k, 1);
        this->NormalZ[i] = batch.Normal(k, 2);
        this->PlaneOffset[i] = batch.PlaneOffset(k);
        this->Errors[i] = batch.Error(k);
        this->Clearances[i] = batch.Clearance(k);
      }
      else if (!this->FillThin(i, question))
      {
        continue;
      }
      nearest = std::min(nearest, batch.SquaredDistance(k));
      ++this->Count;
    }
  }
  this->FillRest();
  return std::sqrt(nearest);
}

/// Rows after the last one, which are worked out with it.
void FacetTable::FillRest()
{
  for (std::int32_t i = this->Count; i < WholeRows(this->Count); ++i)
  {
    this->NormalX[i] = this->NormalY[i] = this->NormalZ[i] = 0.0;
    this->PlaneOffset[i] = -HUGE_VAL;
    this->Errors[i] = this->Clearances[i] = 0.0;
  }
}

/// Whether a thin triangle's longest edge is one of a broad triangle's too, which goes on from it
/// in the same orientation and is touched from the same sides, and no edge of it is open.
bool FacetTable::IsSeam(std::int32_t triangle, const Facet& facet, double clearance) const
{
  if (!(facet.SmallestHeight < GrowthOverSharedEdges * clearance))
  {
    return false;
  }
  const auto& neighbours = this->Geometry.Surface().AdjacentTriangles()[triangle];
  const std::int32_t other = neighbours[(facet.Anchor + 1) % 3];
  if (*std::min_element(neighbours.begin(), neighbours.end()) < 0 ||
    this->Geometry.Surface().TouchesBack(triangle) != this->Geometry.Surface().TouchesBack(other))
  {
    return false;
  }
  const auto& corners = this->Geometry.Surface().Triangles()[triangle];
  const std::int32_t from = corners[(facet.Anchor + 1) % 3];
  const std::int32_t to = corners[(facet.Anchor + 2) % 3];
  const auto& others = this->Geometry.Surface().Triangles()[other];
  const auto place = std::find(others.begin(), others.end(), to) - others.begin();
  if (place == 3 || others[(place + 1) % 3] != from)
  {
    return false;
  }
  const auto [a, b, c] = this->Geometry.CornersOf(other);
  return Facet(a, b, c).SmallestHeight >= clearance;
}

/// The plane of a thin triangle. False where it has no area.
bool FacetTable::FillThin(std::int32_t i, const FacetBatch::Question& question)
{
  const auto [a, b, c] = this->Geometry.CornersOf(this->Triangles[i]);
  const Facet facet(a, b, c);
  if (!facet.HasArea())
  {
    return false;
  }
  const Vector from = facet.Corner[facet.Anchor] - this->Middle;
  const double reach = glm::length(from) + question.Farthest;
  this->NormalX[i] = facet.Normal.x;
  this->NormalY[i] = facet.Normal.y;
  this->NormalZ[i] = facet.Normal.z;
  this->PlaneOffset[i] = glm::dot(facet.Normal, from);
  this->Errors[i] = facet.DistanceError(reach);
  this->Clearances[i] = facet.Clearance(question.MinimumClearance, reach);
  this->Widths[i] = Width::Broad;
  if (facet.SmallestHeight < this->Clearances[i])
  {
    this->Widths[i] =
      this->IsSeam(this->Triangles[i], facet, this->Clearances[i]) ? Width::Seam : Width::Wire;
    this->HasThinFacets = true;
    this->Errors[i] = HUGE_VAL; // that of the triangle's plane, which is not known here
  }
  return true;
}

void FacetTable::MeasurePosition()
{
  DistancesFrom(this->From - this->Middle, this->Count, this->NormalX.data(), this->NormalY.data(),
    this->NormalZ.data(), this->PlaneOffset.data(), this->Distances.data());
  this->IsFromMeasured = true;
  this->IsToMeasured = false; // that was for other facets or limits
  this->ShortReach = -1.0;
  this->TurnToPosition();
  this->SetLimits();
}

void FacetTable::MeasureTarget(const Vector& to)
{
  this->To = to;
  const Vector x = to - this->Middle;
  std::uint64_t met = 0;
  for (std::int32_t i = 0; i < this->Count; i += RowsInMask)
  {
    met |= this->Met[i / RowsInMask] = DistancesUpTo(this->Limits.data() + i, x,
      std::min(this->Count - i, RowsInMask), this->NormalX.data() + i, this->NormalY.data() + i,
      this->NormalZ.data() + i, this->PlaneOffset.data() + i, this->TargetDistances.data() + i);
  }
  this->IsToMeasured = true;
  this->IsToClear = met == 0;
}

void FacetTable::TurnToPosition()
{
  if (this->HasThinFacets)
  {
    this->TurnThin();
  }
  if (this->Geometry.Surface().TouchedSide() == Side::Front)
  {
    return;
  }
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    if (this->Distances[i] > this->Errors[i] || this->Widths[i] != Width::Broad ||
      !this->Geometry.Surface().TouchesBack(this->Triangles[i]))
    {
      continue;
    }
    bool isBehind = this->Distances[i] < 0.0;
    if (std::abs(this->Distances[i]) <= this->Errors[i])
    {
      const auto [a, b, c] = this->Geometry.CornersOf(this->Triangles[i]);
      const int side = Orientation(a, b, c, this->From);
      isBehind = (this->Flipped[i] ? -side : side) < 0;
    }
    if (isBehind)
    {
      this->Flipped[i] ^= 1;
      for (auto* values :
        { &this->NormalX, &this->NormalY, &this->NormalZ, &this->PlaneOffset, &this->Distances })
      {
        (*values)[i] = -(*values)[i];
      }
    }
  }
}

void FacetTable::TurnThin()
{
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    if (this->Widths[i] == Width::Broad)
    {
      continue;
    }
    const auto [a, b, c] = this->Geometry.CornersOf(this->Triangles[i]);
    const bool isBehind = Orientation(a, b, c, this->From) < 0;
    this->Flipped[i] = isBehind && this->Geometry.Surface().TouchesBack(this->Triangles[i]) ? 1 : 0;
    if (this->Widths[i] == Width::Seam)
    {
      this->Distances[i] = -std::numeric_limits<double>::max(); // nothing meets it
      continue;
    }
    const Facet facet(a, b, c);
    const Vector& anchor = facet.Corner[facet.Anchor];
    const Vector along =
      glm::normalize(facet.Corner[(facet.Anchor + 2) % 3] - facet.Corner[(facet.Anchor + 1) % 3]);
    const Vector from = this->From - anchor;
    const Vector across = from - glm::dot(from, along) * along;
    const double distance = glm::length(across);
    // Nearer than rounding the direction is not known. Else what rounding of a longer way along the
    // line has left of that is taken out.
    const bool isKnown = distance > 0.125 * this->Clearances[i];
    const Vector normal = isKnown
      ? glm::normalize(across / distance - glm::dot(across / distance, along) * along)
      : (isBehind ? -facet.Normal : facet.Normal);
    this->NormalX[i] = normal.x;
    this->NormalY[i] = normal.y;
    this->NormalZ[i] = normal.z;
    this->PlaneOffset[i] = glm::dot(normal, anchor - this->Middle);
    // What is behind one that has only a front may go where it wants.
    this->Distances[i] = isBehind && !this->Geometry.Surface().TouchesBack(this->Triangles[i])
      ? -std::numeric_limits<double>::max()
      : glm::dot(normal, from);
  }
}

void FacetTable::SetLimits()
{
  this->Nearest = LimitsOf(this->Count, this->Distances.data(), this->Errors.data(),
    this->Clearances.data(), this->Limits.data());
}

bool FacetTable::MoveToTarget()
{
  this->SetPosition(this->To);
  this->IsFromMeasured = this->IsToMeasured;
  if (this->IsToMeasured)
  {
    std::swap(this->Distances, this->TargetDistances);
    this->IsToMeasured = false;
    this->TurnToPosition();
    this->SetLimits();
  }
  return this->IsFromMeasured;
}

std::int32_t FacetTable::FindTouched(const Vector& to)
{
  if (!this->HasTarget(to))
  {
    this->MeasureTarget(to);
  }
  std::int32_t touched = -1;
  this->VisitMet(
    [&](std::int32_t i)
    {
      const double after = this->TargetDistances[i];
      const bool isTouched =
        after <= this->Errors[i] && this->MeetsBox(i, to, 0.0) && this->Touches(i, after, to);
      touched = isTouched ? i : -1;
      return !isTouched;
    });
  this->LastTouched = touched < 0 ? this->LastTouched : touched;
  return touched;
}

void FacetTable::ListShort(double reach)
{
  this->ShortCount = 0;
  this->ShortReach = reach;
  for (std::int32_t i = 0; i < this->Count && this->ShortCount <= MostShortRows; ++i)
  {
    if (this->Distances[i] < -this->Errors[i] || !this->MeetsBox(i, this->From, reach))
    {
      continue;
    }
    if (this->ShortCount < MostShortRows)
    {
      const auto [a, b, c] = this->Geometry.CornersOf(this->Triangles[i]);
      this->ShortRows[this->ShortCount] = { i, TriangleSeenFrom(this->From, a, b, c) };
    }
    ++this->ShortCount;
  }
}

std::int32_t FacetTable::FindTouchedShort(const Vector& to)
{
  const Vector way = to - this->From;
  const double reach =
    std::max({ std::abs(way.x), std::abs(way.y), std::abs(way.z) }) * (1.0 + 4.0 * UnitRoundoff);
  if (!(reach <= this->ShortReach))
  {
    this->ListShort(TimesShort * reach);
  }
  if (this->ShortCount > MostShortRows)
  {
    return this->FindTouched(to);
  }
  for (std::int32_t k = 0; k < this->ShortCount; ++k)
  {
    const std::int32_t i = this->ShortRows[k].Row;
    const double after = this->DistanceOf(i, to);
    if (after > this->Errors[i])
    {
      continue;
    }
    const auto answer = this->ShortRows[k].FromHere.Ask(way);
    const bool isThrough = answer == TriangleSeenFrom::Answer::Meets && after < -this->Errors[i] &&
      this->Distances[i] > this->Errors[i];
    if (isThrough || (answer != TriangleSeenFrom::Answer::Misses && this->Touches(i, after, to)))
    {
      this->LastTouched = i;
      return i;
    }
  }
  this->MeasureTarget(to);
  return -1;
}

bool FacetTable::StillTouches(const Vector& to) const
{
  const std::int32_t i = this->LastTouched;
  if (i < 0 || !this->IsFromMeasured || !(this->Distances[i] >= -this->Errors[i]))
  {
    return false;
  }
  const double after = this->DistanceOf(i, to);
  return after <= this->Errors[i] && this->MeetsBox(i, to, 0.0) && this->Touches(i, after, to);
}

/// `distance`: of `to` from the triangle's plane, as measured.
bool FacetTable::Touches(std::int32_t i, double distance, const Vector& to) const
{
  const Vector& from = this->From;
  auto [a, b, c] = this->Geometry.CornersOf(this->Triangles[i]);
  if (this->Flipped[i])
  {
    std::swap(b, c);
  }
  const int before = this->Distances[i] > this->Errors[i] ? 1 : Orientation(a, b, c, from);
  if (before < 0)
  {
    return false;
  }
  const int after = distance < -this->Errors[i] ? -1 : Orientation(a, b, c, to);
  if (after > 0 || (before == 0 && after == 0))
  {
    return false;
  }
  return LineMeetsTriangle(from, to, a, b, c);
}

FacetTable::Rims FacetTable::FindRims(double clearances) const
{
  std::array<std::int32_t, 8> found;
  std::size_t count = 0;
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    const std::int32_t triangle = this->Triangles[i];
    const double reach = clearances * this->Clearances[i];
    if (!this->Geometry.HasOpenEdge(triangle) || !this->MeetsBox(i, this->From, reach))
    {
      continue;
    }
    const auto [a, b, c] = this->Geometry.CornersOf(triangle);
    const Vector* const corners[4] = { &a, &b, &c, &a };
    bool isNear = false;
    for (int k = 0; k < 3; ++k)
    {
      const Vector nearest = NearestOnSegment(*corners[k], *corners[k + 1], this->From);
      isNear = isNear ||
        (this->Geometry.IsOpenEdge(triangle, k) &&
          SquaredLength(nearest - this->From) <= reach * reach);
    }
    if (!isNear)
    {
      continue;
    }
    const auto& ends = this->Geometry.Surface().Triangles()[triangle];
    const bool isJoined = std::all_of(found.begin(), found.begin() + count,
      [&](std::int32_t other)
      {
        const auto& others = this->Geometry.Surface().Triangles()[other];
        return std::find_first_of(ends.begin(), ends.end(), others.begin(), others.end()) !=
          ends.end();
      });
    if (!isJoined || count == found.size())
    {
      return Rims::Apart;
    }
    found[count++] = triangle;
  }
  return count > 0 ? Rims::Joined : Rims::None;
}
}
