#include "haptics/Devices/Simulated/SimulatedPath.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
bool CheckPoints(const std::vector<DevicePoint>& points, std::string& error)
{
  if (points.empty())
  {
    error = "The path has no points. Give it at least one.";
    return false;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!IsFinite(points[i]))
    {
      error = "Point " + std::to_string(i) +
        " of the path has a coordinate that is not finite. Remove or mend it.";
      return false;
    }
  }
  return true;
}
}

bool IsFinite(const DevicePoint& point) noexcept
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

double Distance(const DevicePoint& a, const DevicePoint& b) noexcept
{
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

bool SimulatedPath::FollowAtSpeed(
  const std::vector<DevicePoint>& points, double speed, bool loop, std::string& error)
{
  if (!CheckPoints(points, error))
  {
    return false;
  }
  if (!std::isfinite(speed) || speed <= 0.0)
  {
    error = "The speed must be finite and above 0 m/s, but is " + std::to_string(speed) + ".";
    return false;
  }

  this->Points = { points.front() };
  this->Times = { 0.0 };
  for (const DevicePoint& point : points)
  {
    // A repeated point takes no time; the comparison is of times so that they strictly increase.
    const double time = this->Times.back() + Distance(this->Points.back(), point) / speed;
    if (time > this->Times.back())
    {
      this->Points.push_back(point);
      this->Times.push_back(time);
    }
  }
  this->Loop = loop;
  this->CloseLoop();
  return true;
}

bool SimulatedPath::FollowTimes(const std::vector<DevicePoint>& points,
  const std::vector<double>& times, bool loop, std::string& error)
{
  if (!CheckPoints(points, error))
  {
    return false;
  }
  if (times.size() != points.size())
  {
    error = "The path has " + std::to_string(points.size()) + " points but " +
      std::to_string(times.size()) + " times. Give one time for each point.";
    return false;
  }
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
    {
      error = "Time " + std::to_string(i) + " of the path (" + std::to_string(times[i]) +
        " s) is not finite or not after the one before it. Times must strictly increase.";
      return false;
    }
  }

  this->Points = points;
  this->Times = times;
  for (double& time : this->Times)
  {
    time -= times.front();
  }
  this->Loop = loop;
  this->CloseLoop();
  return true;
}

void SimulatedPath::CloseLoop()
{
  const double gap = Distance(this->Points.back(), this->Points.front());
  if (!this->Loop || gap == 0.0)
  {
    return;
  }
  double length = 0.0;
  for (std::size_t i = 1; i < this->Points.size(); ++i)
  {
    length += Distance(this->Points[i - 1], this->Points[i]);
  }
  const double duration = this->Times.back();
  const double end = duration + gap * duration / length;
  if (end > duration)
  {
    this->Points.push_back(this->Points.front());
    this->Times.push_back(end);
  }
}

DevicePoint SimulatedPath::At(double time) const noexcept
{
  if (this->Loop && this->Times.back() > 0.0)
  {
    time = std::fmod(time, this->Times.back());
  }
  const auto after = std::upper_bound(this->Times.begin(), this->Times.end(), time);
  if (after == this->Times.begin())
  {
    return this->Points.front();
  }
  if (after == this->Times.end())
  {
    return this->Points.back();
  }
  const std::size_t i = static_cast<std::size_t>(after - this->Times.begin());
  const double t = (time - this->Times[i - 1]) / (this->Times[i] - this->Times[i - 1]);
  DevicePoint position;
  for (int c = 0; c < 3; ++c)
  {
    position[c] = this->Points[i - 1][c] + t * (this->Points[i][c] - this->Points[i - 1][c]);
  }
  return position;
}
}
