#ifndef TickRecord_h
#define TickRecord_h

#include "GodObject.h"
#include "Vec3.h"

#include <array>
#include <cstdint>

namespace haptics
{
/// What one servo tick saw and did. Plain memory, copied between threads.
struct TickRecord
{
  std::uint64_t Tick = 0; ///< counted from 0 at the servo's start
  double Time = 0.0;      ///< [s] since the servo's start

  Vec3 DevicePosition{};     ///< HIP, device frame [m]
  std::uint32_t Buttons = 0; ///< bit i is set while button i is held
  Vec3 Force{};              ///< asked for, device frame [N]

  Vec3 Hip{};       ///< world frame
  Vec3 GodObject{}; ///< world frame
  /// The god-object in the frame of the first constraint's surface, relative to that snapshot's
  /// Origin(); surfaces move, this stays with them.
  Vec3 Local{};
  double DeformFraction = 1.0; ///< of that snapshot, see TriangleSurface::PointAt()
  Vec3 WorldForce{};        ///< the force along the world's axes [N]
  double Penetration = 0.0; ///< |god-object - HIP| [world unit]

  UpdateStatus Status = UpdateStatus::Free;
  int NumberOfConstraints = 0;           ///< 0 to 3
  std::array<Constraint, 3> Constraints; ///< the first NumberOfConstraints are valid
  /// Which published god-object the constraints' surface indices belong to; 0: none yet.
  std::uint64_t Generation = 0;

  double Stiffness = 0.0;   ///< in effect, device frame [N/m]
  double Energy = 0.0;      ///< the passivity observer's balance [J]; 0 while it is off
  double Tank = 0.0;        ///< what surfaces with properties may still spend [J]
  std::uint32_t Limits = 0; ///< what safety did to the force: bits of SafetyLimit
};
}

#endif
