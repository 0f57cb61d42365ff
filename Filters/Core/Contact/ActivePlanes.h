#ifndef Haptics_ActivePlanes_h
#define Haptics_ActivePlanes_h

#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace haptics
{
/// A triangle of one of the touched surfaces.
struct FacetId
{
  std::int32_t Surface = -1;
  std::int32_t Triangle = -1;

  bool operator==(const FacetId& other) const
  {
    return this->Surface == other.Surface && this->Triangle == other.Triangle;
  }
};

/// A facet that holds the god-object back: stay at least Clearance in front of its plane.
struct ActivePlane
{
  FacetId Facet;
  Vector Normal{ 0 }; ///< unit, towards the god-object
  Vector Anchor{ 0 }; ///< a corner of the facet, scene frame
  double Clearance = 0.0;
  bool IsFlipped = false; ///< the god-object is on the facet's back
  /// Met from so far away that its clearance is more than it has to be: to be met anew.
  bool IsFar = false;
  /// Not the facet's own, which is a line but for rounding, with no neighbour on one side:
  /// across the way that met it.
  bool IsOfWire = false;

  /// So many clearances over the plane a point is in front of it for certain.
  static constexpr double CertainHeight = 0.25;
  bool IsCertainlyBelow(const Vector& point) const
  {
    return glm::dot(this->Normal, point - this->Anchor) > CertainHeight * this->Clearance;
  }
  /// Whether what comes along the plane, at its clearance, passes over a point: it is behind the
  /// plane, or as good as that.
  bool PassesOver(const Vector& point) const
  {
    return glm::dot(this->Normal, point - this->Anchor) <= CertainHeight * this->Clearance;
  }
};

/// @brief The planes that became active in one pass, and the nearest point to the HIP they allow.
///
/// The paper constrains by equality; here each plane is a half-space, and the nearest point is
/// found among the equality solutions of at most three planes that keep all the others: that is
/// the sign check of the multipliers, without which a god-object sticks in obtuse valleys. With at
/// most six planes the search is exact, bounded and cannot cycle.
class ActivePlanes
{
public:
  static constexpr int Capacity = 6;

  void Clear();
  /// Leaves only the planes that hold the last nearest point and pass the test.
  template <class Test>
  void KeepSupports(const Test& isKept)
  {
    // All are asked before one is gone, as the test may look at the others. They are in the planes'
    // order, so none is overwritten before it is moved.
    std::array<bool, 3> areKept{};
    for (int i = 0; i < this->NumberOfSupports; ++i)
    {
      areKept[i] = isKept(this->Planes[this->Supports[i]]);
    }
    int count = 0;
    for (int i = 0; i < this->NumberOfSupports; ++i)
    {
      const int from = this->Supports[i];
      if (areKept[i])
      {
        if (count != from)
        {
          this->Planes[count] = this->Planes[from];
        }
        ++count;
      }
    }
    const bool areOver = this->IsOverAll;
    this->Clear();
    this->Count = count;
    this->IsOverAll = areOver;
  }
  /// Gives facets their new names; each is handed to `rename` to be changed.
  template <class Renaming>
  void Rename(const Renaming& rename)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      rename(this->Planes[i].Facet);
    }
  }
  /// Puts the planes where their facets are now; each is handed to `renew` to be changed.
  template <class Renewal>
  void Renew(const Renewal& renew)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      renew(this->Planes[i]);
    }
    this->IsOverAll = false;
  }

  ///@{
  /// Whether the god-object, where it stands, is known to be over the facet of each plane that
  /// supports: so that nobody looks twice. Who moves it takes that back; so does any other plane.
  bool IsKnownOver() const { return this->IsOverAll; }
  /// Not near an edge of any of them.
  bool IsKnownInside() const { return this->IsOverAll && this->IsInsideAll; }
  void SetKnownOver(bool isOver, bool isInside = false)
  {
    this->IsOverAll = isOver;
    this->IsInsideAll = isInside;
  }
  ///@}
  bool IsEmpty() const { return this->Count == 0; }
  /// Whether each of the planes holds the last nearest point.
  bool DoAllSupport() const { return this->Count == this->NumberOfSupports; }
  bool Has(const FacetId& facet) const;
  /// Whether what comes along one of the planes, other than that of `facet`, passes over a point.
  bool PassesOver(const Vector& point, const FacetId& facet) const;
  /// Adds a plane; when full, in place of one that does not support the goal.
  void Add(const ActivePlane& plane);
  /// Takes out the planes that do not pass the test.
  template <class Test>
  void Keep(const Test& isKept)
  {
    const auto end = std::remove_if(this->Planes.begin(), this->Planes.begin() + this->Count,
      [&](const ActivePlane& plane) { return !isKept(plane); });
    const int count = static_cast<int>(end - this->Planes.begin());
    if (count != this->Count)
    {
      this->Clear();
      this->Count = count;
    }
  }

  /// The point nearest to `hip` that keeps every plane, given that `from` nearly does; `from`
  /// itself where the planes leave no better. Sets the support.
  Vector Nearest(const Vector& from, const Vector& hip);

  /// Moves `point`, which may be behind planes, to the nearest one that keeps them all. False where
  /// there is none. Sets the support.
  bool PushOut(Vector& point);

  /// The planes that hold the last nearest point: at most three.
  int SupportSize() const { return this->NumberOfSupports; }
  const ActivePlane& Support(int i) const { return this->Planes[this->Supports[i]]; }
  /// Their facets; none beyond SupportSize().
  std::array<FacetId, 3> SupportFacets() const
  {
    std::array<FacetId, 3> facets;
    for (int i = 0; i < this->NumberOfSupports; ++i)
    {
      facets[i] = this->Support(i).Facet;
    }
    return facets;
  }

private:
  bool Solve(const Vector& wish, bool raise, const Vector& from, Vector& nearest);
  bool SolveOne(const Vector& wish, bool raise, const Vector& from, Vector& nearest);

  std::array<ActivePlane, Capacity> Planes;
  int Count = 0;
  std::array<int, 3> Supports{};
  int NumberOfSupports = 0;
  bool IsOverAll = false;
  bool IsInsideAll = false;
};
}

#endif
