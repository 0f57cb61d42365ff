#include "haptics/Scene/PatchPlanner.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// Of the patch's radius: what has to be left where the hand will be.
constexpr double LeastShareLeft = 0.5;
/// A velocity is smoothed over so long [s]: less than a look, and over several of an encoder's
/// steps.
constexpr double Smoothing = 0.01;
/// No line is longer than so many radii: a hand that is so far ahead has to wait.
constexpr double LongestLine = 40.0;
/// 2^6 radii are more than the longest line.
constexpr int LargestDoubling = 6;
/// Of a radius: a place that comes through other frames is the same within this.
constexpr double SamePlace = 1e-6;
/// A slower answer is believed at once, a faster one by and by.
constexpr double ShareOfFaster = 0.1;
/// After so many latencies, and at least so long [s], an answer is lost.
constexpr double LatenciesToWait = 4.0;
constexpr double LeastTimeToWait = 0.25;
constexpr double LongestTimeToWait = 2.0;

Vec3 Sum(const Vec3& a, double factor, const Vec3& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

double Length(const Vec3& v)
{
  return std::hypot(v[0], v[1], v[2]);
}
}

std::optional<PatchRequest> PatchPlanner::Plan(const HandState& hand)
{
  if (this->Last && hand.Time > this->Last->Time)
  {
    this->Interval = hand.Time - this->Last->Time;
    const double weight = this->Interval / (this->Interval + Smoothing);
    const Vec3 way = Sum(hand.Hip, -1.0, this->Last->Hip);
    const Vec3 velocity = Sum({}, 1.0 / this->Interval, way);
    this->Velocity = Sum(this->Velocity, weight, Sum(velocity, -1.0, this->Velocity));
  }
  this->Last = hand;
  const double lead = (1.0 + this->Pause) * this->Delay + this->Interval;
  Vec3 ahead = Sum({}, lead, this->Velocity);
  const double lag = Length(Sum(hand.Hip, -1.0, hand.Position));
  if (this->IsAsking)
  {
    const double patience = std::min(LongestTimeToWait,
      std::ldexp(std::max(LeastTimeToWait, LatenciesToWait * this->Delay), this->LossesInARow));
    if (hand.Time - this->AskedAt < patience)
    {
      return std::nullopt;
    }
    ++this->Losses;
    ++this->LossesInARow;
    this->IsAsking = false;
  }
  else if (this->InForce)
  {
    const double since = hand.Time - this->AnsweredAt; // negative where the servo began anew
    if (since >= 0.0 && since < this->Pause * this->LastDelay)
    {
      return std::nullopt;
    }
    const PatchRegion& known = this->InForce->Region;
    const double left = known.Radius - known.DistanceTo(Sum(hand.Hip, 1.0, ahead)) - lag;
    const bool isReached = !hand.IsAstray ||
      (this->InForce->IsUpToSurface &&
        Length(Sum(known.From, -1.0, hand.Position)) <= SamePlace * this->Radius);
    if (isReached && (hand.IsAstray || left >= LeastShareLeft * this->Radius))
    {
      return std::nullopt;
    }
  }
  PatchRegion region;
  region.From = hand.Position;
  Vec3 line = Sum(Sum(hand.Hip, 1.0, ahead), -1.0, hand.Position);
  const double length = Length(line);
  const double longest = LongestLine * this->Radius;
  region.To = Sum(hand.Position, length > longest ? longest / length : 1.0, line);
  this->PatchesOfWait = hand.IsWaiting ? this->PatchesOfWait + 1 : 0;
  const double widest = hand.IsWaiting
    ? std::ldexp(this->Radius, std::min(this->PatchesOfWait, LargestDoubling))
    : longest;
  region.Radius = this->Radius + std::min({ lag, widest, longest });
  this->IsAsking = true;
  this->AskedAt = hand.Time;
  return PatchRequest{ region, hand.Time, hand.IsAstray };
}

void PatchPlanner::Receive(double time, const PatchRequest& request)
{
  const double delay = std::max(0.0, time - request.Time);
  this->AnsweredAt = time;
  this->LastDelay = delay;
  this->Delay = delay > this->Delay ? delay : this->Delay + ShareOfFaster * (delay - this->Delay);
  this->InForce = request;
  this->IsAsking = false;
  this->LossesInARow = 0;
}

void PatchPlanner::Forget()
{
  this->InForce.reset();
  this->Last.reset();
  this->Velocity = {};
  this->IsAsking = false;
  this->LossesInARow = 0;
  this->PatchesOfWait = 0;
}
}
