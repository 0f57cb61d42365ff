#ifndef Haptics_ForceExchange_h
#define Haptics_ForceExchange_h

#include "haptics/Devices/Driver/ForceLink.h"

#include <array>
#include <cstdint>
#include <memory>

namespace haptics
{
/// @brief The device's end of a ForceLink: which force to send, and what came back.
///
///     each exchange:  NextForce() -> to the device, from the device -> Publish()
///
/// A force is zero where nobody renewed it for 20 ms, where a watchdog has halted the device or the
/// driver has let go since it was asked for, and where it is not finite; it is shortened to the
/// largest one. For one thread, which may be a vendor's real-time thread: neither call waits,
/// allocates or locks.
class ForceExchange
{
public:
  ForceExchange(std::shared_ptr<ForceLink> link, double maximumForce);

  /// The force to send now, device frame [N].
  std::array<double, 3> NextForce() noexcept;
  /// The device did not hold what was sent last: nothing that was asked for so far is sent any
  /// more, and what comes after it grows softly from zero.
  void LetGo() noexcept;
  /// What the device reported, `age` [s] after it can have been measured at the earliest.
  void Publish(const DriverSample& sample, double age) noexcept;

private:
  const std::shared_ptr<ForceLink> Link;
  const double MaximumForce;
  std::int64_t RenewedAt; // when the servo asked last [ns]
  bool IsWithdrawn = true;
  std::uint64_t Releases = 0;
};
}

#endif
