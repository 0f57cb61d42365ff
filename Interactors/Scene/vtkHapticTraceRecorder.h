/**
 * @class   vtkHapticTraceRecorder
 * @brief   Keeps what every tick of a vtkHapticScene did, and makes a polyline of it: the trace.
 *
 * A scene hands one out by vtkHapticScene::GetTraceRecorder() and gives it the ticks. One that no
 * scene has stays empty. What goes into the servo, to be played again, is a recording: see
 * vtkHapticServo::SetRecordingFileName().
 *
 * Memory: 192 bytes a tick, up to MaximumTicks.
 *
 * GUI thread.
 *
 * @sa vtkHapticScene vtkGodObjectTrace
 */
#ifndef Haptics_vtkHapticTraceRecorder_h
#define Haptics_vtkHapticTraceRecorder_h

#include "vtkHapticsSceneModule.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <memory>

namespace haptics
{
struct TickRecord;
class TraceRecorder;
}

class vtkPolyData;

class VTKHAPTICSSCENE_EXPORT vtkHapticTraceRecorder : public vtkObject
{
public:
  static vtkHapticTraceRecorder* New();
  vtkTypeMacro(vtkHapticTraceRecorder, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Start() forgets the last trace and records from the next tick on, over several runs too, whose
   * times each start at 0. Before either does anything it invokes vtkCommand::StartEvent or
   * vtkCommand::EndEvent, at which the scene gives it the ticks that are over. When MaximumTicks
   * are held recording stops with a warning.
   */
  void Start();
  void Stop();
  ///@}
  ///@{
  /** Whether ticks are recorded. Default off. Setting it starts or stops, where that is news. */
  void SetRecording(bool recording);
  vtkGetMacro(Recording, bool);
  ///@}

  ///@{
  /** Ticks that a trace holds at most. Default 600,000 (ten minutes at 1 kHz, 115 MB); >= 1. */
  vtkSetClampMacro(MaximumTicks, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumTicks, vtkIdType);
  ///@}

  /** Ticks that are held. */
  vtkIdType GetNumberOfTicks();
  /** Ticks since Start() that the trace lacks: they came faster than the scene took them in. */
  vtkGetMacro(NumberOfLostTicks, vtkIdType);

  /**
   * The trace so far: a polyline of the god-object, one point a tick, world frame, with the point
   * arrays Time [s], HapticInterfacePoint [world unit], Force [N, world axes], ActiveConstraints,
   * Surface (id, -1 in free space), OriginalCellId (-1 in free space), Penetration [world unit],
   * Stiffness (in effect [N/m]), Energy (what the hand has put in since the servo's start and not
   * got out [J]), EnergyTank [J]: the same arrays as those of a vtkGodObjectTrace.
   * Made anew at each call; empty where nothing was recorded. Never null.
   */
  vtkPolyData* GetTrace();

#ifndef __VTK_WRAP__
  /**
   * For the scene, C++ only: a tick with the surface and the cell that it touched (-1 for none),
   * and how many ticks of the servo's run were lost so far. Both do nothing to a trace that is not
   * being recorded.
   */
  void Add(const haptics::TickRecord& tick, int surface, vtkIdType cell);
  void CountLost(vtkIdType lostInRun);
#endif

protected:
  vtkHapticTraceRecorder();
  ~vtkHapticTraceRecorder() override;

private:
  vtkHapticTraceRecorder(const vtkHapticTraceRecorder&) = delete;
  void operator=(const vtkHapticTraceRecorder&) = delete;

  std::unique_ptr<haptics::TraceRecorder> Ticks;
  vtkNew<vtkPolyData> Trace;
  bool Recording = false;
  vtkIdType MaximumTicks = 600000;
  vtkIdType NumberOfLostTicks = 0;
  vtkIdType LostInRun = 0; // as it was counted last
};

#endif
