#ifndef Haptics_Oracle_h
#define Haptics_Oracle_h

#include "haptics/Contact/GodObject.h"

#include <vector>

namespace haptics::testing
{
/// @brief Where the god-object would be if the HIP had moved slowly: the constrained gradient flow.
///
/// The straight way of the HIP in a tick is cut into 8 steps, then 16, ... until that moves the
/// answer by less than a micrometre (or 1024 steps).
class Oracle
{
public:
  /// `radius`: of a ball; 0: a point.
  explicit Oracle(const std::shared_ptr<const TriangleSurface>& surface, double radius = 0.0);

  void Place(const Vec3& hip);
  /// The god-object for the HIP's next place. [world]
  Vec3 Update(const Vec3& hip);

private:
  Vec3 Walk(const Vec3& to, int steps);

  GodObject Before; ///< at the start of the tick
  GodObject Trial;
  Vec3 Hip{};
};

/// @brief Knows where an oracle slips off, as where the pressed HIP comes out on the other side.
///
/// It does so at no speed in particular: a moment later god-object and oracle are both there, and
/// that is what counts.
class SlipWatch
{
public:
  /// One tick; whether the oracle slips now, or has within the last two. [world]
  bool SlipsAt(const Vec3& hip, const Vec3& oracle);

private:
  Vec3 LastHip{};
  Vec3 LastOracle{};
  int Remaining = 0;
};

/// Errors of a god-object against the oracle over the ticks in contact.
class Accuracy
{
public:
  /// One tick in contact. [world, m]
  void Add(const Vec3& hip, const Vec3& godObject, const Vec3& oracle);

  std::size_t Size() const { return this->Position.size(); }
  /// E_p [m], E_theta [degrees] and E_F (1: all of the force) at a quantile: 0.5 median, 1 largest.
  double PositionError(double quantile) const;
  double DirectionError(double quantile) const;
  double MagnitudeError(double quantile) const;

private:
  std::vector<double> Position, Direction, Magnitude;
};
}

#endif
