#ifndef Haptics_Neighbourhood_h
#define Haptics_Neighbourhood_h

#include "haptics/Contact/FacetTable.h"
#include "haptics/Surface/SurfaceSide.h"

#include <cmath>
#include <memory>
#include <vector>

namespace haptics
{
/// @brief The facets of a surface around a god-object, from the surface's engine.
///
/// A ball of triangles is gathered once and serves every question of several ticks. A motion that
/// leaves the ball is answered from the triangles along it. Either way no triangle that the motion
/// can meet is missing, because engines are conservative. Where nothing is near, an empty ball
/// answers without any measuring. Positions are in the surface's local frame.
class Neighbourhood
{
public:
  /// Most triangles that one gathering holds: more meet in no point of any surface seen, and fewer
  /// would leave the tip of a finely cut cone out of touch.
  static constexpr std::int32_t LargestNumberOfTriangles = 1 << 15;

  explicit Neighbourhood(const std::shared_ptr<const TriangleSurface>& surface);

  FacetTable& Facets() { return this->Table; }
  const FacetTable& Facets() const { return this->Table; }
  /// A list to work with: what was gathered is overwritten.
  TriangleList Scratch();

  double MinimumClearance() const { return this->SmallestClearance; }
  ///@{
  /// Positions are rounded in the scene frame, whose origin may be so far from the surface's.
  void KeepClearOfRounding(double distance);
  /// The same for a surface that has moved; nothing is forgotten where the clearance is enough.
  void KeepClearAfterMove(double distance);
  ///@}
  /// Takes over what another one has learned of the surface.
  void Continue(const Neighbourhood& previous);
  /// Goes on as another one of a patch of the same surface would, at the same place: with what that
  /// has gathered, where all of it is known in both patches.
  void TakeOver(const Neighbourhood& previous);
  /// Forgets what it has learned of the surface.
  void ForgetLearned();

  /// Puts the god-object somewhere: what was gathered holds no longer.
  void Place(const Vector& position)
  {
    this->Table.SetPosition(position);
    this->Forget();
  }
  void Forget() { this->Covered = Region::Nothing; }
  void ForgetEmptyBall() { this->EmptyRadius = 0.0; }

  bool HasBall() const { return this->Covered == Region::Ball; }
  bool HasSegment() const { return this->Covered == Region::Segment; }
  /// Whether a place is in what was gathered.
  bool IsInBall(const Vector& x) const
  {
    return SquaredLength(x - this->Table.Centre()) <= this->Radius * this->Radius;
  }
  /// Whether the ball holds all that is within so far of the god-object.
  bool HoldsAllWithin(double distance) const
  {
    return this->HasBall() &&
      glm::length(this->Table.Position() - this->Table.Centre()) + distance <= this->Radius;
  }
  /// Whether the last ball was gathered for where the god-object is.
  bool IsBallGatheredHere() const
  {
    return this->HasBall() && this->GatheredAt == this->Table.Position();
  }
  /// Whether the god-object is so far from the surface that a way there is known too badly.
  bool IsFarOut() const;
  /// Whether a motion goes far beyond the ball that would be gathered next, but not from far out.
  bool IsLeap(const Vector& to) const;
  /// Whether a place may be in that ball.
  bool MayHold(const Vector& x) const;
  /// Whether the last leap met something so near.
  bool DoLeapsMeetNear() const { return this->LeapMetNear; }
  void SetLeapsMeetNear(bool doThey) { this->LeapMetNear = doThey; }
  /// How much of a way the ball reaches along: less than all by rounding.
  double FractionInBall(const Vector& to) const
  {
    return this->Radius / glm::length(to - this->Table.Position()) * (1.0 - 0x1p-40);
  }
  /// Whether a motion stays in the empty ball: then nothing has to be measured for it. It is the
  /// target then.
  bool PassesThroughNothing(const Vector& to);
  /// Whether a motion ends where it begins, among facets that are known, and so meets none. It is
  /// the target then.
  bool GoesNowhere(const Vector& to);

  ///@{
  /// False where the budget ends first, or one place has more triangles than fit.
  bool GatherBall(WorkBudget& budget) { return this->GatherBallAhead(Vector(0.0), budget); }
  /// The same for a motion: in free space a ball that holds all of it, and nothing else, is enough.
  bool GatherBallFor(const Vector& to, WorkBudget& budget);
  bool GatherSegment(const Vector& to, WorkBudget& budget);
  /// All triangles that can come to the god-object while it goes there and the surface is swept.
  bool GatherSwept(const Vector& to, WorkBudget& budget);
  ///@}
  /// What the engine found: more than is near enough to be among Facets().
  TriangleList Found() { return { this->Triangles.data(), this->FoundCount, this->FoundCount }; }

  void MeasurePosition();
  /// The same, where that has not been done.
  void RequirePosition()
  {
    if (!this->Table.IsPositionMeasured())
    {
      this->MeasurePosition();
    }
  }
  /// Measures a motion from there, where that has not been done.
  void RequireTarget(const Vector& to)
  {
    this->RequirePosition();
    if (!this->Table.HasTarget(to))
    {
      this->Table.MeasureTarget(to);
    }
  }
  /// Moves to the target.
  void Move();
  /// The same when the sweep has been finished.
  void MoveSwept();

private:
  enum class Region
  {
    Nothing,
    Ball,
    Segment
  };

  bool IsWithinPatch(const Vector& centre, double radius) const;
  bool GatherBallAhead(const Vector& way, WorkBudget& budget);
  bool GatherNothing(double radius, const Vector& to);
  double Fill(const TriangleList& found, const Vector& centre, const Vector& middle, double radius,
    double farthest);
  bool IsEmptyAround(const Vector& x) const
  {
    return this->EmptyRadius > 0.0 &&
      SquaredLength(x - this->EmptyCentre) < this->EmptyRadius * this->EmptyRadius;
  }
  void GrowEmptyBall(double nearest);
  void GrowToPlanes();

  /// An engine that finds more in a ball is stopped, and a ball of half the radius is tried. Where
  /// even the smallest ball has more, as near the tip of a fan, more are let through.
  static constexpr std::int32_t FewInBall = 64;

  FacetTable Table;
  std::vector<std::int32_t> Triangles; ///< what the engine found
  std::int32_t FoundCount = 0;
  double SmallestClearance = 0.0;
  double Reach = 0.0; ///< no facet is met farther than this from itself
  Region Covered = Region::Nothing;
  double Radius = 0.0;                 ///< of the ball about the table's centre
  double RadiusToTry = 0.0;            ///< next time
  double FreeRadius = 0.0;             ///< of a ball that is tried first, as it may be empty
  bool IsFreeGrowing = true;           ///< empty balls have been so, each twice the one before
  double LargestToTry = HUGE_VAL;      ///< below a radius that had too many, for some time
  std::int32_t MostInBall = FewInBall; ///< where the engine is stopped
  bool LeapMetNear = false;
  Vector GatheredAt{ 0 };  ///< where the god-object was when the last ball was gathered
  Vector EmptyCentre{ 0 }; ///< of a ball in which no facet is met: nothing to look at
  double EmptyRadius = 0.0;
};
}

#endif
