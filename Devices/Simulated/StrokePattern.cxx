#include "haptics/Devices/Simulated/StrokePattern.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace haptics
{
namespace
{
bool Check(const StrokePattern& pattern, std::string& error)
{
  if (pattern.Axis < 0 || pattern.Axis > 2)
  {
    error = "The stroke axis must be 0, 1 or 2, but is " + std::to_string(pattern.Axis) + ".";
    return false;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = pattern.Bounds[2 * axis];
    const double high = pattern.Bounds[2 * axis + 1];
    if (!std::isfinite(low) || !std::isfinite(high) || low > high ||
      (axis != static_cast<std::size_t>(pattern.Axis) && low == high))
    {
      error = "The stroke bounds along axis " + std::to_string(axis) + " are from " +
        std::to_string(low) + " to " + std::to_string(high) +
        " m. They must be finite, in order, and have an extent across the stroke axis.";
      return false;
    }
  }
  if (!std::isfinite(pattern.Depth) || !std::isfinite(pattern.Clearance) ||
    pattern.Clearance < 0.0 || !(pattern.Inset >= 0.0 && pattern.Inset <= 0.45))
  {
    error = "The stroke depth and clearance must be finite, the clearance not below 0, and the "
            "inset between 0 and 0.45.";
    return false;
  }
  if (pattern.NumberOfStrokes < 1 || pattern.NumberOfStrokes > 1000)
  {
    error = "The number of strokes must be between 1 and 1000, but is " +
      std::to_string(pattern.NumberOfStrokes) + ".";
    return false;
  }
  return true;
}

/// Points of the strokes in a square from -1 to 1.
std::vector<std::array<double, 2>> UnitStrokes(const StrokePattern& pattern)
{
  std::vector<std::array<double, 2>> points;
  const int n = pattern.NumberOfStrokes;
  if (pattern.Pattern == StrokePattern::Boustrophedon)
  {
    for (int i = 0; i < n; ++i)
    {
      const double across = n == 1 ? 0.0 : 2.0 * i / (n - 1) - 1.0;
      const double start = i % 2 == 0 ? -1.0 : 1.0;
      points.push_back({ start, across });
      points.push_back({ -start, across });
    }
    return points;
  }
  // Enough that a chord leaves the curve by less than 0.1 % of the extent.
  const int samples = 96 * (n + 1);
  const double pi = std::acos(-1.0);
  for (int i = 0; i <= samples; ++i)
  {
    const double t = 2.0 * pi * i / samples;
    points.push_back({ std::cos(n * t), std::sin((n + 1) * t) });
  }
  return points;
}
}

std::vector<DevicePoint> StrokePattern::Points(std::string& error) const
{
  if (!Check(*this, error))
  {
    return {};
  }
  const auto down = static_cast<std::size_t>(this->Axis);
  const double top = this->Bounds[2 * down + 1];
  const auto place = [&](const std::array<double, 2>& unit, double height)
  {
    DevicePoint point;
    point[down] = height;
    for (std::size_t k = 0; k < 2; ++k)
    {
      const std::size_t axis = (down + 1 + k) % 3;
      const double low = this->Bounds[2 * axis];
      const double high = this->Bounds[2 * axis + 1];
      point[axis] = 0.5 * (low + high) + unit[k] * (0.5 - this->Inset) * (high - low);
    }
    return point;
  };

  const std::vector<std::array<double, 2>> strokes = UnitStrokes(*this);
  std::vector<DevicePoint> points = { place(strokes.front(), top + this->Clearance) };
  for (const std::array<double, 2>& stroke : strokes)
  {
    points.push_back(place(stroke, top - this->Depth));
  }
  points.push_back(place(strokes.back(), top + this->Clearance));
  return points;
}
}
