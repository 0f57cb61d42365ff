#ifndef Haptics_TraceRecorder_h
#define Haptics_TraceRecorder_h

#include "haptics/Math/Vec3.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticsFiltersModule.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace haptics
{
/// What a tick's first constraint belongs to, as its user knows it; -1 for none.
struct TracePlace
{
  std::int32_t Surface = -1;
  std::int64_t Cell = -1;                           ///< of the surface as it was given
  std::array<std::int32_t, 3> Points{ -1, -1, -1 }; ///< likewise: the corners
  Vec3 Weights{}; ///< of the corners: TickRecord::Weights in their order
};

/// One tick as a trace has it; everything in the world frame.
struct TraceTick
{
  double Time = 0.0; ///< [s] since the first tick
  Vec3 Hip{};
  Vec3 GodObject{};
  Vec3 Force{};   ///< on the hand [N], the world's axes
  Vec3 Normal{};  ///< unit, of the surface, towards the god-object; 0 in free space
  Vec3 Weights{}; ///< see TracePlace
  double Penetration = 0.0;
  double Stiffness = 0.0; ///< in effect [N/m]
  double Energy = 0.0;    ///< what the hand has put in since the first tick and not got out [J]
  double Tank = 0.0;      ///< of surfaces with properties [J]
  std::int64_t Cell = -1;
  std::array<std::int32_t, 3> Points{ -1, -1, -1 };
  std::int32_t Surface = -1;
  std::int32_t ActiveConstraints = 0;

  TraceTick() = default;
  TraceTick(const TickRecord& record, const TracePlace& place);
};
static_assert(sizeof(TraceTick) <= 192, "vtkHapticTraceRecorder documents 192 bytes a tick");

/// @brief Keeps the ticks of a trace and makes a polyline of them: the one place that names a
/// trace's arrays. GUI thread.
class VTKHAPTICSFILTERS_EXPORT TraceRecorder
{
public:
  void Clear() { this->Ticks.clear(); }
  void Reserve(vtkIdType ticks) { this->Ticks.reserve(static_cast<std::size_t>(ticks)); }
  vtkIdType Size() const { return static_cast<vtkIdType>(this->Ticks.size()); }
  void Add(const TraceTick& tick) { this->Ticks.push_back(tick); }

  /// Replaces the content of `trace` by the ticks so far. `unitLength`: of a world unit [m], 0
  /// where it is not known.
  void Write(vtkPolyData* trace, double unitLength) const;

private:
  std::vector<TraceTick> Ticks;
};
}

#endif
