#include "haptics/Contact/BallFacet.h"

#include "haptics/Math/Predicates.h"
#include "haptics/Surface/Facet.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// Of a facet with less of a height over its longest edge, which is no error of a normal yet, but
/// may be one of a neighbour of an edge, the nearest edge is always looked for.
constexpr double ThinShare = 0x1p-16;
/// Nearer to an edge or its ends, by its length, than this there is no direction from it.
constexpr double NoDirection = 8.0 * UnitRoundoff;
/// From where it is so much of an edge's square, the square of a distance has digits to spare.
constexpr double NearShare = 0x1p-20;

double Least(const Vector& normal, const Vector& fromA, const Vector& fromB, const Vector& fromC)
{
  return std::min({ glm::dot(normal, fromA), glm::dot(normal, fromB), glm::dot(normal, fromC) });
}
}

void BallFacet::Set(const Vector& a, const Vector& b, const Vector& c)
{
  this->A = a;
  this->B = b;
  this->C = c;
  const Facet plane(a, b, c);
  this->Normal = plane.HasArea() ? plane.Normal : Vector(0.0);
  this->Doubt = plane.DistanceError(1.0);
  this->IsThin = !(plane.SmallestHeight > ThinShare * plane.LongestEdge);
  this->Edges[0] = b - a;
  this->Edges[1] = c - b;
  this->Edges[2] = a - c;
  for (int k = 0; k < 3; ++k)
  {
    this->SquaredLengths[k] = SquaredLength(this->Edges[k]);
    this->Inward[k] = glm::cross(this->Normal, this->Edges[k]);
  }
}

double BallFacet::LeastHeight(const Vector& x) const
{
  return Least(this->Normal, x - this->A, x - this->B, x - this->C);
}

bool BallFacet::IsBehind(const Vector& x, double height) const
{
  const bool isCertain = height * height > this->Doubt * this->Doubt * SquaredLength(x - this->A);
  return isCertain ? height < 0.0 : Orientation(this->A, this->B, this->C, x) < 0;
}

void BallFacet::Separate(bool isOneSided, const Vector& x, Separation& separation) const
{
  const Vector from[3] = { x - this->A, x - this->B, x - this->C };
  const double height = glm::dot(this->Normal, from[0]);
  const bool isBeyond[3] = { glm::dot(this->Inward[0], from[0]) < 0.0,
    glm::dot(this->Inward[1], from[1]) < 0.0, glm::dot(this->Inward[2], from[2]) < 0.0 };
  const bool isOver = !isBeyond[0] && !isBeyond[1] && !isBeyond[2];
  const auto separateByPlane = [&]
  {
    const bool isFromBack = !isOneSided && this->IsBehind(x, height);
    separation.Normal = isFromBack ? -this->Normal : this->Normal;
    separation.Distance = Least(separation.Normal, from[0], from[1], from[2]);
    separation.Edge = -1;
    separation.Corner = -1;
  };
  separation.Height = height;
  if (isOver)
  {
    separateByPlane();
    if (!this->IsThin)
    {
      return;
    }
  }
  // Beyond an edge the nearest point is on one of those; over a thin facet it may as well be.
  double least = HUGE_VAL;
  Vector across(0.0);
  int nearest = -1;
  int corner = -1;
  const auto take = [&](int k, int next)
  {
    const double length = this->SquaredLengths[k];
    const double share =
      length > 0.0 ? std::clamp(glm::dot(from[k], this->Edges[k]) / length, 0.0, 1.0) : 0.0;
    const Vector away = share == 1.0 ? from[next] : from[k] - share * this->Edges[k];
    const double squared = SquaredLength(away);
    if (squared < least)
    {
      least = squared;
      across = away;
      nearest = k;
      corner = share == 0.0 ? k : share == 1.0 ? next : -1;
    }
  };
  // Each by itself, so that no register is looked up by an index.
  if (isBeyond[0] || isOver)
  {
    take(0, 1);
  }
  if (isBeyond[1] || isOver)
  {
    take(1, 2);
  }
  if (isBeyond[2] || isOver)
  {
    take(2, 0);
  }
  const Vector along = nearest < 0 ? Vector(0.0) : this->Edges[nearest];
  // As near to an edge as rounding, it would lean over an end.
  const double length = nearest < 0 ? 0.0 : this->SquaredLengths[nearest];
  if (corner < 0 && least < NearShare * length)
  {
    across -= (glm::dot(across, along) / length) * along;
    least = SquaredLength(across);
  }
  if (least <= NoDirection * NoDirection * length)
  {
    separateByPlane();
    return;
  }
  const Vector normal = across / std::sqrt(least);
  const double distance = Least(normal, from[0], from[1], from[2]);
  if (!isOver || distance > separation.Distance)
  {
    separation.Normal = normal;
    separation.Distance = distance;
    separation.Edge = nearest;
    separation.Corner = corner;
  }
}
}
