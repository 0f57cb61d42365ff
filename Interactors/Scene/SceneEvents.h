#ifndef Haptics_SceneEvents_h
#define Haptics_SceneEvents_h

#include "haptics/Scene/SurfaceSet.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticProbe.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <optional>
#include <vector>

class vtkHapticScene;

namespace haptics
{
/// @brief Turns ticks into the events of a vtkHapticScene, each at the tick where it happened.
///
/// Events are collected while the scene takes in what is new, and invoked at its end, so that an
/// observer sees the scene in one piece and may do with it what it likes. A probe is made only for
/// events that somebody listens to. GUI thread.
class SceneEvents
{
public:
  /// Looks at the next tick.
  void Take(const TickRecord& tick, const SurfaceSet& surfaces, vtkHapticScene* scene);
  /// After the last tick of an update: whether the hand has slid.
  void EndOfTicks(const SurfaceSet& surfaces, vtkHapticScene* scene);
  /// The servo has stopped: the contact is over and no button is held.
  void Stop(vtkHapticScene* scene);
  static constexpr int NoData = -1;
  /// An event whose call data is a number, or null with NoData.
  void Add(unsigned long event, int value) { this->Pending.push_back({ event, nullptr, value }); }
  /// Invokes what was collected, oldest first.
  void Dispatch(vtkHapticScene* scene);
  /// The ticks at which a button was pressed since the last call, touching or not.
  std::vector<TickRecord> TakePresses(int button);

private:
  struct Event
  {
    unsigned long Id;
    vtkSmartPointer<vtkHapticProbe> Probe;
    int Value;
  };
  struct Press
  {
    int Button;
    TickRecord Tick;
  };
  void AddProbe(
    unsigned long event, const TickRecord* tick, const SurfaceSet* surfaces, vtkHapticScene* scene);
  void TakeButtons(std::uint32_t buttons, const TickRecord* tick);

  std::vector<Event> Pending;
  std::vector<Press> Presses;
  std::optional<TickRecord> LastTouch;      ///< the latest tick, where it touched
  Vec3 SlidFrom{};                          ///< TickRecord::Local when contact began or last slid
  UpdateStatus Status = UpdateStatus::Free; ///< of the latest tick
  std::uint32_t Buttons = 0;
};
}

#endif
