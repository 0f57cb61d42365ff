#ifndef Haptics_HaplyMessage_h
#define Haptics_HaplyMessage_h

#include "haptics/Devices/Driver/ForceLink.h"
#include "vtkHapticsDevicesModule.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace haptics
{
/// What the service reports of one Inverse3. What a message leaves out stays as it was.
struct HaplyDevice
{
  std::string Id;
  std::string Permutation = "XYZ"; ///< of the axes that positions are reported in
  bool IsPowered = true;
  bool IsCalibrated = true;
  bool IsStarted = true;
  bool IsInUse = false; ///< by some session, our own included
  bool HasPosition = false;
  std::array<double, 3> Position{}; ///< in the service's axes [m]
};

/// What the service reports of all devices.
struct HaplyState
{
  std::vector<HaplyDevice> Devices;
  bool HasGrip = false;
  std::uint32_t Buttons = 0;                                   ///< of the first grip
  std::array<double, 4> Orientation{ { 1.0, 0.0, 0.0, 0.0 } }; ///< of it: w, x, y, z

  /// Null where there is none of this id; the first of all where the id is empty.
  const HaplyDevice* Find(const std::string& id) const;
};

/// The service's version, of its answer to GET /version.
struct HaplyVersion
{
  int Major = 0;
  int Minor = 0;
  /// What a force is called in a command: `vector` from 3.5 on, `values` before.
  bool HasVectors() const { return this->Major > 3 || (this->Major == 3 && this->Minor >= 5); }
};

/// @brief The service's messages, JSON, to and from numbers. No state, any thread.
///
/// Facts of https://docs.haply.co/inverseSDK (3.1 to 3.5). The device frame has x to the right, y
/// up and z towards the user; the service's own axes, permutation `XYZ`, have z up and y away from
/// the user.
class VTKHAPTICSDEVICES_EXPORT HaplyMessage
{
public:
  /// False where the text is no state message. `state` holds what was reported before; devices that
  /// a message does not list are gone from it.
  static bool Read(std::string_view text, HaplyState& state);
  static bool ReadVersion(std::string_view text, HaplyVersion& version);
  /// Puts a force in the device frame [N] into `text`, whose memory is used again. With a profile
  /// name the session gets it.
  static void WriteForce(const std::string& id, const std::array<double, 3>& force,
    const std::string& permutation, bool hasVectors, const char* profile, std::string& text);

  ///@{
  /// Between the axes of a permutation such as "XYZ" or "-YXZ" and the device frame. What stands
  /// at place i says which of the service's own axes the i-th number is along. IsPermutation() is
  /// false for what is none, or mirrors.
  static bool IsPermutation(const std::string& permutation);
  static std::array<double, 3> ToDevice(
    const std::array<double, 3>& service, const std::string& permutation);
  static std::array<double, 3> ToService(
    const std::array<double, 3>& device, const std::string& permutation);
  ///@}
};
}

#endif
