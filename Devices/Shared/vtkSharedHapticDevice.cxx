#include "vtkSharedHapticDevice.h"

#include "haptics/Devices/MonitoredChannel.h"
#include "haptics/Devices/Shared/SharedExchange.h"

#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <sstream>
#include <thread>
#include <utility>

namespace
{
constexpr std::chrono::milliseconds Patience{ 50 }; // for a first position, in Open()
}

/// The servo thread's end.
class vtkSharedHapticDevice::SharedChannel : public haptics::MonitoredChannel
{
public:
  SharedChannel(vtkDoubleArray* values, double timeout)
    : Values(values)
    , Exchange(values->GetPointer(0))
    , Timeout(timeout)
  {
  }

  void Restart() noexcept override { this->ChangedAt = Clock::now(); }
  /// No force, and none later: the device is closed. GUI thread.
  void Release() noexcept
  {
    this->Close();
    this->Exchange.SetLive(false);
  }

protected:
  bool ReadDevice(double, haptics::DeviceSample& sample) noexcept override
  {
    haptics::SharedHand hand;
    double sequence = 0.0;
    if (this->Exchange.ReadHand(hand, sequence))
    {
      if (sequence != this->Sequence)
      {
        this->Sequence = sequence;
        this->ChangedAt = Clock::now();
      }
      this->Hand = hand;
    }
    sample.Position = this->Hand.Position;
    sample.Buttons = this->Hand.Buttons;
    return !this->Hand.IsLost && Clock::now() - this->ChangedAt <= this->Timeout;
  }

  void WriteDevice(const std::array<double, 3>& force) noexcept override
  {
    this->Exchange.WriteForce(force);
    this->Exchange.SetLive(!this->IsHalted());
    if (this->IsHalted()) // by now
    {
      this->Exchange.SetLive(false);
    }
  }
  void HaltDevice() noexcept override { this->Exchange.SetLive(false); }

private:
  using Clock = std::chrono::steady_clock; // what waits for a hand is real time, in Step() too

  const vtkSmartPointer<vtkDoubleArray> Values; // held for Exchange
  haptics::SharedExchange Exchange;
  const std::chrono::duration<double> Timeout;
  haptics::SharedHand Hand;
  double Sequence = -1.0;
  Clock::time_point ChangedAt = Clock::now();
};

vtkStandardNewMacro(vtkSharedHapticDevice);

vtkSharedHapticDevice::vtkSharedHapticDevice()
{
  this->MaximumForce = 3.3;
  this->MaximumStiffness = 500.0;
  this->Latency = 0.001;
  this->SetWorkspaceBounds(-0.1, 0.1, -0.1, 0.1, -0.1, 0.1);
  this->SetSharedArray(nullptr);
}

vtkSharedHapticDevice::~vtkSharedHapticDevice()
{
  if (this->Shared)
  {
    this->Shared->Release();
  }
}

void vtkSharedHapticDevice::SetSharedArray(vtkDoubleArray* values)
{
  if (this->GetState() == Ready || this->GetState() == Opening)
  {
    vtkErrorMacro("The device is open; its shared array stays. Call Close() first.");
    return;
  }
  if (values && values->GetNumberOfValues() < static_cast<vtkIdType>(haptics::SharedSize))
  {
    vtkErrorMacro("The shared array has " << values->GetNumberOfValues() << " values, but "
                                          << static_cast<int>(haptics::SharedSize)
                                          << " are needed; the last one stays.");
    return;
  }
  this->Values = values;
  if (!values)
  {
    this->Values = vtkSmartPointer<vtkDoubleArray>::New();
    this->Values->SetNumberOfValues(static_cast<vtkIdType>(haptics::SharedSize));
    this->Values->FillValue(0.0);
  }
  this->Modified();
}

vtkDoubleArray* vtkSharedHapticDevice::GetSharedArray()
{
  return this->Values;
}

bool vtkSharedHapticDevice::HasNewPosition() const
{
  haptics::SharedHand hand;
  double sequence = 0.0;
  return haptics::SharedExchange(this->Values->GetPointer(0)).ReadHand(hand, sequence) &&
    sequence != this->OpenedAt && !hand.IsLost;
}

bool vtkSharedHapticDevice::Open()
{
  if (!this->IsOpen() && this->GetState() != Opening)
  {
    haptics::SharedExchange exchange(this->Values->GetPointer(0));
    exchange.SetLive(false);
    haptics::SharedHand hand;
    exchange.ReadHand(hand, this->OpenedAt);
    this->SetState(Opening); // who drives the device may begin now
    const auto end = std::chrono::steady_clock::now() + Patience;
    while (this->GetState() == Opening && !this->HasNewPosition() &&
      std::chrono::steady_clock::now() < end)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }
  this->Update();
  return this->IsOpen();
}

void vtkSharedHapticDevice::Close()
{
  if (this->Shared)
  {
    this->Shared->Release();
    this->Shared.reset();
  }
  this->BecomeClosed();
}

void vtkSharedHapticDevice::Update()
{
  if (this->GetState() == Opening && this->HasNewPosition())
  {
    this->Shared = std::make_shared<SharedChannel>(this->Values, this->Timeout);
    this->BecomeReady(this->Shared);
  }
  if (this->IsOpen() && this->Shared->IsLost())
  {
    this->Shared->Release();
    this->Shared.reset();
    std::ostringstream message;
    message << "No new position of the hand came for " << this->Timeout
            << " s, or the program that drives the device said that it is lost. See to that "
               "program, or raise Timeout, and open the device again.";
    this->Fail(Faulted, message.str());
  }
}

const char* vtkSharedHapticDevice::GetStatusMessage() const
{
  return this->GetState() == Opening
    ? "It waits for a first position of the hand, by Exchange() or in the shared array."
    : this->Superclass::GetStatusMessage();
}

void vtkSharedHapticDevice::Exchange(
  const double position[3], unsigned int buttons, double force[3])
{
  haptics::SharedExchange exchange(this->Values->GetPointer(0));
  exchange.WriteHand({ { position[0], position[1], position[2] }, buttons, false });
  double sequence = 0.0;
  const std::array<double, 3> asked = exchange.ReadForce(sequence);
  std::copy(asked.begin(), asked.end(), force);
}

void vtkSharedHapticDevice::Lose()
{
  haptics::SharedExchange exchange(this->Values->GetPointer(0));
  haptics::SharedHand hand;
  double sequence = 0.0;
  exchange.ReadHand(hand, sequence);
  hand.IsLost = true;
  exchange.WriteHand(hand);
}

void vtkSharedHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SharedArray: " << this->Values.Get() << "\n";
  os << indent << "Timeout: " << this->Timeout << " s\n";
}
