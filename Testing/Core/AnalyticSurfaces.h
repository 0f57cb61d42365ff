#ifndef Haptics_AnalyticSurfaces_h
#define Haptics_AnalyticSurfaces_h

#include "haptics/Surface/TriangleSurface.h"

#include <memory>

namespace haptics::testing
{
/// Closed surfaces face outwards; sizes are in metres unless a test says otherwise.

/// A square in z = 0, facing +z, of 2·cells² triangles.
TriangleMesh Square(double halfSize, int cells = 1);
/// 20·4^level triangles.
TriangleMesh Icosphere(int level, double radius);
/// A box centred on the origin, each face cut into cells² squares.
TriangleMesh Box(double halfX, double halfY, double halfZ, int cells = 1);
/// A sphere whose points are pulled in at random by up to `amplitude` of the radius.
TriangleMesh Star(int level, double radius, double amplitude, unsigned seed);
TriangleMesh Torus(double radius, double tube, int around, int across);
/// A V-groove along y with its crease at the origin, open to +z: two squares whose planes enclose
/// `degrees`, 0 to 180. Faces into the groove.
TriangleMesh Groove(double degrees, double size);
/// The three sides of a corner at the origin; the inside (all coordinates positive) is the front.
TriangleMesh InsideCorner(double size);
/// `count` triangles of about `size`, anywhere in a cube of half size 1, at any angle.
TriangleMesh Soup(int count, double size, unsigned seed);

/// The same surface with its front behind.
TriangleMesh InsideOut(TriangleMesh mesh);
TriangleMesh Moved(TriangleMesh mesh, const Vec3& by);
TriangleMesh Scaled(TriangleMesh mesh, double factor);
/// Of two meshes with a side for each triangle, or of two without.
TriangleMesh Joined(TriangleMesh first, const TriangleMesh& second);
/// All triangles with one side.
TriangleMesh Sided(TriangleMesh mesh, Side side);
/// Each triangle with Front or Both, by chance.
TriangleMesh SidedAtRandom(TriangleMesh mesh, unsigned seed);

/// Builds a surface and fails the running test when that fails.
std::shared_ptr<const TriangleSurface> MakeSurface(
  TriangleMesh mesh, Side side = Side::Front, EngineKind engine = EngineKind::Automatic);

/// Vectors for tests.
Vec3 operator+(const Vec3& a, const Vec3& b);
Vec3 operator-(const Vec3& a, const Vec3& b);
Vec3 operator*(double s, const Vec3& a);
double Dot(const Vec3& a, const Vec3& b);
Vec3 Cross(const Vec3& a, const Vec3& b);
double Length(const Vec3& a);
Vec3 Unit(const Vec3& a);
}

#endif
