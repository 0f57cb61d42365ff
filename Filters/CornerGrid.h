#ifndef Haptics_CornerGrid_h
#define Haptics_CornerGrid_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace haptics
{
/// @brief Points of a plane in square cells, about one a cell, to find those near a triangle.
///
///     +--+--+--+--+--+      A row of cells is searched from the leftmost place that the triangle
///     |  |  | /|\ |  |      has in it to the rightmost, and a little more, so that rounding leaves
///     +--+--+/-+-\+--+      no point out.
///     |  | /|  |  |\ |
///     +--+--+--+--+--+
class CornerGrid
{
public:
  using Place = std::array<double, 2>;

  /// Forgets all points; there will be `count` at most, numbered from 0, between `low` and `high`.
  void Restart(int count, const Place& low, const Place& high)
  {
    this->Low = low;
    this->Side = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(count))), 1, 4096);
    for (int axis = 0; axis < 2; ++axis)
    {
      const double width = high[axis] - low[axis];
      const double scale = this->Side / width;
      this->Scale[axis] = width > 0.0 && std::isfinite(scale) ? scale : 0.0;
    }
    this->First.assign(static_cast<std::size_t>(this->Side) * this->Side, None);
    this->Entries.assign(static_cast<std::size_t>(count), {});
  }

  void Insert(int point, const Place& place)
  {
    Entry& entry = this->Entries[point];
    const Place inCells = this->InCells(place);
    entry.Cell = this->Index(inCells[1]) * this->Side + this->Index(inCells[0]);
    entry.Previous = None;
    entry.Next = this->First[entry.Cell];
    if (entry.Next != None)
    {
      this->Entries[entry.Next].Previous = point;
    }
    this->First[entry.Cell] = point;
  }

  bool Has(int point) const { return this->Entries[point].Cell != None; }

  void Remove(int point)
  {
    Entry& entry = this->Entries[point];
    (entry.Previous == None ? this->First[entry.Cell] : this->Entries[entry.Previous].Next) =
      entry.Next;
    if (entry.Next != None)
    {
      this->Entries[entry.Next].Previous = entry.Previous;
    }
    entry.Cell = None;
  }

  /// The first of the points in or near the triangle for which `isWanted` is true, else -1.
  template <typename Predicate>
  int Find(const Place& a, const Place& b, const Place& c, Predicate&& isWanted) const
  {
    const std::array<Place, 3> corners{ this->InCells(a), this->InCells(b), this->InCells(c) };
    const auto [lowest, highest] = std::minmax({ corners[0][1], corners[1][1], corners[2][1] });
    const int lastRow = this->Index(highest);
    for (int row = this->Index(lowest); row <= lastRow; ++row)
    {
      const auto [left, right] = this->Span(row, corners);
      const int last = this->Index(right);
      for (int column = this->Index(left); column <= last; ++column)
      {
        for (int point = this->First[row * this->Side + column]; point != None;
             point = this->Entries[point].Next)
        {
          if (isWanted(point))
          {
            return point;
          }
        }
      }
    }
    return None;
  }

private:
  static constexpr int None = -1;
  struct Entry
  {
    int Cell = None;
    int Previous = None;
    int Next = None;
  };

  /// In units of cells. Never falls where a coordinate grows.
  Place InCells(const Place& place) const
  {
    return { (place[0] - this->Low[0]) * this->Scale[0],
      (place[1] - this->Low[1]) * this->Scale[1] };
  }
  int Index(double inCells) const
  {
    return static_cast<int>(std::clamp(inCells, 0.0, static_cast<double>(this->Side - 1)));
  }

  /// From where to where the triangle is in a row of cells, in x.
  ///
  /// In cells, heights are rounded by less than 1e-11. An edge that rises by 1e-6 of them or more
  /// meets a height at a place that is rounded by less than 1e-3; one that rises less, and meets
  /// the row, has both ends in it.
  std::array<double, 2> Span(int row, const std::array<Place, 3>& corners) const
  {
    const double bottom = row - 1e-6;
    const double top = row + 1 + 1e-6;
    std::array<double, 2> span{ HUGE_VAL, -HUGE_VAL };
    const auto add = [&span](double x) { span = { std::min(span[0], x), std::max(span[1], x) }; };
    for (int i = 0; i < 3; ++i)
    {
      const Place& p = corners[i];
      const Place& q = corners[(i + 1) % 3];
      if (p[1] >= bottom && p[1] <= top)
      {
        add(p[0]);
      }
      for (const double height : { bottom, top })
      {
        if ((p[1] < height) != (q[1] < height))
        {
          const double share = std::clamp((height - p[1]) / (q[1] - p[1]), 0.0, 1.0);
          add(p[0] + share * (q[0] - p[0]));
        }
      }
    }
    return { span[0] - 1e-3, span[1] + 1e-3 };
  }

  int Side = 1;
  Place Low{};
  Place Scale{};          // cells a unit of length; 0 where there is one
  std::vector<int> First; // point of each cell
  std::vector<Entry> Entries;
};
}

#endif
