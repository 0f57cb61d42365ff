#ifndef Haptics_PolygonSplitter_h
#define Haptics_PolygonSplitter_h

#include "haptics/Filters/CornerGrid.h"
#include "haptics/Math/Vec3.h"

#include <array>
#include <functional>
#include <utility>
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
/// triangles missing where a polygon is thinner than about a millionth of its length. The
/// constrained triangulations of CGAL are GPL.
///
/// Ears wait in a heap, and a corner that is no ear waits for the corner that lies in it, so that
/// each cut judges anew only those that it can have changed; a grid finds what may lie in an ear.
/// That is about n sqrt(n) for n corners: 100,000 take about a second. Keeps its scratch memory
/// between polygons. One thread.
class PolygonSplitter
{
public:
  enum class Result
  {
    Split,
    Folded, ///< it crosses itself: split into a fan, which keeps its edges and hence leaves no hole
    Stopped ///< by the caller; there are no triangles
  };
  using LocalTriangle = std::array<int, 3>;
  /// Is called now and then, every few milliseconds; false stops the work.
  using GoOnCall = std::function<bool()>;

  /// `corners`: at least 3, finite, no two in a row equal.
  Result Split(const std::vector<Vec3>& corners, const GoOnCall& goOn = {});
  /// Corner numbers of the triangles of the last polygon, oriented as it was; always two fewer than
  /// corners. Some can lack area, where corners lie on one line.
  const std::vector<LocalTriangle>& Triangles() const { return this->Output; }

private:
  static constexpr int None = -1;
  struct Corner
  {
    double X, Y;
    int Previous, Next; // None once it is cut off
    double Diagonal;    // squared length of the diagonal that cuts this corner off
    int Turn;           // +1 convex, 0 straight, -1 reflex
    bool IsEar;
    int Blocker;      // a corner in the way of the ear that this one would be, or None
    int FirstWaiting; // for this corner to be out of the way
    int PreviousWaiting, NextWaiting; // for the same blocker
  };

  bool Project(const std::vector<Vec3>& corners);
  int Turn(int a, int b, int c) const;
  bool Holds(int a, int b, int c, int point) const;
  bool IsThere(int corner) const { return this->Corners[corner].Next != None; }
  int FindBlocker(int corner, int likely) const;
  void SetTurn(int corner);
  void Judge(int corner);
  void Wait(int corner, int blocker);
  void StopWaiting(int corner);
  void FreeWaiting(int blocker);
  int NextEar();
  int AnyStraight();
  void CutOff(int tip);
  Result Clip(int count, const GoOnCall& goOn);
  void MakeFan(int count);

  const std::vector<Vec3>* Given = nullptr; // while Split() runs
  std::vector<Corner> Corners;
  CornerGrid Grid; // those that are not convex: only they can lie in an ear
  std::vector<std::pair<double, int>> Ears; // a heap by diagonal; some are none any more
  std::vector<int> Straight;                // some are not any more
  std::vector<int> ToJudge;
  std::vector<LocalTriangle> Output;
};
}

#endif
