#ifndef Haptics_StrokePattern_h
#define Haptics_StrokePattern_h

#include "haptics/Devices/Simulated/SimulatedPath.h"
#include "vtkHapticsDevicesModule.h"

#include <string>
#include <vector>

namespace haptics
{
/// @brief A hand that strokes over a box: down from above, to and fro at one depth, up again.
///
///        start o                       o end        Clearance above the bounds
///              |                       |
///     top  - - | - - - - - - - - - - - | - - -      bounds, in the direction of Axis
///              o------> strokes >------o            Depth below
///
struct VTKHAPTICSDEVICES_EXPORT StrokePattern
{
  enum Kind
  {
    Boustrophedon, ///< to and fro in parallel lines, as an ox ploughs
    Lissajous      ///< one smooth closed curve that crosses the bounds in both directions
  };

  /// (xmin, xmax, ymin, ymax, zmin, zmax), device frame [m]; must have an extent across the axis.
  std::array<double, 6> Bounds{ -0.05, 0.05, -0.05, 0.05, 0.0, 0.0 };
  int Axis = 2;            ///< 0, 1 or 2: the axis down which the hand presses
  double Depth = 0.005;    ///< [m] below the top of the bounds, finite
  double Clearance = 0.01; ///< [m] above the top where it starts and ends, finite and >= 0
  double Inset = 0.05;     ///< share of the extent left out at each side, 0 to 0.45
  int NumberOfStrokes = 8; ///< lines, or the lower of the curve's two frequencies; 1 to 1000
  Kind Pattern = Boustrophedon;

  /// The points of the pattern in order; empty, with the cause in `error`, where a value is out of
  /// its range.
  std::vector<DevicePoint> Points(std::string& error) const;
};
}

#endif
