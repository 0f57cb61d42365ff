#include "haptics/Devices/Falcon/FalconChannel.h"

#include "haptics/Devices/Falcon/FalconLink.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
// The transport gives up first where the device is silent; this is for a transport that gets no
// time.
constexpr double LongestSilence = 0.2; // [s]
// A force for an older position is none.
constexpr double OldestPosition = 0.02; // [s]
// What the servo writes waits for the next exchange, at most so long or until the last is over.
constexpr double ExchangePeriod = 0.001; // [s]
}

FalconChannel::FalconChannel(
  std::shared_ptr<FalconLink> link, double torqueScale, double maximumForce)
  : Link(std::move(link))
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
      return "The Falcon's encoders tell a pose that its arms cannot take, so its origin is wrong. "
             "Close it, open it and home it again.";
    default:
      return "";
  }
}

bool FalconChannel::ReadDevice(double time, DeviceSample& sample) noexcept
{
  if (!this->Link->Up.load(std::memory_order_acquire))
  {
    return false;
  }
  const bool answered = this->Link->Answers.Update() || this->TookAnswer;
  this->TookAnswer = false;
  if (answered || time < this->Answered)
  {
    this->Answered = time; // a smaller time: the servo was started anew
  }
  else if (time - this->Answered > LongestSilence)
  {
    this->Trouble.store(Problem::OldAnswer, std::memory_order_release);
    return false;
  }
  const FalconAnswer& answer = this->Link->Answers.Get();
  const FalconReply& reply = answer.Reply;
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
  sample.Latency = std::max(ExchangePeriod, answer.Age) + answer.Age;
  // In each such tick: the force grows from zero after the last of them.
  this->HasTorques = time - this->Answered + answer.Age <= OldestPosition &&
    FalconKinematics::Jacobian(this->Position, this->Angles, this->JacobianHere);
  this->OwnReleases += this->HasTorques ? 0 : 1;
  sample.Releases = static_cast<std::uint32_t>(answer.Releases) + this->OwnReleases;
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
  this->Link->Demands.Publish({ torques, this->Link->Halts.load(std::memory_order_acquire),
    this->Link->Answers.Get().Releases });
}

void FalconChannel::HaltDevice() noexcept
{
  this->Link->Halts.fetch_add(1, std::memory_order_acq_rel);
}

bool FalconChannel::WaitForSample(std::uint64_t timeout) noexcept
{
  const timespec deadline = DeadlineIn(timeout);
  // The bell rang for answers that were read long ago, too.
  while (!this->TookAnswer)
  {
    this->TookAnswer = this->Link->Answers.Update();
    if (!this->TookAnswer && !this->Link->Bell.WaitUntil(deadline))
    {
      return false;
    }
  }
  return true;
}

void FalconChannel::Settle(std::uint64_t timeout) noexcept
{
  const timespec deadline = DeadlineIn(timeout);
  // The exchange that is under way may carry the demand before; the next one carries the last.
  // Read by an addition: whatever adds after it sees the demand.
  const std::uint64_t enough = this->Link->Exchanges.fetch_add(0, std::memory_order_acq_rel) + 2;
  while (this->Link->Exchanges.load(std::memory_order_acquire) < enough &&
    !this->Link->Over.load(std::memory_order_acquire) && this->Link->Bell.WaitUntil(deadline))
  {
  }
}
}
