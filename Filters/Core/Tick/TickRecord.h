#ifndef Haptics_TickRecord_h
#define Haptics_TickRecord_h

#include "haptics/Contact/GodObject.h"
#include "haptics/Math/Vec3.h"

#include <cstdint>

namespace haptics
{
/// @brief What one tick saw and did: its contact in the world frame, and the force made of it.
///
/// Plain memory, copied between threads. Material.Profile may be gone: it is not to be followed.
struct TickRecord : Contact
{
  std::uint64_t Tick = 0; ///< counted from 0 at the servo's start
  double Time = 0.0;      ///< [s] since the servo's start

  Vec3 DevicePosition{};     ///< HIP, device frame [m]
  std::uint32_t Buttons = 0; ///< bit i is set while button i is held
  Vec3 Force{};              ///< asked for, device frame [N]
  Vec3 WorldForce{};         ///< the same along the world's axes [N]

  /// The god-object, or of a ball the place that it touches, in the frame of the first constraint's
  /// surface, relative to that snapshot's Origin(); surfaces move, this stays with them.
  Vec3 Local{};
  /// How much each corner of the first constraint's triangle counts there: >= 0, sum 1; 0 in free
  /// space.
  Vec3 Weights{};
  double DeformFraction = 1.0; ///< of that snapshot, see TriangleSurface::PointAt()
  /// Which published god-object the constraints' surface indices belong to; 0: none yet.
  std::uint64_t Generation = 0;

  double Stiffness = 0.0; ///< in effect, device frame [N/m]
  /// What the hand has put in since the first tick and not got out [J], with each force held until
  /// the next tick.
  double Energy = 0.0;
  double Tank = 0.0;             ///< what surfaces with properties may still spend [J]
  double PassivityBalance = 0.0; ///< see PassivityController [J]; 0 while it is off
  std::uint32_t Limits = 0;      ///< what safety did to the force: bits of SafetyLimit
};
}

#endif
