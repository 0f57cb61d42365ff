#include "haptics/Filters/SurfaceCensus.h"

#include "haptics/Filters/PointMerger.h"
#include "haptics/Math/VectorMath.h"
#include "haptics/Surface/Facet.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

namespace haptics
{
namespace
{
/// Of the largest coordinate: places that are one differ by no more.
constexpr double RoundingShare = 0x1p-50;

/// Whether a - b has no rounding (Knuth's two-sum).
bool IsExactDifference(double a, double b)
{
  const double difference = a - b;
  const double minusB = difference - a;
  return a - (difference - minusB) == 0.0 && b + minusB == 0.0;
}

Vec3 MiddleOf(const PartBox& box)
{
  return { box.Low[0] + 0.5 * (box.High[0] - box.Low[0]),
    box.Low[1] + 0.5 * (box.High[1] - box.Low[1]), box.Low[2] + 0.5 * (box.High[2] - box.Low[2]) };
}

/// Where a point is in the frame, as PointMerger compares it.
Vec3 PlaceOf(const Vec3& point, const Vec3& origin)
{
  // -0.0 is 0.0
  return { point[0] - origin[0] + 0.0, point[1] - origin[1] + 0.0, point[2] - origin[2] + 0.0 };
}

std::int32_t FindRoot(std::vector<std::int32_t>& parents, std::int32_t i)
{
  while (parents[i] != i)
  {
    i = parents[i] = parents[parents[i]];
  }
  return i;
}

void Join(std::vector<std::int32_t>& parents, std::int32_t i, std::int32_t j)
{
  parents[FindRoot(parents, i)] = FindRoot(parents, j);
}

/// Adds an edge to the counts so many times; `up` and `down`: its triangles, by orientation.
void CountEdge(std::int64_t up, std::int64_t down, std::int64_t times, SurfaceReport& counts)
{
  const std::int64_t triangles = up + down;
  counts.BoundaryEdges += triangles == 1 ? times : 0;
  counts.NonManifoldEdges += triangles > 2 ? times : 0;
  counts.FlippedEdges += triangles == 2 && up != 1 ? times : 0;
}

bool StrictlyWithin(const PartBox& inner, const PartBox& outer)
{
  bool isWithin = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isWithin = isWithin && outer.Low[axis] < inner.Low[axis] && inner.High[axis] < outer.High[axis];
  }
  return isWithin;
}

void Widen(ArrayRanges& ranges, const std::string& name, const std::array<double, 2>& range)
{
  const auto [place, isNew] = ranges.emplace(name, range);
  if (!isNew)
  {
    place->second = { std::min(place->second[0], range[0]), std::max(place->second[1], range[1]) };
  }
}

void AddRangesOf(
  vtkDataSetAttributes* data, const std::vector<vtkIdType>& elements, ArrayRanges& ranges)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = data->GetArray(i);
    if (!array || !array->GetName() || array->GetNumberOfComponents() != 1)
    {
      continue;
    }
    std::array<double, 2> range{ HUGE_VAL, -HUGE_VAL };
    for (const vtkIdType element : elements)
    {
      const double value =
        element < array->GetNumberOfTuples() ? array->GetComponent(element, 0) : NAN;
      if (std::isfinite(value))
      {
        range = { std::min(range[0], value), std::max(range[1], value) };
      }
    }
    if (range[0] <= range[1])
    {
      Widen(ranges, array->GetName(), range);
    }
  }
}

/// Values one after the other, as they are in memory.
class BytesWriter
{
public:
  std::string Bytes;

  template <class T>
  void Value(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    this->Bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void Value(const std::string& text)
  {
    this->Value(text.size());
    this->Bytes += text;
  }
  template <class T>
  void Values(const std::vector<T>& values)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    this->Value(values.size());
    this->Bytes.append(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
  }
  template <class Pairs>
  void Map(const Pairs& map)
  {
    this->Value(map.size());
    for (const auto& [key, value] : map)
    {
      this->Value(key);
      this->Value(value);
    }
  }
};

class BytesReader
{
public:
  explicit BytesReader(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  template <class T>
  void Value(T& value)
  {
    this->Take(&value, sizeof(T));
  }
  void Value(std::string& text)
  {
    text.resize(this->Size(1));
    this->Take(text.data(), text.size());
  }
  template <class T>
  void Values(std::vector<T>& values)
  {
    values.resize(this->Size(sizeof(T)));
    this->Take(values.data(), sizeof(T) * values.size());
  }
  template <class Pairs>
  void Map(Pairs& map)
  {
    map.clear();
    for (std::size_t left = this->Size(sizeof(typename Pairs::mapped_type)); left > 0; --left)
    {
      typename Pairs::key_type key{};
      typename Pairs::mapped_type value{};
      this->Value(key);
      this->Value(value);
      map.emplace(std::move(key), value);
    }
  }
  bool IsAtEnd() const { return this->IsGood && this->Place == this->Bytes.size(); }

private:
  /// How many values follow, no more than there can be.
  std::size_t Size(std::size_t bytesEach)
  {
    std::size_t size = 0;
    this->Value(size);
    this->IsGood = this->IsGood && size <= (this->Bytes.size() - this->Place) / bytesEach;
    return this->IsGood ? size : 0;
  }
  void Take(void* to, std::size_t size)
  {
    this->IsGood = this->IsGood && size <= this->Bytes.size() - this->Place;
    if (this->IsGood && size > 0)
    {
      std::memcpy(to, this->Bytes.data() + this->Place, size);
      this->Place += size;
    }
  }

  const std::string& Bytes;
  std::size_t Place = 0;
  bool IsGood = true;
};
}

void PartBox::Add(const Vec3& point)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Low[axis] = std::min(this->Low[axis], point[axis]);
    this->High[axis] = std::max(this->High[axis], point[axis]);
  }
}

void PartBox::Merge(const PartBox& other)
{
  if (!other.IsEmpty())
  {
    this->Add(other.Low);
    this->Add(other.High);
  }
}

bool PartBox::Contains(const Vec3& point, double margin) const
{
  bool isIn = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isIn =
      isIn && this->Low[axis] - margin <= point[axis] && point[axis] <= this->High[axis] + margin;
  }
  return isIn;
}

double PartBox::DistanceTo(const Vec3& place) const
{
  Vec3 off;
  for (int axis = 0; axis < 3; ++axis)
  {
    off[axis] = std::max({ this->Low[axis] - place[axis], place[axis] - this->High[axis], 0.0 });
  }
  return std::hypot(off[0], off[1], off[2]);
}

CleaningFrame FrameOf(const PartBox& all)
{
  CleaningFrame frame;
  if (!all.IsEmpty())
  {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      squared += (all.High[axis] - all.Low[axis]) * (all.High[axis] - all.Low[axis]);
      frame.LargestCoordinate =
        std::max({ frame.LargestCoordinate, std::abs(all.Low[axis]), std::abs(all.High[axis]) });
    }
    frame.Origin = MiddleOf(all);
    frame.Diagonal = std::sqrt(squared);
  }
  return frame;
}

std::size_t SurfaceCensus::Hash::operator()(const Key& key) const
{
  std::size_t seed = 0;
  for (const Vec3& place : key)
  {
    for (const double x : place)
    {
      seed ^= std::hash<double>()(x) + 0x9e3779b97f4a7c15ull + (seed << 6) + (seed >> 2);
    }
  }
  return seed;
}

void SurfaceCensus::Add(
  const CleanedMesh& part, const CleaningFrame& frame, const std::vector<PartBox>& others)
{
  SurfaceCensus own(this->Tolerance);
  own.Count(part, frame, others);
  this->Merge(own);
}

void SurfaceCensus::Count(
  const CleanedMesh& part, const CleaningFrame& frame, const std::vector<PartBox>& others)
{
  const std::vector<Triangle>& triangles = part.Mesh.Triangles;
  std::vector<Vec3> places;
  std::vector<bool> areShared;
  const double margin = std::max(this->Tolerance, RoundingShare * frame.LargestCoordinate);
  for (const Vec3& point : part.Mesh.Points)
  {
    places.push_back(PlaceOf(point, frame.Origin));
    areShared.push_back(std::any_of(others.begin(), others.end(),
      [&](const PartBox& box) { return box.Contains(point, margin); }));
    for (int axis = 0; axis < 3; ++axis)
    {
      this->AreExact[axis] =
        this->AreExact[axis] && IsExactDifference(point[axis], frame.Origin[axis]);
    }
  }
  Neighbours neighbours;
  this->Counts = AnalyseSurface(places, triangles, neighbours);
  this->Triangles = static_cast<std::int64_t>(triangles.size());

  // Each edge that may be another part's, or has more than two triangles here, with those.
  struct Use
  {
    std::int32_t Triangle;
    bool IsUp;
  };
  std::unordered_map<Key, std::vector<Use>, Hash> edges;
  const auto isShared = [&](const Triangle& t, int edge)
  { return areShared[t[edge]] && areShared[t[(edge + 1) % 3]]; };
  std::vector<std::int32_t> parents(triangles.size());
  std::iota(parents.begin(), parents.end(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const Triangle& t = triangles[i];
    const auto index = static_cast<std::int32_t>(i);
    this->AddLongestEdge(part.Mesh, t);
    for (int e = 0; e < 3; ++e)
    {
      const std::int32_t neighbour = neighbours[i][e];
      if (neighbour >= 0)
      {
        Join(parents, index, neighbour);
      }
      if (neighbour == NonManifoldEdge || isShared(t, e))
      {
        const Vec3& from = places[t[e]];
        const Vec3& to = places[t[(e + 1) % 3]];
        edges[from < to ? Key{ from, to } : Key{ to, from }].push_back({ index, from < to });
      }
    }
  }
  for (const auto& edge : edges)
  {
    for (const Use& use : edge.second)
    {
      Join(parents, use.Triangle, edge.second.front().Triangle);
    }
  }

  std::vector<std::int32_t> pieces(triangles.size(), -1);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    std::int32_t& index = pieces[FindRoot(parents, static_cast<std::int32_t>(i))];
    if (index < 0)
    {
      index = static_cast<std::int32_t>(this->Pieces.size());
      this->Pieces.emplace_back();
      this->Parents.push_back(index);
    }
    Piece& piece = this->Pieces[index];
    const Triangle& t = triangles[i];
    for (int k = 0; k < 3; ++k)
    {
      piece.Box.Add(places[t[k]]);
      piece.IsOpen = piece.IsOpen || (neighbours[i][k] < 0 && !isShared(t, k));
    }
    const Vector normal = glm::cross(ToVector(places[t[1]]), ToVector(places[t[2]]));
    piece.SignedVolume += glm::dot(ToVector(places[t[0]]), normal) / 6.0;
  }
  // What may be another part's too is counted when all parts are there.
  for (const auto& edge : edges)
  {
    const Key& key = edge.first;
    const std::vector<Use>& uses = edge.second;
    const Use& first = uses.front();
    const Triangle& t = triangles[first.Triangle];
    const bool isOther = std::all_of(t.begin(), t.end(),
      [&](std::int32_t corner)
      { return areShared[corner] || (places[corner] != key[0] && places[corner] != key[1]); });
    if (isOther)
    {
      Uses& entry = this->Edges[key];
      entry.Up = std::count_if(uses.begin(), uses.end(), [](const Use& use) { return use.IsUp; });
      entry.Down = static_cast<std::int64_t>(uses.size()) - entry.Up;
      entry.Piece = pieces[FindRoot(parents, first.Triangle)];
      CountEdge(entry.Up, entry.Down, -1, this->Counts);
    }
  }
}

void SurfaceCensus::AddLongestEdge(const TriangleMesh& mesh, const Triangle& t)
{
  const Vector a = ToVector(mesh.Points[t[0]]);
  const Vector b = ToVector(mesh.Points[t[1]]);
  const Vector c = ToVector(mesh.Points[t[2]]);
  const double longest =
    std::max({ SquaredLength(c - b), SquaredLength(a - c), SquaredLength(b - a) });
  if (longest > this->SquaredEdge && Facet(a, b, c).HasArea())
  {
    this->SquaredEdge = longest;
  }
}

void SurfaceCensus::Merge(const SurfaceCensus& other)
{
  this->Counts.BoundaryEdges += other.Counts.BoundaryEdges;
  this->Counts.NonManifoldEdges += other.Counts.NonManifoldEdges;
  this->Counts.FlippedEdges += other.Counts.FlippedEdges;
  this->Triangles += other.Triangles;
  this->SquaredEdge = std::max(this->SquaredEdge, other.SquaredEdge);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->AreExact[axis] = this->AreExact[axis] && other.AreExact[axis];
  }
  const auto first = static_cast<std::int32_t>(this->Pieces.size());
  this->Pieces.insert(this->Pieces.end(), other.Pieces.begin(), other.Pieces.end());
  for (const std::int32_t parent : other.Parents)
  {
    this->Parents.push_back(first + parent);
  }
  for (const auto& [key, uses] : other.Edges)
  {
    const auto [place, isNew] = this->Edges.emplace(key, uses);
    if (isNew)
    {
      place->second.Piece += first;
      continue;
    }
    place->second.Up += uses.Up;
    place->second.Down += uses.Down;
    Join(this->Parents, first + uses.Piece, place->second.Piece);
  }
  for (const auto& [name, range] : other.PointRanges)
  {
    Widen(this->PointRanges, name, range);
  }
  for (const auto& [name, range] : other.CellRanges)
  {
    Widen(this->CellRanges, name, range);
  }
}

/// The edges, with ends that are within the tolerance of each other made one.
SurfaceCensus::EdgeUses SurfaceCensus::MergeEnds(std::vector<std::int32_t>& parents) const
{
  if (this->Tolerance == 0.0)
  {
    return this->Edges;
  }
  // By place, so that it does not matter which part came first.
  std::vector<std::pair<Key, Uses>> sorted(this->Edges.begin(), this->Edges.end());
  std::sort(
    sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  PointMerger merger(2 * sorted.size(), this->Tolerance);
  EdgeUses merged;
  for (const auto& [key, uses] : sorted)
  {
    const std::int32_t low = merger.Insert(key[0]);
    const std::int32_t high = merger.Insert(key[1]);
    if (low == high)
    {
      continue; // so is no edge of a triangle with an area
    }
    const Vec3& from = merger.Points()[static_cast<std::size_t>(low)];
    const Vec3& to = merger.Points()[static_cast<std::size_t>(high)];
    const bool isSame = from < to;
    const auto [place, isNew] = merged.emplace(isSame ? Key{ from, to } : Key{ to, from }, Uses());
    place->second.Up += isSame ? uses.Up : uses.Down;
    place->second.Down += isSame ? uses.Down : uses.Up;
    if (isNew)
    {
      place->second.Piece = uses.Piece;
    }
    Join(parents, uses.Piece, place->second.Piece);
  }
  return merged;
}

PatchRecord SurfaceCensus::Finish(const PartBox& all) const
{
  PatchRecord record;
  record.Frame = FrameOf(all);
  record.PointRanges = this->PointRanges;
  record.CellRanges = this->CellRanges;
  WholeSurface& whole = record.Whole;
  whole.Triangles = this->Triangles;
  whole.LongestEdge = std::sqrt(this->SquaredEdge);
  SurfaceReport& report = whole.Report;
  report = this->Counts;
  std::vector<Piece> pieces = this->Pieces;
  std::vector<std::int32_t> parents = this->Parents;
  for (const auto& [key, uses] : this->MergeEnds(parents))
  {
    CountEdge(uses.Up, uses.Down, 1, report);
    pieces[uses.Piece].IsOpen = pieces[uses.Piece].IsOpen || uses.Up + uses.Down != 2;
  }
  // Pieces that parts share become one.
  std::vector<Piece> closed;
  report.Components = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const std::int32_t root = FindRoot(parents, static_cast<std::int32_t>(i));
    if (static_cast<std::size_t>(root) != i)
    {
      pieces[root].SignedVolume += pieces[i].SignedVolume;
      pieces[root].Box.Merge(pieces[i].Box);
      pieces[root].IsOpen = pieces[root].IsOpen || pieces[i].IsOpen;
    }
  }
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (static_cast<std::size_t>(FindRoot(parents, static_cast<std::int32_t>(i))) == i)
    {
      ++report.Components;
      if (!pieces[i].IsOpen)
      {
        closed.push_back(pieces[i]);
      }
    }
  }
  report.Closed = report.BoundaryEdges == 0 && report.NonManifoldEdges == 0;
  report.Oriented = report.FlippedEdges == 0 && report.NonManifoldEdges == 0;
  report.InsideOutComponents = !report.Oriented
    ? 0
    : std::count_if(closed.begin(), closed.end(),
        [&closed](const Piece& piece)
        {
          return piece.SignedVolume < 0.0 &&
            std::none_of(closed.begin(), closed.end(),
              [&piece](const Piece& outer)
              { return outer.SignedVolume > 0.0 && StrictlyWithin(piece.Box, outer.Box); });
        });
  // As TriangleSurface places its origin.
  Vector shift(0.0);
  const Vector middle = ToVector(record.Frame.Origin);
  for (int axis = 0; axis < 3; ++axis)
  {
    shift[axis] = this->AreExact[axis] ? middle[axis] : 0.0;
  }
  const Vector low = ToVector(all.Low);
  const Vector high = ToVector(all.High);
  whole.Origin = ToVec3(shift);
  whole.Radius = RadiusAbout(shift, low, high);
  whole.Diagonal = glm::length((high - shift) - (low - shift));
  return record;
}

template <class Self, class Archive>
void SurfaceCensus::Transfer(Self& self, Archive& archive)
{
  archive.Value(self.Counts);
  archive.Value(self.Triangles);
  archive.Value(self.SquaredEdge);
  archive.Value(self.AreExact);
  archive.Values(self.Pieces);
  archive.Values(self.Parents);
  archive.Map(self.Edges);
  archive.Map(self.PointRanges);
  archive.Map(self.CellRanges);
}

std::string SurfaceCensus::Pack() const
{
  BytesWriter writer;
  Transfer(*this, writer);
  return writer.Bytes;
}

bool SurfaceCensus::Unpack(const std::string& bytes)
{
  BytesReader reader(bytes);
  Transfer(*this, reader);
  return reader.IsAtEnd();
}

void SurfaceCensus::AddRanges(vtkPolyData* part, const CleanedMesh& cleaned)
{
  AddRangesOf(part->GetPointData(), cleaned.OriginalPoint, this->PointRanges);
  AddRangesOf(part->GetCellData(), cleaned.OriginalCell, this->CellRanges);
}
}
