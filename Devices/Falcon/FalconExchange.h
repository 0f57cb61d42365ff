#ifndef Haptics_FalconExchange_h
#define Haptics_FalconExchange_h

#include "haptics/Devices/Falcon/FalconLink.h"
#include "haptics/Devices/Falcon/FalconUsb.h"

#include <cstdint>
#include <functional>

namespace haptics
{
/// @brief Exchanges packets with a Falcon whose firmware runs. For the thread of its FalconUsb.
class FalconExchange
{
public:
  /// Both must outlive it.
  FalconExchange(FalconUsb& usb, FalconLink& link);

  /// True where the firmware answers. Takes up to 0.1 s.
  bool IsAnswered();
  /// Exchanges with zero torque until all legs are homed. `progress` gets the homed legs, whenever
  /// they change.
  void Home(const std::function<void(std::uint8_t)>& progress);
  /// Exchanges the servo's torques, until FalconFault or FalconStopped is thrown. Calls `ready`
  /// once, when the link is up.
  void Serve(double commandTimeout, const std::function<void()>& ready);
  /// Sends zero torque, dark lamps. Waits for 50 ms at most; throws what FalconUsb throws.
  void SayFarewell();

private:
  enum class Outcome
  {
    Silent,   ///< no reply
    Unsure,   ///< a reply, which may be one to an earlier packet
    Answered, ///< the reply to this packet
  };

  Outcome TryOnce(const FalconCommand& command, FalconReply& reply);
  bool ReadOnce(FalconReply& reply, std::int64_t rest);
  void WaitForLateReplies(std::int64_t deadline);
  void DropLateReplies();
  FalconReply Exchange(FalconCommand command);
  void WaitForNextTick();

  FalconUsb& Usb;
  FalconLink& Link;
  FalconPacketReader Reader;
  FalconUsb::Transfer Out;
  FalconUsb::Transfer In;
  int Unanswered = 0;          // packets sent whose reply may still come
  std::int64_t Age = 0;        // of the last reply [ns]: since its packet was sent
  std::uint64_t Releases = 0;  // times that torques became zero here, not in the servo
  std::int64_t DoubtUntil = 0; // [ns] on the steady clock; so long late replies may come
  std::int64_t NextTick = 0;   // [ns] on the steady clock
};
}

#endif
