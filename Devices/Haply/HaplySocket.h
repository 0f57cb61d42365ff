#ifndef Haptics_HaplySocket_h
#define Haptics_HaplySocket_h

#include "vtkHapticsDevicesModule.h"

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

namespace haptics
{
/// @brief A connection to the Inverse Service on this machine: its HTTP and its WebSocket, by
/// Boost.Beast. For one thread; it throws DeviceFault where the connection fails.
class VTKHAPTICSDEVICES_EXPORT HaplySocket
{
public:
  using Clock = std::chrono::steady_clock;

  explicit HaplySocket(int port);
  ~HaplySocket();
  HaplySocket(const HaplySocket&) = delete;
  HaplySocket& operator=(const HaplySocket&) = delete;

  /// What the service answers to GET, within half a second; empty where it answers an error.
  std::string Get(const char* target);
  /// Opens the WebSocket, within half a second.
  void Connect();
  bool IsConnected() const;
  /// Sends a text message; waits 100 ms at most until the system has taken it.
  void Send(const std::string& text);
  /// The next message, valid until the next call; false where none has come by then. A message that
  /// comes later is the next one.
  bool Receive(std::string_view& text, Clock::time_point deadline);
  /// Says good-bye and lets go, within 50 ms. Throws nothing.
  void Close() noexcept;

private:
  struct Implementation;
  const int Port;
  std::unique_ptr<Implementation> Self; // null while not connected
};
}

#endif
