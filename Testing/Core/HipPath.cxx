#include "HipPath.h"

#include "AnalyticSurfaces.h"

#include <algorithm>
#include <cmath>

namespace haptics::testing
{
namespace
{
constexpr double TickTime = 1e-3; // [s]
}

const char* HipPath::NameOf(Kind kind)
{
  static const char* const names[] = { "smooth", "jitter", "jump", "along lines", "plunge" };
  return names[kind];
}

std::string HipPath::IdentifierOf(Kind kind)
{
  std::string name = NameOf(kind);
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
}

HipPath::HipPath(Kind kind, double reach, unsigned seed)
  : Way(kind)
  , Reach(reach)
  , Random(seed)
{
  this->Direction = Unit(this->Normals());
}

double HipPath::Normal()
{
  return std::normal_distribution<double>()(this->Random);
}

Vec3 HipPath::Normals()
{
  const double x = this->Normal();
  const double y = this->Normal();
  return { x, y, this->Normal() };
}

Vec3 HipPath::Anywhere()
{
  std::uniform_real_distribution<double> place(-1.2 * this->Reach, 1.2 * this->Reach);
  const double x = place(this->Random);
  const double y = place(this->Random);
  return { x, y, place(this->Random) };
}

Vec3 HipPath::Next()
{
  ++this->Tick;
  switch (this->Way)
  {
    case Jump:
      return this->Anywhere();
    case Jitter:
      if (this->Tick % 50 == 1)
      {
        this->Base = this->Anywhere();
      }
      return this->Base + 0.002 * this->Reach * this->Normals();
    case AlongLines:
      return this->NextAlongLines();
    case Plunge:
      if (this->Tick % 40 == 1)
      {
        this->Base = 2.0 * this->Reach * Unit(this->Anywhere());
        this->Direction = Unit(this->Anywhere() - this->Base);
      }
      this->Base = this->Base + 5.0 * TickTime * this->Direction;
      return this->Base;
    default:
      return this->NextSmooth();
  }
}

Vec3 HipPath::NextSmooth()
{
  // Strokes of up to about 0.3 m/s at 30 mm, with presses of some millimetres.
  this->Spin = 0.995 * this->Spin + 0.25 * this->Normals();
  this->Direction = Unit(this->Direction + TickTime * Cross(this->Spin, this->Direction));
  const double depth = -0.1 + 0.25 * (1.0 - std::cos(2.0 * M_PI * 0.7 * TickTime * this->Tick));
  const Vec3 hip = (this->Reach * (1.0 - depth)) * this->Direction;
  const double encoder = 5.5e-5; // [m], a usual resolution
  return { encoder * std::floor(hip[0] / encoder), encoder * std::floor(hip[1] / encoder),
    encoder * std::floor(hip[2] / encoder) };
}

Vec3 HipPath::NextAlongLines()
{
  const double lines[] = { 0.0, 0.25, -0.25, 0.5, 1.0 };
  const double a = this->Reach * std::sin(0.0013 * this->Tick);
  const double depth = 0.25 * (0.5 - 0.5 * std::cos(0.0051 * this->Tick)) - 0.1;
  const double z = this->Reach * (1.0 - depth);
  const double y = this->Reach * lines[(this->Tick / 3000) % 5];
  switch ((this->Tick / 1000) % 3)
  {
    case 0:
      return { a, y, z };
    case 1:
      return { y, a, z };
    default:
      return { a, a, z };
  }
}
}
