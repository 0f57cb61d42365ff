#ifndef Haptics_DeviceDriver_h
#define Haptics_DeviceDriver_h

#include "haptics/Devices/DevicePhase.h"
#include "haptics/Devices/Driver/ForceLink.h"

#include <atomic>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace haptics
{
/// @brief Something is wrong with a device: what() says what, and what helps.
class DeviceFault : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// @brief The owner asked to stop.
struct DriverStopped
{
};

/// What a device can do, as it reports itself or its maker documents it.
struct DriverLimits
{
  std::string Name;                  ///< model and serial number
  double MaximumForce = 0.0;         ///< [N]
  double MaximumStiffness = 0.0;     ///< [N/m]
  std::array<double, 6> Workspace{}; ///< xmin, xmax, ymin, ymax, zmin, zmax [m], device frame
  int Buttons = 0;
};

/// What a driver's thread reports.
struct DriverStatus
{
  DevicePhase Phase = DevicePhase::Opening;
  std::string Text; ///< what goes on, or what is wrong and what helps
  DriverLimits Limits;
  bool IsRealTime = false; ///< whether the thread got real-time priority
  /// What the servo talks through; another one each time the device is brought up.
  std::shared_ptr<ForceLink> Link = std::make_shared<ForceLink>();
};

class ForceExchange;

/// @brief What a driver finds around it: where to report, and whether to stop. Driver's thread.
class DriverContext
{
public:
  virtual void Report(DevicePhase phase, const std::string& text) = 0;
  virtual void SetLimits(const DriverLimits& limits) = 0;
  /// Throws DriverStopped once the owner wants the device let go of.
  virtual void CheckStop() const = 0;

protected:
  ~DriverContext() = default;
};

/// @brief One kind of device, as its thread sees it: DriverThread calls Open(), Serve() and Close()
/// in this order, again and again where it reconnects.
///
/// Open() and Serve() throw DeviceFault, and DriverStopped by way of DriverContext::CheckStop(),
/// which they call at least every 50 ms.
class DeviceDriver
{
public:
  virtual ~DeviceDriver() = default;

  /// Finds and takes the device, and waits until it is calibrated; no force until then.
  virtual void Open(DriverContext& context) = 0;
  /// Exchanges a thousand times a second. Calls `ready` after the first exchange. `exchange` stays
  /// until Close() has returned.
  virtual void Serve(
    ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready) = 0;
  /// Leaves the device without force, where it can still be reached, and lets go of it. Also after
  /// an Open() that threw. Waits for 100 ms at most, and for the vendor's library.
  virtual void Close() noexcept = 0;
};
}

#endif
