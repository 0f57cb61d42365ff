#ifndef Haptics_ForceColor_h
#define Haptics_ForceColor_h

#include <algorithm>
#include <array>
#include <cstddef>

namespace haptics
{
/// The colour of a force, as a share (0 to 1, clamped) of the strongest: from pale gold over orange
/// to crimson. The same ramp everywhere, so that arrow, bar, trail and legend agree.
inline std::array<double, 3> ForceColor(double share)
{
  constexpr std::array<double, 3> light{ { 1.0, 0.93, 0.60 } };
  constexpr std::array<double, 3> middle{ { 1.0, 0.60, 0.18 } };
  constexpr std::array<double, 3> strong{ { 0.72, 0.05, 0.15 } };
  constexpr double half = 0.45;
  const double x = std::clamp(share, 0.0, 1.0);
  const std::array<double, 3>& low = x < half ? light : middle;
  const std::array<double, 3>& high = x < half ? middle : strong;
  const double f = x < half ? x / half : (x - half) / (1.0 - half);
  std::array<double, 3> color{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    color[i] = (1.0 - f) * low[i] + f * high[i];
  }
  return color;
}
}

#endif
