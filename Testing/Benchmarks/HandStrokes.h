#ifndef Haptics_HandStrokes_h
#define Haptics_HandStrokes_h

#include "haptics/Surface/TriangleSurface.h"

#include <memory>
#include <string>
#include <vector>

namespace haptics::testing
{
/// What surfaces and strokes there are, one a line, for a program's help.
extern const char* const HandStrokesHelp;

/// The surfaces of that name, about R = 1 m; empty where there is none, with the reason on standard
/// error. `folder` holds the real ones, as Data/get_surfaces.py leaves them.
std::vector<TriangleMesh> MakeHandSurfaces(const std::string& name, const std::string& folder);

/// What a god-object is stroked over.
using HandSurfaces = std::vector<std::shared_ptr<const TriangleSurface>>;

/// Places of the HIP, one a tick; empty where there is no such stroke. The same on each machine of
/// one architecture. `tip`: how much higher, for a ball of that radius [m].
std::vector<Vec3> MakeHandStroke(const std::string& name, const std::string& surface,
  const HandSurfaces& surfaces, int ticks, double tip = 0.0);
}

#endif
