#ifndef HapticSceneInternals_h
#define HapticSceneInternals_h

#include "SurfaceSet.h"
#include "TickRecord.h"
#include "TraceRecorder.h"
#include "vtkHapticScene.h"

#include <optional>
#include <vector>

/// What a vtkHapticScene is made of, for its two source files.
class vtkHapticScene::Internals
{
public:
  haptics::SurfaceSet Surfaces;
  haptics::TraceRecorder Recorder;
  std::vector<haptics::TickRecord> Drained; // kept for its memory
  std::optional<haptics::TickRecord> Latest;
  haptics::SceneCell LatestCell;
};

#endif
