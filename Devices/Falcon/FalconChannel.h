#ifndef Haptics_FalconChannel_h
#define Haptics_FalconChannel_h

#include "haptics/Devices/Falcon/FalconKinematics.h"
#include "haptics/Devices/Falcon/FalconLink.h"
#include "haptics/Devices/LinkedChannel.h"
#include "vtkHapticsDevicesModule.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace haptics
{
/// @brief The servo thread's end of a Falcon: encoder counts to a position, a force to torques.
///
/// Talks to the FalconTransport through its link, wait-free; never to libusb.
class VTKHAPTICSDEVICES_EXPORT FalconChannel : public LinkedChannel<FalconLink>
{
public:
  /// The torque scale [motor units per N m], see vtkFalconHapticDevice; the largest force [N].
  FalconChannel(std::shared_ptr<FalconLink> link, double torqueScale, double maximumForce);
  ~FalconChannel() override;

  /// Why Read() returned false, in a sentence; empty where it did not, and where the transport
  /// ended the session and reports the cause. Any thread.
  const char* GetProblem() const noexcept;

protected:
  bool ReadDevice(double time, DeviceSample& sample) noexcept override;
  void WriteDevice(const std::array<double, 3>& force) noexcept override;

private:
  enum class Problem
  {
    None,
    OldAnswer,
    ImpossiblePose
  };

  const double TorqueScale;
  const double MaximumForce;
  std::atomic<Problem> Trouble{ Problem::None };

  // The servo thread's own.
  FalconKinematics::Vector Angles{};
  FalconKinematics::Vector Position{};
  FalconKinematics::Matrix JacobianHere{};
  bool HasTorques = false; // the position is new enough, and no singular one
};
}

#endif
