#ifndef Haptics_DriverBench_h
#define Haptics_DriverBench_h

#include "WaitFor.h"
#include "vtkDriverHapticDevice.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

/// Opens a device, and waits until it is open; false where it is not.
inline bool WaitUntilOpen(vtkDriverHapticDevice* device)
{
  device->Open();
  return WaitFor(
           [device]
           {
             device->Update();
             return device->IsOpen() || device->GetState() == vtkHapticDevice::Faulted;
           }) &&
    device->IsOpen();
}

inline bool WaitForFault(vtkDriverHapticDevice* device)
{
  return WaitFor(
    [device]
    {
      device->Update();
      return device->GetState() == vtkHapticDevice::Faulted;
    });
}

inline bool Says(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

using Vec = std::array<double, 3>;

inline double Magnitude(const Vec& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

/// @brief A kind of device and what stands for its hardware, for the tests that all kinds have to
/// pass. The hardware's end may be used from another process than the device: it is memory that
/// both share, or a server in the one that made the bench.
class DriverBench
{
public:
  virtual ~DriverBench() = default;

  /// Begins to answer. In the process that made the bench, after it has forked.
  virtual void Begin() {}
  /// A device of this kind that finds the bench's hardware when it opens.
  virtual vtkSmartPointer<vtkDriverHapticDevice> MakeDevice() = 0;
  /// Device frame [m].
  virtual void MoveTo(const Vec& position) = 0;
  /// What the hardware got last, device frame [N].
  virtual Vec GetForce() const = 0;
  /// Every exchange takes so long [ms].
  virtual void SetDelay(int milliseconds) = 0;
};

std::unique_ptr<DriverBench> MakeHaplyBench();
std::unique_ptr<DriverBench> MakeOpenHapticsBench();
std::unique_ptr<DriverBench> MakeForceDimensionBench();

#endif
