#ifndef Haptics_SideKeeper_h
#define Haptics_SideKeeper_h

#include "haptics/Contact/DeformingSurface.h"
#include "haptics/Surface/SurfaceSide.h"

#include <optional>

namespace haptics
{
/// @brief Keeps a god-object on its side of a surface that changes all at once.
///
/// No motion shows what such a change passes over. Where space is enclosed, sides are distinguished
/// by counting what encloses the god-object, elsewhere by the plane that held it. One that is on
/// the other side now is placed at the nearest point on the side where it was. Positions are in the
/// surface's local frame. Servo thread: no allocation; bounded by the budget.
class SideKeeper
{
public:
  /// `scratch`: a list to work with. `clearance`: how far off the surface a god-object is placed at
  /// least. All three outlive this object.
  SideKeeper(
    const DeformingSurface& surface, TriangleList scratch, double clearance, WorkBudget& budget)
    : Surface(surface)
    , Scratch(scratch)
    , Clearance(clearance)
    , Budget(budget)
  {
  }

  /// How often the surface encloses x. False where it encloses nothing, or it is not known.
  bool CountEnclosing(const Vector& x, Enclosed& enclosed) const;
  /// Whether two places are enclosed equally often; true where nothing encloses, false where it
  /// is not known.
  bool AreOnSameSide(const Vector& here, const Vector& there) const;

  /// What there was before the surface changed.
  struct Past
  {
    const DeformingSurface& Surface;
    TriangleList Scratch; ///< to work with
    Vector Position;
    std::int32_t Holder; ///< the triangle that held the god-object, or -1
    Vector Normal;       ///< of the plane that held it
    /// How often the god-object is to be enclosed, where the surface before could not be asked for
    /// it, or did not place it so.
    std::optional<Enclosed> Owed;
  };
  /// How often the god-object was enclosed, or is to be. None where nothing encloses, or it is not
  /// known.
  std::optional<Enclosed> Before(const Past& past) const;
  /// Places `position` on its side of a surface that another has become. True if it had to.
  /// `before`: what Before() says.
  bool PlaceAfter(const Past& past, const std::optional<Enclosed>& before, Vector& position) const;
  /// Whether a place is known to be enclosed as it was `before`, or the surface has gone so far
  /// away that it does not matter.
  bool IsOnSideOf(const Enclosed& before, const Vector& position) const;
  /// The same as PlaceAfter() where the points of one surface have moved, from when it was enclosed
  /// `before`.
  bool PlaceWhereEnclosed(const Enclosed& before, Vector& position) const;

private:
  SurfaceSide Sides() const;
  bool PlaceBack(const Enclosed& before, const Enclosed& now, Vector& position) const;
  bool PlaceOff(const Vector& nearest, const Vector& outwards, const Enclosed* enclosed,
    Vector& position) const;

  const DeformingSurface& Surface;
  TriangleList Scratch;
  double Clearance;
  WorkBudget& Budget;
};
}

#endif
