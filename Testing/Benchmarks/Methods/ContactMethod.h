#ifndef Haptics_ContactMethod_h
#define Haptics_ContactMethod_h

#include "haptics/Math/Vec3.h"

#include <memory>

namespace haptics::testing
{
/// @brief A way to answer where a hand is held: what the benchmarks and the stability suite
/// compare.
///
/// The force of every method is K (held point − HIP), so that methods differ by the point alone.
/// World frame, metres. Methods need not be free of allocation: none of them is shipped but this
/// project's.
class ContactMethod
{
public:
  virtual ~ContactMethod() = default;

  /// Starts anew at a place, as in free space.
  virtual void Place(const Vec3& position) = 0;
  /// Forgets what it keeps from tick to tick to be faster: as newly made.
  virtual void Forget() {}
  /// One tick: the point to which the hand is pulled; the HIP itself where nothing is touched.
  virtual Vec3 Update(const Vec3& hip) = 0;
  /// Ticks that found parallel planes and kept the point where it was.
  virtual long SingularSolves() const { return 0; }
};

using MethodPointer = std::unique_ptr<ContactMethod>;
}

#endif
