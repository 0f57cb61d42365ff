#ifndef Haptics_Scenes_h
#define Haptics_Scenes_h

#include "ClosedLoop.h"
#include "haptics/Surface/TriangleSurface.h"

#include <array>
#include <functional>
#include <vector>

namespace haptics::testing
{
using Trace = std::vector<LoopTick>;

/// Of the tip that the scenes are run with too [m].
constexpr double TipRadius = 5e-4;

/// @brief A scene where methods fail, run by this project and by one that fails there.
///
/// The tests assert limits on both runs, so that a scene which stops telling them apart is noticed;
/// the same runs are drawn as force against time next to a cross-section in y = 0.
struct Scene
{
  const char* Name;  ///< "S5", as in the README; "Fig. 2" for one of the paper's alone
  const char* Title; ///< what happens, in a line
  const char* OursLabel;
  const char* OtherLabel;
  std::function<Trace()> Ours;
  std::function<Trace()> Other;
  std::function<Trace()> Ball; ///< this project, with a tip of TipRadius
  Vec3 Axis{ 0, 0, 1 };        ///< the component of the force that is drawn
  /// The surface's cross-section, (x, z) [m].
  std::vector<std::array<double, 2>> Profile;
};

/// What the suite draws, in the README's order.
const std::vector<Scene>& AllScenes();

// The runs, with what the tests vary. The method is the caller's; K in N/m, lengths in metres.

/// A light body dropped from 1 mm and pressed by 1 N, b = 0.35 N s/m, T = 1 ms.
Trace Pressed(ContactMethod& method, double stiffness, double delay, int ticks);
/// Against a ridge 4 mm below its edge, 4 mm to and fro for a second, then still for a second.
Trace OverRidge(ContactMethod& method, double stiffness);
/// Pressed into the left wall of a groove, down past the crease and through the right wall: Fig. 6.
Trace DownGroove(ContactMethod& method, double degrees);
/// Pressed onto a plate of that thickness around z = 0, by a force that grows to 5 N: Fig. 4.
Trace ThroughPlate(ContactMethod& method, double thickness);
/// Exactly along the lines of Box(0.03, 0.03, 0.03, 8), 2 mm deep.
Trace AlongCracks(ContactMethod& method, int ticks);
/// At 20 mm depth across the crease of an obtuse valley along y, 5e-5 m a tick.
Trace AcrossValley(ContactMethod& method, int ticks);
/// Through sheets within a few ticks, then 2 mm deep along x.
Trace IntoSheets(ContactMethod& method);
/// A still hand 1 mm under a plane that rises at 30 mm/s and is updated every 33 ms: how long it
/// then takes to get there [s]. This project alone, as no other method here moves.
Trace OnRisingPlane(double duration, double tip = 0.0);
/// Along a table of 200 N/m on the left and 800 N/m on the right; `plain`: as a spring of the
/// stiffness under the god-object would press.
Trace SoftToHard(bool plain, double tip = 0.0);
/// To and fro 4 mm under a table with friction.
Trace Rubbed(double staticFriction, double dynamicFriction, double tip = 0.0);
/// Into the top of a box near its corner and, inside, to where its side is nearer: Fig. 2.
Trace IntoCorner(ContactMethod& method);
/// Over the edge of Ridge(150, ...), 4 mm below it: Fig. 5.
Trace AroundEdge(ContactMethod& method);

/// Shortcuts for the methods that the scenes compare.
MethodPointer Certified(const TriangleMesh& mesh);
MethodPointer CertifiedBall(const TriangleMesh& mesh, double radius = TipRadius);
MethodPointer Paper(const TriangleMesh& mesh, bool iterates, double grown = 0.0);
MethodPointer Nearest(const TriangleMesh& mesh);
/// The two sides of a valley, `degrees` between their normals, as objects of their own.
MethodPointer CertifiedValley(double degrees, double tip = 0.0);
MethodPointer SummedValley(double degrees);
}

#endif
