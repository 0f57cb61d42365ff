#ifndef Haptics_HapticProbeFiller_h
#define Haptics_HapticProbeFiller_h

#include "haptics/Math/RigidPose.h"
#include "haptics/Surface/TriangleSurface.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticProbe.h"

class vtkPolyData;

/// Fills a probe from a tick. GUI thread.
class vtkHapticProbeFiller
{
public:
  /// What every tick has, with or without a contact.
  static void SetTick(vtkHapticProbe* probe, const haptics::TickRecord& tick);
  /// What a tick's first constraint belongs to.
  struct SurfaceCell
  {
    int Surface;             ///< id
    std::string SurfaceName; ///< "" for none
    vtkIdType Cell;          ///< as it was given
    std::shared_ptr<const haptics::TriangleSurface> Snapshot;
    haptics::RigidPose Pose; ///< about as it was in the tick
  };
  /// Where the tick's first constraint lies on the surface that it names. `prepared`, which may be
  /// null, has the surface's triangles in the same order, with the arrays.
  static void SetContact(vtkHapticProbe* probe, const haptics::TickRecord& tick,
    const SurfaceCell& touched, vtkPolyData* prepared);

  ///@{
  /// A contact as polydata with one point, and a new probe from that, which belongs to no surface
  /// of a scene yet; false where the polydata are none of Save().
  static void Save(vtkHapticProbe* probe, vtkPolyData* record);
  static bool Load(vtkPolyData* record, vtkHapticProbe* probe);
  static void SetSurface(vtkHapticProbe* probe, int id) { probe->Surface = id; }
  static std::string SurfaceName(vtkHapticProbe* probe) { return probe->SurfaceName; }
  ///@}
};

#endif
