#include "haptics/Devices/Falcon/FalconChannel.h"

#include <cmath>
#include <utility>

namespace haptics
{
FalconChannel::FalconChannel(
  std::shared_ptr<FalconLink> link, double torqueScale, double maximumForce)
  : LinkedChannel(std::move(link))
  , TorqueScale(torqueScale)
  , MaximumForce(maximumForce)
{
}

FalconChannel::~FalconChannel() = default;

const char* FalconChannel::GetProblem() const noexcept
{
  switch (this->Trouble.load(std::memory_order_acquire))
  {
    case Problem::OldAnswer:
      return "No new position of the Falcon came for 0.2 s: the machine is too busy. Relieve it, "
             "or let the program have real-time priority, then open the device again.";
    case Problem::ImpossiblePose:
      return "The Falcon's encoders report a pose that its arms cannot take, so its origin is "
             "wrong. "
             "Close it, open it and home it again.";
    default:
      return "";
  }
}

bool FalconChannel::ReadDevice(double time, DeviceSample& sample) noexcept
{
  const Reading reading = this->Take(time);
  if (reading == Reading::Silent)
  {
    this->Trouble.store(Problem::OldAnswer, std::memory_order_release);
  }
  if (reading != Reading::Answer)
  {
    return false;
  }
  const FalconReply& reply = this->Linked->Answers.Get().Reply;
  for (std::size_t leg = 0; leg < 3; ++leg)
  {
    this->Angles[leg] = FalconKinematics::AngleOfCount(reply.Encoders[leg]);
  }
  if (!FalconKinematics::Forward(this->Angles, this->Position))
  {
    this->Trouble.store(Problem::ImpossiblePose, std::memory_order_release);
    return false;
  }
  sample.Position = this->Position;
  sample.Buttons = reply.Buttons;
  this->HasTorques = this->IsFresh(time) &&
    FalconKinematics::Jacobian(this->Position, this->Angles, this->JacobianHere);
  this->Account(this->HasTorques, sample);
  return true;
}

void FalconChannel::WriteDevice(const std::array<double, 3>& force) noexcept
{
  std::array<double, 3> torques{};
  if (this->HasTorques)
  {
    torques = FalconKinematics::Torques(this->JacobianHere, force);
  }
  const double magnitude = std::hypot(force[0], force[1], force[2]);
  const double share = magnitude > this->MaximumForce ? this->MaximumForce / magnitude : 1.0;
  for (double& torque : torques)
  {
    torque *= share * this->TorqueScale;
  }
  // What is not finite becomes zero where it is sent.
  this->Demand(torques);
}
}
