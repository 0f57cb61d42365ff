#ifndef Haptics_SurfacePath_h
#define Haptics_SurfacePath_h

#include "haptics/Surface/TriangleSurface.h"

#include <random>
#include <string>
#include <vector>

namespace haptics::testing
{
/// @brief Ways of a HIP that seek what is hard on a surface: its edges, corners, planes and folds.
///
/// Lengths are shares of the surface's radius, which stands for 50 mm in the hand.
class SurfacePath
{
public:
  enum Kind
  {
    Stroke,         ///< comes down and wanders, pressing
    AlongEdges,     ///< exactly above, on or under edges, from corner to corner
    ThroughCorners, ///< straight through corners, one tick exactly on each
    InPlanes,       ///< within a facet's very plane, from outside it, and then through
    OnCorners,      ///< from corner to corner, exactly
    Tremor,         ///< of 55 um, in steps of 55 um, pressing anywhere
    IntoFolds,      ///< in spirals into concave edges
    Jumps,          ///< anywhere in every tick
    Creep,          ///< by 1e-9 a tick, pressing at edges and corners
    ToAndFro,       ///< over sharp convex edges
    FromInside,     ///< starts behind the surface
    Leap,           ///< from before one place to behind another in one tick, then at rest
    Swing,          ///< head-on onto an edge or corner, then around it
    NumberOfKinds
  };
  static const char* NameOf(Kind kind);

  SurfacePath(std::vector<Vec3> points, std::vector<Triangle> triangles);

  /// Where a stroke starts, as in free space, and all places of the HIP from there on; the same for
  /// the same seed.
  std::vector<Vec3> Make(Kind kind, unsigned seed);

private:
  struct Edge
  {
    std::int32_t From, To;
    Vec3 Normal{};     ///< mean of its triangles', unit
    double Bend = 0.0; ///< angle between them [rad]: > 0 convex, < 0 concave, 0 at a border
  };

  double Uniform(double low, double high);
  /// Between two positive numbers, each scale as likely.
  double AnyScale(double low, double high);
  int Integer(int low, int high);
  Vec3 Place(std::int32_t& triangle);
  const Edge& AnyEdge();
  /// One of the sharpest of so many.
  const Edge& SharpEdge(double sign);
  Vec3 Pressing();
  void Approach(std::vector<Vec3>& way, const Vec3& to, int ticks);

  std::vector<Vec3> Points;
  std::vector<Triangle> Triangles;
  std::vector<Vec3> FacetNormals;
  std::vector<Vec3> CornerNormals;
  std::vector<Edge> Edges;
  std::vector<std::vector<std::int32_t>> EdgesOf; ///< each corner
  std::vector<std::int32_t> UsedCorners;
  Vec3 Middle{};
  Vec3 HalfBounds{};
  double Radius = 0.0;
  std::mt19937 Random;
};
}

#endif
