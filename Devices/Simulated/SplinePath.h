#ifndef Haptics_SplinePath_h
#define Haptics_SplinePath_h

#include "haptics/Devices/Simulated/SimulatedPath.h"

namespace haptics
{
/// Replaces points, and their times if there are any, by samples of a smooth curve through them.
///
/// The curve's parameter is the time, or else the length along the points. Expects finite points
/// and increasing times; false, with the cause in `error`, where fewer than two points differ.
/// GUI thread.
bool RefineWithSpline(
  std::vector<DevicePoint>& points, std::vector<double>& times, std::string& error);
}

#endif
