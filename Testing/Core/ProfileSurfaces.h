#ifndef Haptics_ProfileSurfaces_h
#define Haptics_ProfileSurfaces_h

#include "haptics/Surface/TriangleSurface.h"

#include <array>
#include <functional>
#include <vector>

namespace haptics::testing
{
/// Surfaces of the scenes where methods fail; closed and facing outwards unless said otherwise [m].

/// Extrudes a counter-clockwise profile in (x, z) along y, from -halfWidth to halfWidth. The
/// profile has to be star-shaped about `centre`, where its ends are closed.
TriangleMesh Extruded(const std::vector<std::array<double, 2>>& profile,
  const std::array<double, 2>& centre, double halfWidth);

/// A box of that half size under a flat top through the origin that rises by `degrees` towards +x.
TriangleMesh Slab(double degrees, double halfSize);
/// A ridge along y with its edge at the origin and `degrees` between its flanks.
TriangleMesh Ridge(double degrees, double size);
/// A block with a V-groove of `degrees` along y cut into its top; the crease is at the origin.
TriangleMesh GroovedBlock(double degrees, double depth);
/// The block under z = height(x, y) over a square about the origin of cells x cells squares.
TriangleMesh HeightBlock(
  const std::function<double(double, double)>& height, double halfSize, int cells);

/// Three open squares around a lowest point at the origin that rise by `degrees` outwards.
TriangleMesh ThreePlanes(double degrees, double halfSize);
/// Open squares in z = 0, -gap, -2 gap, ...
TriangleMesh Sheets(int count, double gap, double halfSize);
/// Every triangle on its own, pulled in until neighbours are `width` apart.
TriangleMesh Cracked(const TriangleMesh& mesh, double width);
}

#endif
