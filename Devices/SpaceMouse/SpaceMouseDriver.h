#ifndef Haptics_SpaceMouseDriver_h
#define Haptics_SpaceMouseDriver_h

#include "haptics/Devices/Driver/DeviceDriver.h"

#include <array>
#include <string>

namespace haptics
{
/// How a cap's deflection becomes motion.
struct SpaceMouseMotion
{
  double Speed = 0.06;            ///< of the hand, with the cap fully deflected [m/s]
  double DeadZone = 0.08;         ///< share of the full deflection that moves nothing
  std::array<double, 6> Bounds{}; ///< that the hand stays in [m]

  /// The hand's velocity [m/s], device frame, of the daemon's three numbers, an axis each.
  std::array<double, 3> Velocity(const std::array<int, 3>& deflection) const;
};

/// @brief Follows a SpaceMouse through spacenavd, by libspnav. It gives no force.
///
/// The daemon reports deflections when they change; the hand goes on at that rate until the next
/// report. libspnav has one connection a process: so one device a process.
class SpaceMouseDriver : public DeviceDriver
{
public:
  explicit SpaceMouseDriver(const SpaceMouseMotion& motion);

  void Open(DriverContext& context) override;
  void Serve(
    ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready) override;
  void Close() noexcept override;

  /// The state of the daemon in a sentence.
  static std::string Describe();

private:
  void Connect(const DriverContext* context = nullptr);
  std::string ReadName() const;
  void ReadEvents();

  const SpaceMouseMotion Motion;
  bool IsConnected = false;
  std::array<int, 3> Deflection{};
  std::uint32_t Buttons = 0;
};
}

#endif
