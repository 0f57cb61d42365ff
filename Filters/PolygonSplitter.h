#ifndef Haptics_PolygonSplitter_h
#define Haptics_PolygonSplitter_h

#include "haptics/Math/Vec3.h"

#include <array>
#include <vector>

namespace haptics
{
/// Whether the triangle has an area, decided exactly for its edge vectors in float64, and a normal
/// that float64 can hold.
bool HasArea(const Vec3& a, const Vec3& b, const Vec3& c);

/// @brief Cuts a polygon into triangles by clipping ears, the one with the shortest diagonal first.
///
/// Takes convex and concave polygons, moderately non-planar ones (they are judged along their mean
/// normal), corners on straight edges, and holes joined to the outline by a bridge of two edges.
/// VTK's own polygon triangulation does not serve: it refuses such holes, and returns success with
/// triangles missing where a polygon is thinner than about a millionth of its length.
/// Keeps its scratch memory between polygons. One thread.
class PolygonSplitter
{
public:
  enum class Result
  {
    Split,
    Folded ///< it crosses itself: split into a fan, which keeps its edges and hence leaves no hole
  };
  using LocalTriangle = std::array<int, 3>;

  /// `corners`: at least 3, finite, no two in a row equal.
  Result Split(const std::vector<Vec3>& corners);
  /// Corner numbers of the triangles of the last polygon, oriented as it was; always two fewer than
  /// corners. Some can lack area, where corners lie on one line.
  const std::vector<LocalTriangle>& Triangles() const { return this->Output; }

private:
  struct Corner
  {
    double X, Y;
    int Previous, Next;
    double Diagonal; // squared length of the diagonal that cuts this corner off
    int Turn;        // +1 convex, 0 straight, -1 reflex
    bool Ear;
  };

  bool Project(const std::vector<Vec3>& corners);
  int Turn(int a, int b, int c) const;
  bool Holds(int a, int b, int c, int point) const;
  void Judge(int corner, const std::vector<Vec3>& corners);
  int BestEar() const;
  int AnyStraight() const;
  void MakeFan(int count);

  std::vector<Corner> Corners;
  std::vector<LocalTriangle> Output;
  int First = 0;
};
}

#endif
