#ifndef Haptics_ForceModel_h
#define Haptics_ForceModel_h

#include <limits>

namespace haptics
{
/// @brief The spring from the god-object to the hand, and what the device can do.
///
/// Everything is in the device frame [m, N, N/m], so that a terrain of 30 km and a gear of 3 mm
/// render alike. Servo thread.
struct ForceModel
{
  double Stiffness = 500.0;  ///< [N/m], >= 0
  double MaximumForce = 3.3; ///< [N], >= 0; a longer force is shortened, its direction kept
  /// The device's own limit [N/m], for surfaces with a stiffness of their own; not for this one.
  double LargestStiffness = std::numeric_limits<double>::infinity();
};
}

#endif
