#ifndef Haptics_HaplyDriver_h
#define Haptics_HaplyDriver_h

#include "haptics/Devices/Driver/DeviceDriver.h"
#include "haptics/Devices/Haply/HaplyMessage.h"
#include "haptics/Devices/Haply/HaplySocket.h"

#include <string>
#include <utility>
#include <vector>

namespace haptics
{
/// @brief Exchanges with one Inverse3 through the Inverse Service, in lock-step at 1 kHz.
///
/// The service sends one state for each message, so the driver sets the pace. A state that is more
/// than 20 ms late is answered by a message with zero force, and no position counts until there are
/// as many states as messages again.
class HaplyDriver : public DeviceDriver
{
public:
  /// The first Inverse3 that the service reports where `id` is empty.
  HaplyDriver(std::string id, int port);

  void Open(DriverContext& context) override;
  void Serve(
    ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready) override;
  void Close() noexcept override;

  /// The ids of what the service at this port reports, each with its state in a sentence. Throws
  /// DeviceFault where there is no service.
  static std::vector<std::pair<std::string, std::string>> List(int port);

private:
  const HaplyDevice& FindWanted() const;
  const HaplyDevice& Find() const;
  void Choose(DriverContext& context);
  void ReadVersion();
  void SayHello();
  void WaitUntilCalibrated(DriverContext& context);
  bool TryOnce(const std::array<double, 3>& force, HaplySocket::Clock::time_point deadline);
  void CatchUp(DriverContext& context);
  void DropLateStates();
  void Check() const;

  const std::string WantedId;
  HaplySocket Socket;
  HaplyVersion Version;
  HaplyState State;
  std::string Id;
  std::string Permutation;
  std::string Message;                       // of which the memory is used again
  int Unanswered = 0;                        // messages sent whose state has not come
  HaplySocket::Clock::time_point DoubtUntil; // till then a state may be of an earlier message
  int Damaged = 0;                           // messages in a row that were no state
  bool HasSentForce = false;
};
}

#endif
