#include "haptics/Contact/SceneGodObject.h"

namespace haptics
{
void SceneGodObject::Place(const Vector& position)
{
  const bool isFirst = !this->God.IsPlaced;
  this->God.Position = position;
  this->God.IsPlaced = true;
  this->God.IsSplit = false;
  this->God.SurfaceDisplacement = Vector(0.0);
  this->God.Active.Clear();
  this->God.Cone.Reset();
  this->LastHip = position;
  this->God.HipBefore = position;
  this->Planes.Forget();
  this->God.Around.IsFit = false;
  for (BallSet& ball : this->God.Around.Balls)
  {
    ball.Restart();
  }
  this->Moving.TakePoses();
  for (std::size_t i = 0; i < this->God.Around.TouchableCount; ++i)
  {
    this->God.Around.Sets[i].Restart(position);
  }
  for (std::size_t i = this->God.Around.TouchableCount; isFirst && i < this->God.Around.Sets.size();
       ++i)
  {
    SurfaceMotion* const motion = this->God.Around.Surfaces[i].Motion.get();
    this->God.Around.Sets[i].SetFrame(this->God.Around.FrameOf(
      static_cast<std::int32_t>(i), motion ? motion->Advance(0.0) : RigidPose()));
    this->God.Around.Sets[i].Restart(position);
  }
}

void SceneGodObject::Update(const Vector& hip)
{
  this->God.Around.RenewBudget();
  this->God.IsOverloaded = false;
  this->God.Way[0] = ToVec3(this->God.Position);
  this->God.WaySize = 1;
  this->Planes.Start = 0;
  this->Planes.Left = LargestNumberOfReleases;
  this->Planes.GoalMoved = glm::length(hip - this->LastHip);
  this->LastHip = hip;
  const Vector from = this->God.HipBefore;
  this->God.HipBefore = hip;
  if (this->God.IsSplit)
  {
    if (!this->Moving.Join(hip))
    {
      return;
    }
    this->God.Way[0] = ToVec3(this->God.Position); // where it is one again
  }
  this->Walker.Begin();
  if (this->Follower.SubstepsAllowed > 1 && from != hip && !this->God.Around.IsBall())
  {
    this->Follower.Follow(from, hip);
    return;
  }
  this->Walker.Approach(hip);
}
}
