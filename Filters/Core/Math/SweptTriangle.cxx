#include "haptics/Math/SweptTriangle.h"

#include "haptics/Math/NearestOnTriangle.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// Times are halved this often: to 1/32 of the way.
constexpr int LargestDepth = 5;

using Corners = std::array<Vector, 3>;

/// Six times the volume of the corners and the origin; positive where the origin is in front.
double Volume(const Vector& a, const Vector& b, const Vector& c)
{
  return -glm::dot(a, glm::cross(b, c));
}

/// Whether all corners are certain to stay on one side of a plane through the origin.
bool StaysBeyond(const Corners& from, const Corners& to, const Vector& direction, double slack)
{
  const double size = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  const double least = slack * size;
  for (int k = 0; k < 3; ++k)
  {
    if (!(glm::dot(direction, from[k]) > least && glm::dot(direction, to[k]) > least))
    {
      return false;
    }
  }
  return true;
}

bool StaysAlongAnAxis(const Corners& from, const Corners& to, double slack)
{
  const Vector low = glm::min(
    glm::min(glm::min(from[0], from[1]), from[2]), glm::min(glm::min(to[0], to[1]), to[2]));
  const Vector high = glm::max(
    glm::max(glm::max(from[0], from[1]), from[2]), glm::max(glm::max(to[0], to[1]), to[2]));
  return low.x > slack || low.y > slack || low.z > slack || high.x < -slack || high.y < -slack ||
    high.z < -slack;
}

/// The volume as the corners go on is a cubic in time, which lies between its Bernstein
/// coefficients: while they have one sign the origin never comes into the triangle's plane.
bool StaysOffPlane(const Corners& p, const Corners& q, double slack, bool isOneSided)
{
  const std::array<double, 4> volumes = { Volume(p[0], p[1], p[2]),
    (Volume(q[0], p[1], p[2]) + Volume(p[0], q[1], p[2]) + Volume(p[0], p[1], q[2])) / 3.0,
    (Volume(p[0], q[1], q[2]) + Volume(q[0], p[1], q[2]) + Volume(q[0], q[1], p[2])) / 3.0,
    Volume(q[0], q[1], q[2]) };
  double squared = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    squared = std::max({ squared, SquaredLength(p[k]), SquaredLength(q[k]) });
  }
  // A product of three lengths errs by less than 16 roundings, and by one corner's slack times the
  // other two.
  const double size = std::sqrt(squared);
  const double error = (16.0 * UnitRoundoff * size + 3.0 * slack) * squared;
  const bool isBefore =
    std::all_of(volumes.begin(), volumes.end(), [error](double v) { return v > error; });
  const bool isBehind =
    std::all_of(volumes.begin(), volumes.end(), [error](double v) { return v < -error; });
  const bool comesOut = isOneSided && volumes[1] - volumes[0] > 2.0 * error &&
    volumes[2] - volumes[1] > 2.0 * error && volumes[3] - volumes[2] > 2.0 * error;
  return isBefore || isBehind || comesOut;
}

double Contact(
  const Corners& from, const Corners& to, double slack, bool isOneSided, double start, int depth)
{
  if (StaysAlongAnAxis(from, to, slack) || StaysOffPlane(from, to, slack, isOneSided))
  {
    return 1.0;
  }
  Corners half;
  for (int k = 0; k < 3; ++k)
  {
    half[k] = 0.5 * (from[k] + to[k]);
  }
  if (StaysBeyond(from, to, NearestToOrigin(half[0], half[1], half[2]), slack))
  {
    return 1.0;
  }
  if (depth == LargestDepth)
  {
    return start;
  }
  const double first = Contact(from, half, slack, isOneSided, start, depth + 1);
  return first < 1.0
    ? first
    : Contact(half, to, slack, isOneSided, start + std::exp2(-(depth + 1)), depth + 1);
}
}

double SweptTriangle::TimeOfContact() const
{
  return Contact(this->From, this->To, this->Slack, this->IsOneSided, 0.0, 0);
}
}
