#ifndef Haptics_VhciBus_h
#define Haptics_VhciBus_h

#include "FalconModel.h"

#include <list>
#include <mutex>
#include <thread>

/// @brief A FalconModel plugged into the kernel's virtual USB host controller.
///
/// The kernel believes in a device on the network (USB/IP); its end of the connection is here.
/// Needs root and the module vhci-hcd.
class VhciBus
{
public:
  VhciBus() = default;
  ~VhciBus();
  VhciBus(const VhciBus&) = delete;
  VhciBus& operator=(const VhciBus&) = delete;

  void Plug(const FalconModel& model);
  /// Breaks the connection: the kernel sees a cable pulled.
  void Unplug();
  /// Calls look(FalconModel&) while nothing else touches the device.
  template <typename Look>
  auto With(Look look)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return look(this->Model);
  }

private:
  struct Pending
  {
    std::uint32_t Number;
    std::uint32_t Size;
    FalconModel::Clock::time_point Start;
  };

  void Run();
  void Receive();
  void Submit(const std::uint32_t* header, std::uint32_t number);
  void Service();
  void Answer(
    std::uint32_t number, int status, const std::vector<std::uint8_t>& bytes, std::uint32_t length);
  bool ReadAll(void* bytes, std::size_t size);

  std::mutex Mutex;
  FalconModel Model;
  std::list<Pending> Waiting;
  std::thread Thread;
  int Socket = -1;
  bool Over = false;
};

#endif
