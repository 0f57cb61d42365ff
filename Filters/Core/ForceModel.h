#ifndef ForceModel_h
#define ForceModel_h

#include "Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <limits>

namespace haptics
{
/// @brief From the god-object to the force in the hand: a spring, limited to what the device can
/// do.
///
/// Everything is in the device frame [m, N, N/m], so that a terrain of 30 km and a gear of 3 mm
/// feel alike. Servo thread.
struct VTKHAPTICSCORE_EXPORT ForceModel
{
  double Stiffness = 500.0;  ///< [N/m], >= 0
  double MaximumForce = 3.3; ///< [N], >= 0; a longer force is shortened, its direction kept
  /// The device's own limit [N/m], for surfaces with a stiffness of their own; not for this one.
  double LargestStiffness = std::numeric_limits<double>::infinity();

  /// Force [N] for a displacement of the god-object from the HIP [m]; zero where that is not
  /// finite.
  Vec3 Force(const Vec3& displacement) const noexcept;
};
}

#endif
