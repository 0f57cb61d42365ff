#ifndef Haptics_OpenHapticsDriver_h
#define Haptics_OpenHapticsDriver_h

#include "haptics/Devices/Driver/DeviceDriver.h"
#include "haptics/Devices/OpenHaptics/HdLibrary.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace haptics
{
/// @brief Exchanges with one Touch or Phantom, on OpenHaptics' own scheduler.
///
/// The vendor's thread calls Tick() once a millisecond, which reads the position and sends the
/// servo's force; this driver's thread watches that it does, and what it met. HDAPI has one
/// scheduler a process: so one device a process, whichever object opens it.
class OpenHapticsDriver : public DeviceDriver
{
public:
  /// The default device where `name` is empty. `resetsEncoders`: see vtkOpenHapticsDevice.
  OpenHapticsDriver(std::string name, std::string libraryFile, bool resetsEncoders);
  ~OpenHapticsDriver() override;

  void Open(DriverContext& context) override;
  void Serve(
    ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready) override;
  void Close() noexcept override;

private:
  static unsigned int OnTick(void* self);
  void Tick() noexcept;
  void Calibrate() noexcept;
  void Take(DriverContext& context);
  void ReadLimits(DriverContext& context);
  void Watch(DriverContext& context);
  void ThrowAtError() const;

  const std::string DeviceName;
  const std::string LibraryFile;
  const bool ResetsEncoders;
  std::unique_ptr<HdLibrary> Hd;
  bool HasScheduler = false; // of this process
  unsigned int Device = HdLibrary::InvalidDevice;
  unsigned long Scheduled = 0;
  bool IsScheduled = false;
  std::int64_t LastTick = 0; // as Watch() saw it [ns]
  std::uint64_t SeenTicks = 0;

  // Shared with the vendor's thread.
  std::atomic<ForceExchange*> Exchange{ nullptr };
  std::atomic<bool> IsParting{ false };
  std::atomic<std::uint64_t> Ticks{ 0 };
  std::atomic<unsigned int> Fault{ 0 };
  std::atomic<bool> HasBadPosition{ false };
  std::atomic<unsigned int> Calibration{ 0 }; // 0 until it was looked at

  // The vendor's thread's own.
  int CalibrationStyle = 0;
};
}

#endif
