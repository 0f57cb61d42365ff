#ifndef Haptics_ForceDimensionDriver_h
#define Haptics_ForceDimensionDriver_h

#include "haptics/Devices/Driver/DeviceDriver.h"
#include "haptics/Devices/ForceDimension/DhdLibrary.h"

#include <array>
#include <memory>
#include <string>

namespace haptics
{
/// @brief Exchanges with one omega, delta, sigma, lambda or Falcon through Force Dimension's SDK.
///
/// The vendor's axes, x towards the user, y right, z up, are turned to the device frame. Gravity
/// compensation, watchdog and velocity threshold stay as the vendor has set them.
class ForceDimensionDriver : public DeviceDriver
{
public:
  /// `index`: of the devices that the SDK finds. `movesArm`: initialises by itself.
  ForceDimensionDriver(int index, std::string libraryFile, bool movesArm);

  void Open(DriverContext& context) override;
  void Serve(
    ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready) override;
  void Close() noexcept override;

private:
  void Initialize(DriverContext& context);
  std::array<double, 4> ReadOrientation() const;
  void Check(int result, const char* doing) const;
  void Check(bool isFine, const char* doing) const;

  const int Index;
  const std::string LibraryFile;
  const bool MovesArm;
  std::unique_ptr<DhdLibrary> Dhd;
  int Id = -1;
  bool HasWrist = false;
};
}

#endif
