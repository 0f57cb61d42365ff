#ifndef Haptics_BlockedCreases_h
#define Haptics_BlockedCreases_h

#include "haptics/Contact/ActivePlanes.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace haptics
{
/// @brief Motions along the crease of two facets' planes that were found to meet a facet, from one
/// place: neither depends on where a god-object there is pulled, so nobody has to try again.
///
/// Of one surface that neither moves nor deforms.
class BlockedCreases
{
public:
  /// From now on at this place; what was found elsewhere is forgotten. `tolerance`: places are the
  /// same within it.
  void StandAt(const Vector& place, double tolerance, const std::array<FacetId, 3>& holding)
  {
    if (!(SquaredLength(place - this->Place) <= tolerance * tolerance) ||
      !(holding == this->Holding))
    {
      this->Place = place;
      this->Holding = holding;
      this->Count = 0;
    }
  }

  /// The plane of the facet that a step along the crease of two facets' planes meets, or null: not
  /// known to meet one.
  const ActivePlane* Find(const FacetId& first, const FacetId& second, const Vector& step) const
  {
    const Key key = KeyOf(first, second);
    for (int i = 0; i < this->Count; ++i)
    {
      // A thin facet's plane may be another one now.
      if (this->Keys[i] == key &&
        SquaredLength(step - this->Steps[i]) <= SquaredLength(SameStep * step))
      {
        return &this->Met[i];
      }
    }
    return nullptr;
  }
  void Add(const FacetId& first, const FacetId& second, const Vector& step, const ActivePlane& met)
  {
    if (this->Count < Capacity)
    {
      this->Keys[this->Count] = KeyOf(first, second);
      this->Steps[this->Count] = step;
      this->Met[this->Count++] = met;
    }
  }

private:
  static constexpr int Capacity = 32; ///< two of eight planes, and some
  static constexpr double SameStep = 1e-6;

  using Key = std::uint64_t;
  static Key KeyOf(const FacetId& first, const FacetId& second)
  {
    const auto a = static_cast<Key>(first.Triangle);
    const auto b = static_cast<Key>(second.Triangle);
    return std::min(a, b) << 32 | std::max(a, b);
  }

  Vector Place{ 0 };
  std::array<FacetId, 3> Holding; ///< the god-object there
  std::array<Key, Capacity> Keys;
  std::array<Vector, Capacity> Steps;
  std::array<ActivePlane, Capacity> Met;
  int Count = 0;
};
}

#endif
