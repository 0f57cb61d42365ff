#ifndef Haptics_HapticSceneInternals_h
#define Haptics_HapticSceneInternals_h

#include "haptics/Scene/BackgroundWorker.h"
#include "haptics/Scene/ReachCheck.h"
#include "haptics/Scene/SceneEvents.h"
#include "haptics/Scene/SurfaceSet.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticScene.h"

#include <cstdint>
#include <optional>
#include <vector>

/// What a vtkHapticScene is made of, for its source files.
class vtkHapticScene::Internals
{
public:
  haptics::BackgroundWorker Worker; // outlives the surfaces that give it work
  haptics::SurfaceSet Surfaces;
  bool BackgroundBuilding = false;
  bool WasBuilding = false; ///< as observers know it
  double BuildProgress = 1.0;
  std::uint64_t Published = 0; ///< generation of the last god-object
  double LastPull = 0.0;       ///< of changed surfaces, the servo's time [s]
  haptics::SceneEvents Events;
  haptics::ReachCheck Reach;
  int DeviceState = 0;
  vtkMTimeType LandmarksSeen = 0;
  std::vector<haptics::TickRecord> Drained; // kept for its memory
  std::optional<haptics::TickRecord> Latest;
  haptics::SceneCell LatestCell;
};

#endif
