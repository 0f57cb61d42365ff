#include "haptics/Devices/Simulated/SimulatedPath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using haptics::DevicePoint;
using haptics::SimulatedPath;

namespace
{
constexpr double Rounding = 1e-12; // [m], far above float64's rounding at these sizes

void ExpectAt(const SimulatedPath& path, double time, const DevicePoint& expected)
{
  EXPECT_LT(haptics::Distance(path.At(time), expected), Rounding) << "at " << time << " s";
}

//   (0,0) o----3 m----o (3,0)
//                     |
//                    4 m        at 1 m/s
//                     |
//                     o (3,4)
const std::vector<DevicePoint> Corner{ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 4, 0 } };

TEST(SimulatedPath, GoesAtOneSpeedWhateverTheDistanceOfThePoints)
{
  SimulatedPath path;
  std::string error;
  ASSERT_TRUE(path.FollowAtSpeed(Corner, 1.0, false, error)) << error;
  EXPECT_NEAR(path.Duration(), 7.0, Rounding);
  ExpectAt(path, 0.0, { 0, 0, 0 });
  ExpectAt(path, 1.5, { 1.5, 0, 0 });
  ExpectAt(path, 3.0, { 3, 0, 0 });
  ExpectAt(path, 5.0, { 3, 2, 0 });
}

TEST(SimulatedPath, StaysAtItsEndsOutsideItsTimeWithoutLoop)
{
  SimulatedPath path;
  std::string error;
  ASSERT_TRUE(path.FollowAtSpeed(Corner, 1.0, false, error)) << error;
  ExpectAt(path, -1.0, { 0, 0, 0 });
  ExpectAt(path, 7.0, { 3, 4, 0 });
  ExpectAt(path, 1e9, { 3, 4, 0 });
}

TEST(SimulatedPath, GoesStraightBackAndStartsOverWithLoop)
{
  SimulatedPath path;
  std::string error;
  ASSERT_TRUE(path.FollowAtSpeed(Corner, 1.0, true, error)) << error;
  EXPECT_NEAR(path.Duration(), 12.0, Rounding) << "7 m there, 5 m back";
  ExpectAt(path, 9.5, { 1.5, 2, 0 });
  ExpectAt(path, 12.0, { 0, 0, 0 });
  ExpectAt(path, 13.5, { 1.5, 0, 0 });
}

TEST(SimulatedPath, NeverJumpsInALoop)
{
  SimulatedPath path;
  std::string error;
  ASSERT_TRUE(path.FollowAtSpeed(Corner, 0.1, true, error)) << error;
  const double tick = 0.001;
  for (int i = 1; i < 300000; ++i)
  {
    const double step = haptics::Distance(path.At((i - 1) * tick), path.At(i * tick));
    ASSERT_LT(step, 0.1 * tick * 1.000001) << "at " << i * tick << " s";
  }
}

TEST(SimulatedPath, IsAtEachPointAtItsTimeCountedFromTheFirst)
{
  SimulatedPath path;
  std::string error;
  ASSERT_TRUE(path.FollowTimes(Corner, { 10.0, 11.0, 15.0 }, false, error)) << error;
  EXPECT_NEAR(path.Duration(), 5.0, Rounding);
  ExpectAt(path, 0.5, { 1.5, 0, 0 });
  ExpectAt(path, 1.0, { 3, 0, 0 });
  ExpectAt(path, 3.0, { 3, 2, 0 });
}

TEST(SimulatedPath, TakesNoTimeAtRepeatedPoints)
{
  SimulatedPath path;
  std::string error;
  ASSERT_TRUE(
    path.FollowAtSpeed({ { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } }, 1.0, false, error))
    << error;
  EXPECT_NEAR(path.Duration(), 1.0, Rounding);
  ExpectAt(path, 0.5, { 0.5, 0, 0 });
}

TEST(SimulatedPath, StandsStillOnOnePoint)
{
  SimulatedPath path;
  std::string error;
  for (const bool loop : { false, true })
  {
    ASSERT_TRUE(path.FollowAtSpeed({ { 1, 2, 3 } }, 1.0, loop, error)) << error;
    EXPECT_EQ(path.Duration(), 0.0);
    ExpectAt(path, 4.0, { 1, 2, 3 });
  }
}

TEST(SimulatedPath, RefusesWhatCannotBeFollowedAndNamesIt)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const struct
  {
    std::vector<DevicePoint> Points;
    std::vector<double> Times;
    double Speed;
    const char* Named;
  } cases[] = {
    { {}, {}, 1.0, "no points" },
    { { { 0, 0, 0 }, { 0, nan, 0 } }, {}, 1.0, "Point 1" },
    { { { infinity, 0, 0 } }, {}, 1.0, "Point 0" },
    { Corner, {}, 0.0, "speed" },
    { Corner, {}, -1.0, "speed" },
    { Corner, {}, nan, "speed" },
    { Corner, { 0.0, 1.0 }, 1.0, "2 times" },
    { Corner, { 0.0, 1.0, 1.0 }, 1.0, "Time 2" },
    { Corner, { 0.0, 2.0, 1.0 }, 1.0, "Time 2" },
    { Corner, { 0.0, nan, 1.0 }, 1.0, "Time 1" },
  };
  for (const auto& bad : cases)
  {
    SimulatedPath path;
    std::string error;
    EXPECT_FALSE(bad.Times.empty() ? path.FollowAtSpeed(bad.Points, bad.Speed, false, error)
                                   : path.FollowTimes(bad.Points, bad.Times, false, error));
    EXPECT_NE(error.find(bad.Named), std::string::npos) << error;
  }
}
}
