#ifndef Haptics_FalconChannel_h
#define Haptics_FalconChannel_h

#include "haptics/Devices/Falcon/FalconKinematics.h"
#include "haptics/Devices/MonitoredChannel.h"
#include "vtkHapticsDevicesModule.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace haptics
{
struct FalconLink;

/// @brief The servo thread's end of a Falcon: encoder counts to a position, a force to torques.
///
/// Talks to the FalconTransport through its link, wait-free; never to libusb.
class VTKHAPTICSDEVICES_EXPORT FalconChannel : public MonitoredChannel
{
public:
  /// The torque scale [motor units per N m], see vtkFalconHapticDevice; the largest force [N].
  FalconChannel(std::shared_ptr<FalconLink> link, double torqueScale, double maximumForce);
  ~FalconChannel() override;

  bool SetsPace() const noexcept override { return true; }
  bool WaitForSample(std::uint64_t timeout) noexcept override;
  void Settle(std::uint64_t timeout) noexcept override;

  /// Why Read() returned false, for people; empty where it did not, and where the transport ended
  /// the session and tells why. Any thread.
  const char* GetProblem() const noexcept;

protected:
  bool ReadDevice(double time, DeviceSample& sample) noexcept override;
  void WriteDevice(const std::array<double, 3>& force) noexcept override;
  void HaltDevice() noexcept override;

private:
  enum class Problem
  {
    None,
    OldAnswer,
    ImpossiblePose
  };

  const std::shared_ptr<FalconLink> Link;
  const double TorqueScale;
  const double MaximumForce;
  std::atomic<Problem> Trouble{ Problem::None };

  // The servo thread's own.
  bool TookAnswer = false; // by WaitForSample()
  double Answered = 0.0;   // when the last new answer was read [s]
  FalconKinematics::Vector Angles{};
  FalconKinematics::Vector Position{};
  FalconKinematics::Matrix JacobianHere{};
  bool HasTorques = false; // the position is new enough, and no singular one
  std::uint32_t OwnReleases = 0;
};
}

#endif
