#ifndef Haptics_GodObject_h
#define Haptics_GodObject_h

#include "haptics/Contact/TouchedSurface.h"
#include "haptics/Material/Material.h"
#include "haptics/Math/Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace haptics
{
class SceneGodObject;

/// One plane that held the god-object back at the end of an update.
struct Constraint
{
  Vec3 Normal{};              ///< unit, towards the god-object
  std::int32_t Surface = -1;  ///< index in the list given to GodObject
  std::int32_t Triangle = -1; ///< index in that surface
};

enum class UpdateStatus
{
  Free,       ///< the god-object is at the HIP
  Touching,   ///< constraints hold the god-object back
  InvalidHip, ///< the HIP is not finite or absurdly far: nothing moved, ask for no force
  Overloaded, ///< more triangles in one place than a tick may look at: held where it is safe
  Squeezed    ///< surfaces have closed in and leave no place: ask for no force until they do
};

/// @brief The outcome of one update: the one record of a contact, from the god-object to the trace.
///
/// In the world frame as GodObject gives it. InDevice() has the same in the device frame [m], which
/// is what forces are made from.
struct Contact
{
  UpdateStatus Status = UpdateStatus::Free;
  Vec3 Hip{};
  Vec3 Position{};          ///< the god-object
  Vec3 Displacement{};      ///< god-object minus HIP; keeps its digits far from the origin
  double Penetration = 0.0; ///< |Displacement|
  /// How far surfaces that moved, or changed all at once, have taken the god-object along, pushed
  /// it or let it go since the update before. With the force, the work that they did.
  Vec3 SurfaceDisplacement{};
  int NumberOfConstraints = 0; ///< 0 to 3
  /// The HIP has gone beyond what is known of a surface that is a patch (SurfaceOptions::Whole):
  /// the contact, but for Hip, is that of the last place on its way up to which all is known.
  bool AwaitsData = false;
  /// And the patch shows no place on the side of the surface where the god-object was before that
  /// changed: it stays where it is until one does that reaches to the surface.
  bool IsAstray = false;
  /// The first NumberOfConstraints are valid; the one that pushes most against the HIP comes first.
  std::array<Constraint, 3> Constraints;
  haptics::Material
    Material;    ///< of the surfaces there; plain where none of the god-object's has properties
  Vec3 Shaded{}; ///< Displacement turned by force shading; only where Material.IsShaded

  /// Whether surfaces hold the god-object back.
  bool IsTouching() const noexcept
  {
    return this->Status == UpdateStatus::Touching || this->Status == UpdateStatus::Overloaded;
  }
};

/// What a god-object is: a point, or a ball about its position.
enum class Tip
{
  Point,
  Ball ///< may be one; a point as long as its radius is 0
};

/// @brief The constraint-based god-object of Zilles and Salisbury (1995), certified against leaks.
///
/// Each update moves the point towards the HIP until a facet is met, adds the facet's plane, solves
/// the paper's equation (4) with a check of the multipliers' signs, and goes on until no facet is
/// in the way; up to 16 such passes, so that convex edges are crossed in the same tick (Fig. 5).
///
/// **What is guaranteed.** Every straight piece of the god-object's way has been certified: it
/// touches no facet of any surface from a side that can be touched, shared edges and corners
/// included. It holds because
/// - engines leave no triangle out that a piece can meet (CollisionEngine),
/// - a piece is accepted only if every such triangle is cleared, by float64 outside a proven bound
///   on its error and by exact predicates inside it,
/// - the end of one piece is, bit for bit, the start of the next.
/// So a closed oriented surface is never entered from its front, and no triangle of any soup is
/// crossed where both sides are touched. Condition: a gap between facets that do not share corners
/// is no wider than SurfaceOptions::CrackWidth. A motion exactly in a triangle's plane passes
/// through neither of its sides and crosses nothing: so a sheet that is met edge on, to the last
/// bit, does not hold. A point that comes to rest on a triangle that way counts as in front of it.
///
/// **Nothing holds where nothing is**, the other half: if no facet, from a side that can be
/// touched, meets the straight way from the god-object to the HIP, nor a cone of a thousandth
/// around it, the god-object comes to within 8 clearances of the HIP (of the facets that hold it; a
/// clearance is TriangleSurface::Clearance(), or up to a millionth of the longest edge of a
/// triangle that even twice the digits of a double cannot distinguish from a line), and where it is
/// farther from it, exactly there: in that update, or, of a triangle thinner than its clearance
/// that the update has just met, in the next. It holds because
/// - an update ends with a look along that way: what exact predicates find it free of facets is
///   gone in one certified piece, whatever planes hold the god-object,
/// - the look is left out only where a facet is known to be in the way: the god-object is in front
///   of it for certain, and the way to the HIP, behind it, goes through it at a distance from its
///   edges that is more than rounding.
/// Conditions: the way does not squeeze through a gap that is to be closed (class NarrowGap: an
/// edge that no other facet shares runs along a facet within 6 clearances, so slits are open from
/// 10 on); the god-object is not Overloaded or Squeezed, not farther from a surface than eight
/// times its radius, and the HIP is not that of a surface that is just being swept by a
/// deformation. The cone is more than the proof needs: it leaves room for the frame's rounding.
///
/// What is *not* in plain view is reached around edges as far as each step shortens the way to the
/// HIP. That no plane stops it that is not a facet's there: a facet reaches beyond an edge that it
/// shares by a quarter of a clearance only, beyond an open edge or corner by 4 clearances, and
/// there it does not hold what goes along a plane that it lies under (WorkingSet::Covers). Of a HIP
/// at rest it also leaves a corner along any facet within 64 clearances, and in any of 512
/// directions that lead nearer, tried in four updates. Which of the facets met at
/// once counts is decided by more than rounding: it is the same at every scale, place and frame.
///
/// **Surfaces that move** see the god-object move, and its way in their own frame is certified like
/// any other: from the point where they last had it, bit for bit, to the next. So nothing passes
/// through at any speed. Triangles of a surface that deforms (SurfaceDeformer) go straight from
/// tick to tick, and what is not certain to miss the god-object counts as passing over it. A
/// god-object that touches is taken along by the first surface that holds
/// it, then pushed out of what has come into its place. Where surfaces close in and leave no place,
/// each keeps a god-object of its own that nothing passes, there is no force
/// (UpdateStatus::Squeezed), and contact goes on when there is a place again for all.
///
/// **Monotone**: an update never takes the god-object farther from the HIP it is given, beyond
/// rounding: the premise of the stability bound K <= 2b/T on any static surface. Advance() may, by
/// Contact::SurfaceDisplacement: that is the surfaces' own work.
///
/// **Friction**: where the surfaces in contact have some, the god-object stays, bit for bit, while
/// the HIP pulls within the static friction's cone, and else moves to the side of the dynamic
/// friction's cone (class Friction). It only changes what an update aims at: all of the above
/// stands.
///
/// **Several surfaces in one place**: the push on a plane is shared by the materials of all
/// surfaces that lie along it there, smoothly over a few clearances, whatever their order in the
/// list. Constraints name the one plane that holds; of planes that coincide, that of the first
/// surface.
///
/// **A ball** (SetTipRadius()) touches up to three places, rounds edges and corners, and comes into
/// no hole narrower than itself. Its centre, which is the position here, stays a radius off every
/// facet from a side that can be touched; each straight piece of the centre's way has been
/// certified for that, to within a millionth of the radius (class BallSet). So the centre crosses
/// nothing, and there are no gaps to close and no clearances of thin triangles to keep: what holds
/// it is there, as each plane that does is that between the ball and the place that it touches.
/// Between two ticks of a surface that deforms, a ball of 0.49 of the radius is clear for certain.
/// Where it overlaps, because it was put there, has grown, or came through the back of a surface
/// that has only a front, the largest ball about its centre that does not counts in its stead
/// (BallRadius()): it is free to leave and comes no deeper. That grows by a 128th of the radius in
/// an update, and is pushed out the nearest way meanwhile: Contact::SurfaceDisplacement, no work of
/// the hand. What leaves it no room to grow leaves it as small. A centre exactly on a triangle has
/// no side. Passes converge over what is round; they go on in the next update where one has not
/// enough. An update follows the way within a tick in one piece.
///
/// **A patch** of a surface (SurfaceOptions::Whole) gives what the whole does, to the last bit,
/// where all triangles that matter are in it. A god-object never comes farther from its HIP, so
/// what it can meet lies in the ball about the HIP that it is on the rim of: an update follows the
/// HIP as far as that ball stays in the patch, and no farther (Contact::AwaitsData); no motion ends
/// beyond it. The next patch of the same surface goes on in Continue() with what was gathered and
/// held, as if there had been no exchange, as long as the god-object is in it. Where the surface is
/// another one then and has gone over the god-object, that is placed as on a whole one, if the
/// patch shows where that is, and else rests without a force until one does (Contact::IsAstray).
/// Jump() goes the straight way, as a hand would.
///
/// **Bounded**: in each substep (SetSubstepLimit()) at most 16 passes of 12 casts, and
/// 131,072 triangles looked up in all; where one place needs more, the god-object is held there
/// (UpdateStatus::Overloaded). As much again for surfaces that move, which are taken on in up to 32
/// parts of a tick.
class VTKHAPTICSCORE_EXPORT GodObject
{
public:
  /// Allocates everything that an update needs; for a ball, some more. An empty list is free space.
  explicit GodObject(std::vector<TouchedSurface> surfaces, Tip tip = Tip::Point);
  ~GodObject();
  GodObject(const GodObject&) = delete;
  GodObject& operator=(const GodObject&) = delete;

  /// How many passes an update may make: 1 to 16, the default; clamped. Fig. 5's two-step
  /// transition over a convex edge is made within one update by passes, each of which lets go of
  /// the planes that held only beyond their facets. Two or three do on a slide; a god-object that
  /// slips off a round body in one tick takes more, and every tick that needs fewer pays none. With
  /// 1 the transition takes two ticks, as in the paper. The guarantees do not depend on it, but for
  /// how far the god-object gets in one update. GUI thread, before the servo has this object.
  void SetPassLimit(int passes);
  static constexpr int LargestNumberOfPasses = 16;

  /// In how many substeps an update may follow the HIP's straight way since the update before: 1 to
  /// 16, clamped; 1, the default, is off, and 4 are enough nearly everywhere. On rough ground where
  /// a god-object comes to rest depends on the way, not only on its end: with 1 that hangs on how
  /// often the HIP is sampled. A substep ends where what holds the god-object changes and leads it
  /// on by more than a quarter of the HIP's way. So there is one in free space, at rest, while the
  /// same facets hold, and on smooth ground; and one over an edge beyond which nothing holds: a
  /// slot that is crossed within a tick is not fallen into. All guarantees hold, the premise of K
  /// <= 2b/T included: an update whose substeps would end farther from the HIP than it began is
  /// made in one. It takes up to n times as long where all are needed. A ball goes in one. Acts
  /// from the next update on; the thread that updates. Measured by HapticsWayBenchmark.
  void SetSubstepLimit(int limit) noexcept;
  static constexpr int LargestNumberOfSubsteps = 16;
  static constexpr int DefaultSubstepLimit = 1;

  /// The radius of a Tip::Ball [world unit]; 0, the default: a point. So is one smaller than 16 of
  /// the largest clearance of the surfaces, or not finite. 2^20 radii of the largest surface count
  /// at the most. Servo thread; any time between two updates: what is in contact stays so.
  void SetTipRadius(double radius) noexcept;
  double TipRadius() const noexcept;
  /// The radius in effect: less than TipRadius() while that overlaps. [world unit] Servo thread.
  double BallRadius() const noexcept;

  /// Puts the god-object at `hip` as in free space. Servo thread. [world]
  void Place(const Vec3& hip) noexcept;
  /// The HIP has been put elsewhere, by another workspace. One that touches stays where it is, on
  /// its side, and the next Update() takes it towards the HIP; one that is free goes there at once,
  /// unless that is in a solid. Servo thread; as much work as an Update().
  void Jump(const Vec3& hip) noexcept;
  /// Stays where it is, touching nothing, as if the HIP were there. Servo thread.
  const Contact& Hold() noexcept;
  /// Starts where another god-object stands, when the surfaces have changed. One that is the same,
  /// or deforms on from where it is, has it where it was. One that takes the place of another
  /// (TouchedSurface::Identity) and has gone over it has it on the nearest place of the side that
  /// it was on: outside a solid that it now is in, or, of an open surface, where it was held, in
  /// front of what held it; and then where a hand that rests has it. True where nothing has changed
  /// at once, or only patches of one surface have followed each other. Servo thread; as much work
  /// as an Update().
  bool Continue(const GodObject& previous) noexcept;
  /// Takes all motions on by `dt` [s], and the god-object with them. `isAwaited`: the next one
  /// waits for HasArrived(), so what deforms goes faster by Haste, and a source that is not quite
  /// regular is followed without leaving a shape out. Servo thread, before Update(); no allocation,
  /// no lock, bounded work; nothing where no surface can move.
  void Advance(double dt, bool isAwaited = false) noexcept;
  static constexpr double Haste = 1.25;
  /// Whether no surface deforms any more: then the next snapshots may follow. Servo thread.
  bool HasArrived() const noexcept;
  /// Moves the god-object towards the HIP, to where the surfaces let it go. Servo thread; no
  /// allocation, no lock, bounded work. The first update after construction places it.
  const Contact& Update(const Vec3& hip) noexcept;
  const Contact& Current() const noexcept;

  /// The corners of the way made in the last update, from where it started; relative to
  /// WayOrigin(), exactly as certified by surfaces that have not moved. Servo thread, until the
  /// next update.
  const Vec3* Way(int& numberOfCorners) const noexcept;
  /// The first surface's origin as it was when this was made, or the world's. [world]
  Vec3 WayOrigin() const noexcept;

  /// Where the god-object is in a surface's local frame (see TriangleSurface::Origin()), exactly as
  /// certified: what such a surface sees is this point move on straight lines from call to call.
  /// Servo thread. `surface`: index in Surfaces().
  Vec3 LocalPosition(int surface) const noexcept;
  /// Where a constraint of the last update is touched, in the local frame of its surface: under the
  /// god-object, by the ball's radius. Servo thread.
  Vec3 LocalTouch(const Constraint& constraint) const noexcept;
  /// What of a surface's deformation is over, 0 to 1; 1 where none deforms: its points are where
  /// TriangleSurface::PointAt() says. Servo thread.
  double DeformFraction(int surface) const noexcept;

  const std::vector<TouchedSurface>& Surfaces() const noexcept;

private:
  std::unique_ptr<SceneGodObject> Internal;
};
}

#endif
