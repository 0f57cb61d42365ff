#include "haptics/Devices/Falcon/FalconKinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace haptics
{
namespace FalconKinematics
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double RadiansPerDegree = Pi / 180.0;

// Stamper's names [m].
constexpr double A = 0.060;
constexpr double B = 0.1025;
constexpr double C = 0.01443;
constexpr double DE = 0.01125 + 0.01125;
constexpr double F = -0.025;
constexpr double R = 0.040;
constexpr double S = -0.02309;

constexpr double AngleAtZero = 35.0 * RadiansPerDegree;
constexpr double CountsPerTurn = 1280.0;
constexpr double Gear = 0.110 / 0.01425;
constexpr double RadiansPerCount = 2.0 * Pi / (CountsPerTurn * Gear);

constexpr double Converged = 1e-13; // [m], of the last Newton step; 1e-10 is promised
constexpr int MaximumSteps = 20;    // 3 to 5 are needed
constexpr double Singular = 1e-6;   // of a determinant of unit vectors: no usable pose is near it

/// A leg's place about z.
struct Frame
{
  double Cos;
  double Sin;
};

std::array<Frame, 3> MakeFrames() noexcept
{
  std::array<Frame, 3> frames{};
  const std::array<double, 3> degrees{ 105.0, -15.0, -135.0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    frames[i] = { std::cos(degrees[i] * RadiansPerDegree),
      std::sin(degrees[i] * RadiansPerDegree) };
  }
  return frames;
}

const std::array<Frame, 3> Frames = MakeFrames();

Vector ToLeg(const Frame& leg, const Vector& p) noexcept
{
  return { leg.Cos * p[0] + leg.Sin * p[1] - R, -leg.Sin * p[0] + leg.Cos * p[1] - S, p[2] };
}

Vector DirectionFromLeg(const Frame& leg, const Vector& v) noexcept
{
  return { leg.Cos * v[0] - leg.Sin * v[1], leg.Sin * v[0] + leg.Cos * v[1], v[2] };
}

Vector FromLeg(const Frame& leg, const Vector& v) noexcept
{
  return DirectionFromLeg(leg, { v[0] + R, v[1] + S, v[2] });
}

double Dot(const Vector& a, const Vector& b) noexcept
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector Cross(const Vector& a, const Vector& b) noexcept
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector Minus(const Vector& a, const Vector& b) noexcept
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector Scaled(double s, const Vector& a) noexcept
{
  return { s * a[0], s * a[1], s * a[2] };
}

double Norm(const Vector& a) noexcept
{
  return std::sqrt(Dot(a, a));
}

bool IsFinite(const Vector& v) noexcept
{
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

/// A rod of a leg at a pose: where it points, and how much longer or shorter than b it would be.
struct Rod
{
  Vector Direction; // unit, device frame
  double Stretch;   // [m]
  double Reach;     // how far turning the crank carries its end along the rod [m/rad]
};

// (rho - (d + e))^2 + v^2 = b^2: the end of the parallelogram moves on a torus, not on a sphere.
Rod RodOf(const Frame& leg, const Vector& position, double angle) noexcept
{
  const Vector p = ToLeg(leg, position);
  const double u = p[0] + C - A * std::cos(angle);
  const double w = p[2] - A * std::sin(angle);
  const double v = p[1] + F;
  const double rho = std::hypot(u, w);
  const double inPlane = rho - DE;
  const double length = std::hypot(inPlane, v);
  // sin theta3 and (cos, sin) theta2. The third component of the direction is sin theta2 times
  // sin theta3; circulating drivers square sin theta2 there.
  const double sin3 = inPlane / length;
  const double cos2 = u / rho;
  const double sin2 = w / rho;
  return { DirectionFromLeg(leg, { sin3 * cos2, v / length, sin3 * sin2 }), length - B,
    A * sin3 * (sin2 * std::cos(angle) - cos2 * std::sin(angle)) };
}

std::array<Rod, 3> RodsOf(const Vector& position, const Vector& angles) noexcept
{
  std::array<Rod, 3> rods{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    rods[i] = RodOf(Frames[i], position, angles[i]);
  }
  return rods;
}

/// The columns of the inverse of the matrix with these rods as rows. False where it has none.
bool InverseOfRods(const std::array<Rod, 3>& rods, std::array<Vector, 3>& columns) noexcept
{
  const Vector& a = rods[0].Direction;
  const Vector& b = rods[1].Direction;
  const Vector& c = rods[2].Direction;
  const Vector bc = Cross(b, c);
  const double determinant = Dot(a, bc);
  if (!(std::abs(determinant) > Singular))
  {
    return false;
  }
  columns = { Scaled(1.0 / determinant, bc), Scaled(1.0 / determinant, Cross(c, a)),
    Scaled(1.0 / determinant, Cross(a, b)) };
  return true;
}

/// A point near the solution: the upper one where three spheres meet, the tori without their tube.
bool MeetSpheres(const Vector& angles, Vector& position) noexcept
{
  constexpr double radius = B + DE;
  std::array<Vector, 3> centre{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    centre[i] = FromLeg(Frames[i], { A * std::cos(angles[i]) - C, -F, A * std::sin(angles[i]) });
  }
  const Vector ab = Minus(centre[1], centre[0]);
  const Vector ac = Minus(centre[2], centre[0]);
  Vector normal = Cross(ab, ac);
  const double normal2 = Dot(normal, normal);
  if (!(normal2 > 0.0))
  {
    return false;
  }
  // Circumcentre of the three centres; the solution is above or below it.
  const Vector toCircumcentre = Scaled(0.5 / normal2,
    Minus(Scaled(Dot(ac, ac), Cross(normal, ab)), Scaled(Dot(ab, ab), Cross(normal, ac))));
  const double height2 = radius * radius - Dot(toCircumcentre, toCircumcentre);
  if (!(height2 >= 0.0))
  {
    return false;
  }
  const double up = normal[2] < 0.0 ? -1.0 : 1.0;
  normal = Scaled(up * std::sqrt(height2 / normal2), normal);
  for (std::size_t i = 0; i < 3; ++i)
  {
    position[i] = centre[0][i] + toCircumcentre[i] + normal[i];
  }
  return true;
}
}

double AngleOfCount(std::int16_t count) noexcept
{
  return AngleAtZero + RadiansPerCount * count;
}

std::int16_t CountOfAngle(double angle) noexcept
{
  using Limits = std::numeric_limits<std::int16_t>;
  const double count = std::round((angle - AngleAtZero) / RadiansPerCount);
  return static_cast<std::int16_t>(
    std::clamp(count, double{ Limits::min() }, double{ Limits::max() }));
}

bool Inverse(const Vector& position, Vector& angles) noexcept
{
  Vector found{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Vector p = ToLeg(Frames[i], position);
    const double v = p[1] + F;
    const double length = DE + std::sqrt(B * B - v * v); // of the leg's second link, in its plane
    const double u = p[0] + C;
    const double distance = std::hypot(u, p[2]);
    const double cosine = (distance * distance + A * A - length * length) / (2.0 * A * distance);
    if (!(std::abs(cosine) <= 1.0)) // also where v is out of reach, which makes it not a number
    {
      return false;
    }
    found[i] = std::atan2(p[2], u) - std::acos(cosine);
  }
  angles = found;
  return true;
}

bool Forward(const Vector& angles, Vector& position) noexcept
{
  Vector p{};
  if (!IsFinite(angles) || !MeetSpheres(angles, p))
  {
    return false;
  }
  for (int i = 0; i < MaximumSteps; ++i)
  {
    const std::array<Rod, 3> rods = RodsOf(p, angles);
    std::array<Vector, 3> columns{};
    if (!InverseOfRods(rods, columns))
    {
      return false;
    }
    Vector step{};
    for (std::size_t j = 0; j < 3; ++j)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        step[k] += columns[j][k] * rods[j].Stretch;
      }
    }
    p = Minus(p, step);
    if (!IsFinite(p))
    {
      return false;
    }
    if (Norm(step) < Converged)
    {
      position = p;
      return true;
    }
  }
  return false;
}

bool Jacobian(const Vector& position, const Vector& angles, Matrix& jacobian) noexcept
{
  // A rod keeps its length: direction . dp = Reach dtheta.
  const std::array<Rod, 3> rods = RodsOf(position, angles);
  std::array<Vector, 3> columns{};
  if (!InverseOfRods(rods, columns))
  {
    return false;
  }
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      jacobian[row][column] = columns[column][row] * rods[column].Reach;
    }
  }
  return true;
}

Vector Torques(const Matrix& jacobian, const Vector& force) noexcept
{
  Vector torques{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      torques[i] += jacobian[j][i] * force[j];
    }
  }
  return torques;
}
}
}
