#ifndef Haptics_NarrowGap_h
#define Haptics_NarrowGap_h

#include "haptics/Math/VectorMath.h"

#include <array>

namespace haptics
{
/// @brief Whether a straight way squeezes through a gap that facets reach over.
///
/// A gap has two lips: facets on either side of the way that are near each other, there and along
/// an edge of one of them that no other facet shares. Facets that part at an angle from a common
/// corner are no lips, however near the corner the way passes: theirs is no gap to close. What lies
/// between facets that share their edges, as a fold or the tip of a cone, is none either.
class NarrowGap
{
public:
  NarrowGap(const Vector& from, const Vector& to)
    : From(from)
    , To(to)
  {
  }

  /// A facet that may be near the way; a gap along it is not wider than `width`. `areOpen`: its
  /// edges ab, bc and ca, whether no other facet shares them.
  void Add(const Vector& a, const Vector& b, const Vector& c, const std::array<bool, 3>& areOpen,
    double width);
  /// Whether there is a gap; also where there are open edges among too many facets to compare.
  bool IsFound() const;

private:
  struct Lip
  {
    // Not initialized: a gap's room for them would cost more than most gaps.
    std::array<Vector, 3> Corners;
    Vector Nearest; ///< of its points to the way
    Vector Offset;  ///< to there from the way
    double Width;
    std::array<bool, 3> AreOpen; ///< edges that the nearest point is on, and that are open

    bool IsOpen() const { return this->AreOpen[0] || this->AreOpen[1] || this->AreOpen[2]; }
  };
  static bool StaysNear(const Lip& lip, const Lip& other, double width);

  static constexpr int Capacity = 32;
  Vector From, To;
  std::array<Lip, Capacity> Lips;
  int Count = 0;
  bool IsFull = false;
  bool HasOpen = false;
};
}

#endif
