#ifndef Haptics_SeparatingPlanes_h
#define Haptics_SeparatingPlanes_h

#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace haptics
{
/// @brief For each of many triangles a plane that separated it from a ball's centre, and how far
/// off it was at least: eight side by side, in vector instructions.
///
/// A motion that is in front of a triangle's plane by its reach, at both ends, is clear of it. A
/// distance is kept as a bound on the way that the centre has to travel: as long as it has not gone
/// so far, the triangle is out of reach, and groups of eight are passed over at once. What is left
/// has to be looked at one by one.
///
/// All is kept in float32, relative to the centre's first place and in units of about the radius of
/// what was gathered. What that rounds is taken off every distance: so much of a unit, and of the
/// way travelled, that nothing is passed over which might be met. No allocation after construction.
class SeparatingPlanes
{
public:
  static constexpr std::int32_t Width = 8;

  explicit SeparatingPlanes(std::int32_t capacity);

  /// The corners of eight triangles.
  struct Corners
  {
    alignas(4 *
      Width) double Axes[9][Width]; ///< of the first corner x, y, z, of the second, of the third

    void Set(std::int32_t lane, const Vec3& a, const Vec3& b, const Vec3& c)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Axes[axis][lane] = a[axis];
        this->Axes[3 + axis][lane] = b[axis];
        this->Axes[6 + axis][lane] = c[axis];
      }
    }
  };
  /// Starts anew, with no triangle and the ball's centre at `origin`; it will be within about
  /// `radius` of that.
  void Restart(const Vector& origin, double radius);
  /// Separates the next eight triangles, or, as the last ones, `count`, from the origin.
  void Add(const Corners& corners, std::int32_t count);
  /// The centre has come to x, on a way of `length`.
  void Travel(const Vector& x, double length);
  /// How far it has come, in units: beyond a few, bounds are worn.
  float Travelled() const { return this->Way; }

  /// What has been found of a triangle: from where the centre is, a plane that separates it, with
  /// the unit normal towards the centre, at this distance.
  void Set(std::int32_t i, const Vector& normal, double distance);

  /// Calls visit(i) for each triangle that may come within `reach` of the centre on this way and
  /// before limit(), a share of the way, which may fall meanwhile: the earliest planes first.
  template <class Limit, class Visitor>
  void VisitNear(
    const Vector& way, double length, double reach, const Limit& limit, const Visitor& visit)
  {
    NearTriangle* const found = this->Found.data();
    std::int32_t count = this->FindNear(way, length, reach, limit());
    for (std::int32_t i = count / 2; i-- > 0;)
    {
      Sink(found, count, i, found[i]);
    }
    while (count > 0 && found->Entry <= limit())
    {
      const NearTriangle first = *found;
      --count;
      Sink(found, count, 0, found[count]);
      visit(first.Triangle);
    }
  }
  /// Calls visit(i) for each triangle that may be nearer to the centre than a limit(), which may
  /// fall meanwhile.
  template <class Limit, class Visitor>
  void VisitWithin(const Limit& limit, const Visitor& visit)
  {
    const auto groups = static_cast<std::int32_t>(this->Groups);
    for (std::int32_t g = 0; g < groups; ++g)
    {
      for (std::int32_t lane = 0; this->Least[g] <= this->Farthest(limit()) && lane < Width; ++lane)
      {
        if (this->Planes[g].Bound[lane] <= this->Farthest(limit()))
        {
          visit(Width * g + lane);
        }
      }
    }
  }

private:
  using Reals = float __attribute__((vector_size(4 * Width)));
  struct alignas(4 * Width) Group
  {
    Reals Normal[3];
    Reals Offset;
    Reals Bound;
  };
  struct NearTriangle
  {
    float Entry; ///< no nearer than the reach before this share of the way
    std::int32_t Triangle;
  };
  /// Puts one into a heap, the earliest on top, whose place `i` is free: moves those under it up,
  /// the earlier of two each time, and what is put in then rises. As a binary heap of the standard
  /// library does, but no branch hangs on which of two is earlier.
  static void Sink(NearTriangle* heap, std::int32_t count, std::int32_t i, NearTriangle put)
  {
    const std::int32_t top = i;
    std::int32_t child = 2 * i + 2;
    for (; child < count; child = 2 * i + 2)
    {
      child -= heap[child].Entry > heap[child - 1].Entry ? 1 : 0;
      heap[i] = heap[child];
      i = child;
    }
    if (child == count)
    {
      heap[i] = heap[child - 1];
      i = child - 1;
    }
    for (std::int32_t parent = (i - 1) / 2; i > top && heap[parent].Entry > put.Entry;
         parent = (i - 1) / 2)
    {
      heap[i] = heap[parent];
      i = parent;
    }
    heap[i] = put;
  }

  std::int32_t FindNear(const Vector& way, double length, double reach, double limit);
  float Farthest(double distance) const;

  std::vector<Group> Planes;
  std::vector<float> Least; ///< of the bounds of each group
  std::vector<NearTriangle> Found;
  std::int32_t Groups = 0;
  Vector Origin{ 0 };
  Vector Centre{ 0 };
  double PerUnit = 1.0; ///< a power of two
  float Place[3]{};     ///< of the centre, in units from the origin
  float Way = 0.0F;
};
}

#endif
