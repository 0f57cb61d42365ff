#ifndef Haptics_BenchmarkSurfaces_h
#define Haptics_BenchmarkSurfaces_h

#include "HipPath.h"
#include "haptics/Surface/TriangleSurface.h"

#include <functional>
#include <string>
#include <vector>

namespace haptics::testing
{
/// How a hand strokes a surface.
enum class StrokeKind
{
  Around, ///< rays from all sides to the origin say how high the surface is
  Above,  ///< rays from above do
  Path,   ///< HipPath: a shape about the origin
  Edges   ///< plunges through points on the edges that facets share, of a shape about the origin
};

/// A surface that methods are compared on, as large as in the hand: metres, about the origin.
struct BenchmarkSurface
{
  const char* Name;
  const char* Kind;                   ///< "analytic", "medical", "CAD" or "scientific"
  std::function<TriangleMesh()> Make; ///< empty where the surface could not be got
  StrokeKind Strokes;
  HipPath::Kind Path;     ///< for StrokeKind::Path
  double Reach;           ///< [m]
  double Deepest = 0.012; ///< under the surface, of rayed strokes [m]
};

/// `folder` holds the real surfaces, as Data/get_surfaces.py leaves them.
std::vector<BenchmarkSurface> AllBenchmarkSurfaces(const std::string& folder);

/// A real surface by its name, cleaned, about the origin and of that radius [m]; empty when it is
/// not there, with the reason on standard error.
TriangleMesh ReadSurface(const std::string& folder, const std::string& name, double radius);

/// Places of the HIP, one a tick of 1 ms, at up to 0.3 m/s, 3 mm above to 12 mm below the surface
/// where nothing else is said, rounded to 55 um as encoders do.
std::vector<Vec3> MakeStroke(
  const BenchmarkSurface& surface, const TriangleMesh& mesh, int ticks, unsigned seed);
}

#endif
