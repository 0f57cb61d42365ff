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

  /// A crease, and the direction along it.
  using Key = std::uint64_t;
  /// `isForward`: along the cross product of the two planes' normals.
  static Key KeyOf(const FacetId& first, const FacetId& second, bool isForward)
  {
    const auto a = static_cast<Key>(first.Triangle);
    const auto b = static_cast<Key>(second.Triangle);
    const bool isInOrder = a < b;
    return Key(isForward == isInOrder) << 63 | std::min(a, b) << 32 | std::max(a, b);
  }
  /// The plane of the facet that was met, or null: not known to meet one.
  const ActivePlane* Find(Key key) const
  {
    const auto end = this->Keys.begin() + this->Count;
    const auto found = std::find(this->Keys.begin(), end, key);
    return found == end ? nullptr : &this->Met[found - this->Keys.begin()];
  }
  void Add(Key key, const ActivePlane& met)
  {
    if (this->Count < Capacity)
    {
      this->Keys[this->Count] = key;
      this->Met[this->Count++] = met;
    }
  }

private:
  static constexpr int Capacity = 32; ///< two of eight planes

  Vector Place{ 0 };
  std::array<FacetId, 3> Holding; ///< the god-object there
  std::array<Key, Capacity> Keys;
  std::array<ActivePlane, Capacity> Met;
  int Count = 0;
};
}

#endif
