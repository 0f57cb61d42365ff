#ifndef Haptics_ForceProfile_h
#define Haptics_ForceProfile_h

#include "vtkHapticsCoreModule.h"

#include <memory>
#include <string>
#include <vector>

namespace haptics
{
/// @brief A force against penetration: what takes the linear spring's place. Immutable.
///
/// A table of forces at even steps of depth, straight lines between them; beyond its range the last
/// line goes on, but never falls. Everything in the device frame [m, N]. Any thread.
///
/// It is the slope of a potential, as the linear spring is, so that it makes no energy on any
/// closed way. Its steepest slope is what counts as its stiffness where stability limits that: a
/// slope that falls, as in the click of a button, costs none.
class VTKHAPTICSCORE_EXPORT ForceProfile
{
public:
  /// `forces` [N], at the depths 0, range/(n - 1), ... range [m]. Null, and in `error` what is
  /// wrong: fewer than two forces, one that is not finite or below 0, one at depth 0 that is not 0
  /// (a force that jumps at the touch is stable at no rate), a range that is not finite and > 0.
  static std::shared_ptr<const ForceProfile> Build(
    const std::vector<double>& forces, double range, std::string& error);

  /// [N] at a depth >= 0 [m].
  double Force(double depth) const noexcept;
  /// What a spring pressed to a depth >= 0 [m] holds [J].
  double Energy(double depth) const noexcept;
  /// [N/m], > 0 unless all forces are 0; no force is more than this times its depth.
  double SteepestSlope() const noexcept { return this->Steepest; }

private:
  struct Node
  {
    double Force;
    double Energy;
  };
  std::vector<Node> Nodes;
  double Step = 0.0;
  double LastSlope = 0.0; ///< beyond the range
  double Steepest = 0.0;
};
}

#endif
