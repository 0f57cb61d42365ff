#ifndef Haptics_HapticSceneInternals_h
#define Haptics_HapticSceneInternals_h

#include "haptics/Scene/GrippingHand.h"
#include "haptics/Scene/ReachCheck.h"
#include "haptics/Scene/SceneEvents.h"
#include "haptics/Scene/SurfaceSet.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What a vtkHapticScene is made of, for its source files.
class vtkHapticScene::Internals : public haptics::GrippingHand
{
public:
  explicit Internals(vtkHapticScene& scene)
    : Scene(scene)
  {
  }

  ///@{
  /// The hand, for the grip.
  haptics::SurfaceSet& Surfaces() override { return this->Scene.Surfaces->GetSet(); }
  void PullSurfaces() override { this->Scene.PullSurfaces(); }
  const haptics::TickRecord* LatestTick() override
  {
    return this->Latest ? &*this->Latest : nullptr;
  }
  int TouchedSurface() override { return this->Scene.TouchedSurface; }
  bool IsThere() override
  {
    const int state = this->Scene.Servo->GetState();
    return (state == vtkHapticServo::Running || state == vtkHapticServo::Stepping) &&
      this->Latest && !this->Scene.Workspace->GetClutched();
  }
  void HasTaken(int surface) override { this->Events.Add(vtkHapticScene::GripEvent, surface); }
  void HasLetGo(int surface) override { this->Events.Add(vtkHapticScene::LetGoEvent, surface); }
  ///@}

  bool WasBuilding = false; ///< as observers know it
  double BuildProgress = 1.0;
  std::uint64_t PublishedGeneration = 0; ///< generation of the last god-object
  bool IsPulling = false;                ///< what has changed of the surfaces
  double LastPull = 0.0;                 ///< of changed surfaces, the servo's time [s]
  haptics::SceneEvents Events;
  haptics::ReachCheck Reach;
  bool HasBall = false;     ///< the last god-object is one that may be a ball
  std::string TipFault;     ///< why the tip is a point meanwhile; empty where it is none
  bool WasTipFault = false; ///< it was reported
  int DeviceState = 0;
  vtkMTimeType LandmarksSeen = 0;
  std::pair<double, double> LimitsSeen;     ///< largest force [N], radius of the tip [m]
  std::vector<haptics::TickRecord> Drained; // kept for its memory
  std::optional<haptics::TickRecord> Latest;
  haptics::SceneCell LatestCell;
  haptics::UpdateStatus Status{}; ///< of the latest tick; the default when released

private:
  vtkHapticScene& Scene;
};

#endif
