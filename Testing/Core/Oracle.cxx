#include "Oracle.h"

#include "AnalyticSurfaces.h"

#include <algorithm>
#include <cmath>

namespace haptics::testing
{
Oracle::Oracle(const std::shared_ptr<const TriangleSurface>& surface, double radius)
  : Before({ surface }, radius > 0.0 ? Tip::Ball : Tip::Point)
  , Trial({ surface }, radius > 0.0 ? Tip::Ball : Tip::Point)
{
  this->Before.SetTipRadius(radius);
  this->Trial.SetTipRadius(radius);
}

void Oracle::Place(const Vec3& hip)
{
  this->Before.Place(hip);
  this->Hip = hip;
}

Vec3 Oracle::Walk(const Vec3& to, int steps)
{
  this->Trial.Continue(this->Before);
  Vec3 position{};
  for (int i = 1; i <= steps; ++i)
  {
    const double s = static_cast<double>(i) / steps;
    position = this->Trial.Update(this->Hip + s * (to - this->Hip)).Position;
  }
  return position;
}

Vec3 Oracle::Update(const Vec3& hip)
{
  Vec3 position = this->Walk(hip, 8);
  for (int steps = 16; steps <= 1024; steps *= 2)
  {
    const Vec3 finer = this->Walk(hip, steps);
    const bool isSettled = Length(finer - position) < 1e-6;
    position = finer;
    if (isSettled)
    {
      break;
    }
  }
  this->Before.Continue(this->Trial);
  this->Hip = hip;
  return position;
}

bool SlipWatch::SlipsAt(const Vec3& hip, const Vec3& oracle)
{
  const bool slips = Length(oracle - this->LastOracle) > 4.0 * Length(hip - this->LastHip) + 1e-4;
  this->Remaining = slips ? 3 : std::max(this->Remaining - 1, 0);
  this->LastHip = hip;
  this->LastOracle = oracle;
  return this->Remaining > 0;
}

void Accuracy::Add(const Vec3& hip, const Vec3& godObject, const Vec3& oracle)
{
  this->Position.push_back(Length(godObject - oracle));
  const Vec3 force = godObject - hip;
  const Vec3 right = oracle - hip;
  const double scale = Length(force) * Length(right);
  const double cosine = scale > 0.0 ? Dot(force, right) / scale : -1.0;
  this->Direction.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / M_PI);
  this->Magnitude.push_back(std::abs(Length(force) / Length(right) - 1.0));
}

namespace
{
double Quantile(std::vector<double> values, double quantile)
{
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(quantile * (values.size() - 1))];
}
}

double Accuracy::PositionError(double quantile) const
{
  return Quantile(this->Position, quantile);
}

double Accuracy::DirectionError(double quantile) const
{
  return Quantile(this->Direction, quantile);
}

double Accuracy::MagnitudeError(double quantile) const
{
  return Quantile(this->Magnitude, quantile);
}
}
