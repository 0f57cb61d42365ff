#ifndef TraceRecorder_h
#define TraceRecorder_h

#include "Vec3.h"
#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace haptics
{
/// One servo tick as a trace tells it; everything in the world frame.
struct TraceTick
{
  double Time = 0.0; ///< [s] since the servo started
  Vec3 Hip{};
  Vec3 GodObject{};
  Vec3 Force{}; ///< on the hand [N], the world's axes
  double Penetration = 0.0;
  double Stiffness = 0.0; ///< in effect [N/m]
  double Energy = 0.0;    ///< the passivity observer's balance [J]
  double Tank = 0.0;      ///< of surfaces with properties [J]
  std::int64_t Cell = -1; ///< of the surface as it was given
  std::int32_t Surface = -1;
  std::int32_t ActiveConstraints = 0;
};
static_assert(sizeof(TraceTick) <= 144, "vtkHapticScene documents 144 bytes a tick");

/// @brief Keeps ticks up to a limit and makes a polyline of them. GUI thread.
class TraceRecorder
{
public:
  void Clear() { this->Ticks.clear(); }
  vtkIdType Size() const { return static_cast<vtkIdType>(this->Ticks.size()); }
  void Add(const TraceTick& tick) { this->Ticks.push_back(tick); }

  /// Replaces the content of `trace` by the ticks so far.
  void Write(vtkPolyData* trace) const;

private:
  std::vector<TraceTick> Ticks;
};
}

#endif
