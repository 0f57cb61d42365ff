/**
 * @class   vtkHapticTraceRecorder
 * @brief   Keeps what every tick of a vtkHapticScene did, and makes a polyline of it: the trace.
 *
 * A scene hands one out by vtkHapticScene::GetTraceRecorder() and gives it the ticks. One that no
 * scene has stays empty. What goes into the servo, to be played again, is a recording: see
 * vtkHapticServo::SetRecordingFileName().
 *
 * Memory: 192 bytes a tick, up to MaximumTicks, and 8 for each component of AddSurfaceArray().
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
#include <string>
#include <vector>

namespace haptics
{
struct TickRecord;
struct TouchedPlace;
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

  ///@{
  /**
   * Point and cell arrays of the surfaces that a trace has too, by name, as they are where a
   * surface is touched. Default none; each takes 8 bytes a component and tick. Names count from the
   * next Start(). The trace has them as double, NaN in free space and on surfaces without such an
   * array. One whose name is that of an array below comes as "Surface" and its name. A name that no
   * surface which was touched had is a warning of Stop().
   */
  void AddSurfaceArray(const char* name);
  void ClearSurfaceArrays();
  ///@}

  ///@{
  /**
   * Length of a world unit [m], for the information of the trace's arrays: the scene sets its own,
   * see vtkHapticWorkspace::SetUnitLength(). Default 0: not known.
   */
  void SetUnitLength(double metres);
  vtkGetMacro(UnitLength, double);
  ///@}

  /**
   * The trace so far: a polyline of the god-object, one point a tick, world frame, with the point
   * arrays Time [s], HapticInterfacePoint [world unit], Force [N, world axes], Normal (unit, of the
   * surface, towards the god-object), ActiveConstraints, Surface (id, -1 in free space),
   * OriginalCellId (-1 in free space), PointIds (3: the corners of the triangle),
   * BarycentricWeights (3: of these), Penetration [world unit], Stiffness (in effect [N/m]), Energy
   * (what the hand has put in since the servo's start and not got out [J]), EnergyTank [J]: the
   * same arrays with the same units in their information as those of a vtkGodObjectTrace, and those
   * of the surfaces that were asked for. The field data say what the surfaces that were touched are
   * called: SurfaceId and SurfaceName. Made anew at each call; empty where nothing was recorded.
   * Never null.
   */
  vtkPolyData* GetTrace();
  /** Writes GetTrace() as vtkGodObjectTrace::WriteCSV() does. False and an error where it cannot.
   */
  bool WriteCSV(const char* file);

#ifndef __VTK_WRAP__
  /**
   * For the scene, C++ only: a tick with what it touched, and how many ticks of the servo's run
   * were lost so far. Both do nothing to a trace that is not being recorded.
   */
  void Add(const haptics::TickRecord& tick, const haptics::TouchedPlace& place);
  void OnLostTicks(vtkIdType lostInRun);
#endif

protected:
  vtkHapticTraceRecorder();
  ~vtkHapticTraceRecorder() override;

private:
  vtkHapticTraceRecorder(const vtkHapticTraceRecorder&) = delete;
  void operator=(const vtkHapticTraceRecorder&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
  vtkNew<vtkPolyData> Trace;
  std::vector<std::string> SurfaceArrays;
  double UnitLength = 0.0;
  bool Recording = false;
  vtkIdType MaximumTicks = 600000;
  vtkIdType NumberOfLostTicks = 0;
  vtkIdType LostInRun = 0; // as it was counted last
};

#endif
