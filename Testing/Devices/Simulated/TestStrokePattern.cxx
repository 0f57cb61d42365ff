#include "haptics/Devices/Simulated/StrokePattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using haptics::DevicePoint;
using haptics::StrokePattern;

namespace
{
constexpr double Rounding = 1e-12; // [m]

TEST(StrokePattern, ComesFromAboveStrokesAtItsDepthAndLeavesUpwards)
{
  for (const StrokePattern::Kind kind : { StrokePattern::Boustrophedon, StrokePattern::Lissajous })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      StrokePattern pattern;
      pattern.Bounds = { -0.1, 0.1, -0.2, 0.2, -0.3, 0.3 };
      pattern.Axis = axis;
      pattern.Pattern = kind;
      std::string error;
      const std::vector<DevicePoint> points = pattern.Points(error);
      ASSERT_GE(points.size(), 4u) << error;
      const double top = pattern.Bounds[2 * axis + 1];
      EXPECT_NEAR(points.front()[axis], top + pattern.Clearance, Rounding);
      EXPECT_NEAR(points.back()[axis], top + pattern.Clearance, Rounding);
      for (std::size_t i = 1; i + 1 < points.size(); ++i)
      {
        EXPECT_NEAR(points[i][axis], top - pattern.Depth, Rounding);
      }
    }
  }
}

TEST(StrokePattern, CoversTheBoundsButTheInset)
{
  for (const StrokePattern::Kind kind : { StrokePattern::Boustrophedon, StrokePattern::Lissajous })
  {
    StrokePattern pattern;
    pattern.Bounds = { 1.0, 3.0, -4.0, 0.0, 0.0, 0.0 };
    pattern.Inset = 0.1;
    pattern.Pattern = kind;
    std::string error;
    DevicePoint low{ 1e9, 1e9, 1e9 };
    DevicePoint high{ -1e9, -1e9, -1e9 };
    for (const DevicePoint& point : pattern.Points(error))
    {
      for (int c = 0; c < 3; ++c)
      {
        low[c] = std::min(low[c], point[c]);
        high[c] = std::max(high[c], point[c]);
      }
    }
    const double sampled = 1e-3; // the curve's samples need not fall on its extremes
    EXPECT_NEAR(low[0], 1.2, sampled);
    EXPECT_NEAR(high[0], 2.8, sampled);
    EXPECT_NEAR(low[1], -3.6, sampled);
    EXPECT_NEAR(high[1], -0.4, sampled);
  }
}

TEST(StrokePattern, HasTheNumberOfStrokesAskedFor)
{
  StrokePattern pattern;
  std::string error;
  for (const int strokes : { 1, 2, 7 })
  {
    pattern.NumberOfStrokes = strokes;
    EXPECT_EQ(pattern.Points(error).size(), 2u * strokes + 2u);
  }
}

TEST(StrokePattern, RefusesWhatCannotBeStroked)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<StrokePattern> bad(8);
  bad[0].Axis = 3;
  bad[1].Bounds = { 0, 0, 0, 1, 0, 1 };
  bad[2].Bounds = { 1, 0, 0, 1, 0, 1 };
  bad[3].Bounds = { 0, nan, 0, 1, 0, 1 };
  bad[4].Depth = nan;
  bad[5].Clearance = -1.0;
  bad[6].Inset = 0.5;
  bad[7].NumberOfStrokes = 0;
  for (std::size_t i = 0; i < bad.size(); ++i)
  {
    std::string error;
    EXPECT_TRUE(bad[i].Points(error).empty()) << "case " << i;
    EXPECT_FALSE(error.empty()) << "case " << i;
  }
}
}
