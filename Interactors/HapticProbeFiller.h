#ifndef HapticProbeFiller_h
#define HapticProbeFiller_h

#include "TickRecord.h"
#include "TriangleSurface.h"
#include "vtkHapticProbe.h"

class vtkPolyData;

/// Fills a probe from a tick. GUI thread.
class vtkHapticProbeFiller
{
public:
  /// What every tick tells, with or without a contact.
  static void SetTick(vtkHapticProbe* probe, const haptics::TickRecord& tick);
  /// Where the tick's first constraint lies on the surface that it names. `prepared`, which may be
  /// null, has the surface's triangles in the same order, with the arrays.
  static void SetContact(vtkHapticProbe* probe, const haptics::TickRecord& tick, int surfaceId,
    vtkIdType cell, std::shared_ptr<const haptics::TriangleSurface> surface, vtkPolyData* prepared);
};

#endif
