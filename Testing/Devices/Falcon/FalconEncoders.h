#ifndef Haptics_FalconEncoders_h
#define Haptics_FalconEncoders_h

#include "haptics/Devices/Falcon/FalconKinematics.h"

#include <array>
#include <cstddef>
#include <cstdint>

/// What the encoders of a Falcon count where its grip is at `place`, device frame [m].
inline std::array<std::int16_t, 3> EncodersAt(const haptics::FalconKinematics::Vector& place)
{
  haptics::FalconKinematics::Vector angles{};
  haptics::FalconKinematics::Inverse(place, angles);
  std::array<std::int16_t, 3> counts{};
  for (std::size_t leg = 0; leg < counts.size(); ++leg)
  {
    counts[leg] = haptics::FalconKinematics::CountOfAngle(angles[leg]);
  }
  return counts;
}

#endif
