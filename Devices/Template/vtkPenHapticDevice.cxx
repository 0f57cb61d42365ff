#include "vtkPenHapticDevice.h"

#include "Pen.h"

#include <haptics/Devices/MonitoredChannel.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <atomic>

/// The servo thread's end. ReadDevice() and WriteDevice() are called once a tick each, in this
/// order, and neither may wait, allocate, lock or log: a device that has to wait for a bus does so
/// in a thread of its own, with haptics::LatestValue between the two (see the Falcon's driver).
class vtkPenHapticDevice::PenChannel : public haptics::MonitoredChannel
{
public:
  bool Connect() { return this->Driver.Connect(); }
  /// Leaves no force. GUI thread, while the servo thread may be in a tick.
  void Disconnect()
  {
    this->IsDisconnected.store(true);
    this->Driver.Disconnect();
  }

protected:
  bool ReadDevice(double time, haptics::DeviceSample& sample) noexcept override
  {
    sample.Buttons = 0; // bit i is set while button i is held
    return this->Driver.GetPosition(
      time, sample.Position); // false: lost, and no force from here on
  }

  void WriteDevice(const std::array<double, 3>& force) noexcept override
  {
    this->Driver.SetForce(force);
    if (this->IsDisconnected.load()) // meanwhile
    {
      this->Driver.SetForce({});
    }
  }

  /// The servo hangs. From a watchdog's thread; what the servo writes is zero until it goes on.
  void HaltDevice() noexcept override { this->Driver.SetForce({}); }

private:
  Pen Driver;
  std::atomic<bool> IsDisconnected{ false };
};

vtkStandardNewMacro(vtkPenHapticDevice);

vtkPenHapticDevice::vtkPenHapticDevice()
{
  this->MaximumForce = 3.0;       // [N]: longer forces are shortened to it
  this->MaximumStiffness = 500.0; // [N/m]
  this->Damping = 1.0;            // [N s/m] of its mechanics: the servo keeps the stiffness below
  this->Latency = 0.001;          // [s]  what these two can hold
  this->NumberOfButtons = 0;
  const double bounds[6] = { -0.05, 0.05, -0.05, 0.05, -0.02, 0.02 }; // [m]
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
}

vtkPenHapticDevice::~vtkPenHapticDevice()
{
  this->Close();
}

bool vtkPenHapticDevice::Open()
{
  if (!this->IsOpen())
  {
    this->Channel = std::make_shared<PenChannel>();
    if (!this->Channel->Connect())
    {
      this->Channel.reset();
      this->Fail(Closed, "No pen is plugged in. Connect its cable and try again.");
      return false;
    }
    this->BecomeReady(this->Channel);
  }
  return true;
}

void vtkPenHapticDevice::Close()
{
  this->BecomeClosed(); // whoever has the channel reads "lost" from here on
  if (this->Channel)
  {
    this->Channel->Disconnect();
    this->Channel.reset();
  }
}
