/**
 * @class   vtkHapticReadings
 * @brief   What a vtkHapticServo has measured, read at one moment.
 *
 * vtkHapticServo::GetReadings() reads everything at once: the latest tick as of the servo's last
 * Update(), Step() or Stop(), and the statistics up to now. The values stay as they are until
 * GetReadings() is called again. Before the first tick all are zero.
 *
 * Every method is for the GUI thread.
 *
 * @sa vtkHapticServo haptics::TickRecord haptics::ServoReport
 */
#ifndef Haptics_vtkHapticReadings_h
#define Haptics_vtkHapticReadings_h

#include "vtkHapticsSceneModule.h"
#include "vtkObject.h"

#include <memory>
#include <string>

namespace haptics
{
struct ServoReport;
struct TickRecord;
}

class VTKHAPTICSSCENE_EXPORT vtkHapticReadings : public vtkObject
{
public:
  static vtkHapticReadings* New();
  vtkTypeMacro(vtkHapticReadings, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The latest tick.
  void GetHapticInterfacePoint(double position[3]); ///< world frame [world unit]
  void GetGodObject(double position[3]);            ///< world frame [world unit]
  void GetForce(double force[3]);                   ///< device frame [N]
  void GetWorldForce(double force[3]);              ///< along the world's axes [N]
  void GetDevicePosition(double position[3]);       ///< HIP, device frame [m]
  unsigned int GetButtons();                        ///< bit i is set while button i is held
  double GetPenetration();                          ///< of the HIP [world unit]
  int GetNumberOfConstraints();                     ///< 0 in free space, to 3
  double GetTime();                                 ///< [s] since the start
  double GetStiffness();                            ///< in effect, device frame [N/m]
  /// The passivity observer's balance [J]: what the hand and the device's damping have put in and
  /// not got out; 0 without passivity control and without properties.
  double GetObservedEnergy();
  /// What surfaces with properties may still spend [J]; see haptics::SurfaceForce.
  double GetEnergyTank();
  ///@}

  ///@{
  /**
   * Why the latest force is not the plain spring's. Force limits: bits of haptics::SafetyLimit, and
   * their names; 0 and empty where none acted. Squeezed: surfaces that move have closed in and
   * leave the god-object no place, so there is no force until they do. Overloaded: one place has
   * more triangles than a tick may look at; the god-object is held there. Both are false after the
   * servo has stopped.
   */
  unsigned int GetForceLimits();
  std::string DescribeForceLimits();
  bool GetSqueezed();
  bool GetOverloaded();
  ///@}

  ///@{
  /**
   * How regular the ticks of this run are, or of the last one were. In virtual time the periods are
   * exact and only the tick times are measured.
   *
   * A period T is the time between two ticks [s]. PeriodRatio is E[T^2]/E[T], the T that a stable
   * stiffness depends on; MaximumPeriod is T_max; missed ticks are deadlines that passed while a
   * tick ran or the thread slept. A tick time is the work of one tick [s]. A quantile is the
   * duration [s] that the given share (0 to 1) of the ticks did not exceed, at most 3.2 % too long.
   */
  vtkTypeInt64 GetNumberOfTicks();
  vtkTypeInt64 GetNumberOfMissedTicks();
  vtkTypeInt64 GetNumberOfHalts(); ///< how often the watchdog took the force from the device
  double GetMeasuredRate();        ///< ticks a second [Hz]; 0 before the second tick
  double GetMeanPeriod();
  double GetPeriodRatio();
  double GetMaximumPeriod();
  double GetPeriodQuantile(double fraction);
  double GetTickTimeQuantile(double fraction);
  double GetMaximumTickTime();
  ///@}

  ///@{
  /**
   * The histograms behind the quantiles: the number of bins, the edge [s] at which a bin starts
   * (0 to the number of bins), and what it has counted. 0 for a bin that does not exist.
   */
  static int GetNumberOfHistogramBins();
  static double GetHistogramEdge(int bin);
  vtkTypeInt64 GetPeriodCount(int bin);
  vtkTypeInt64 GetTickTimeCount(int bin);
  ///@}

  /// Records of this run that were not drained in time. The newest 16,384 ticks are kept at most;
  /// what comes when they are full is lost.
  vtkTypeInt64 GetNumberOfLostRecords();

#ifndef __VTK_WRAP__
  /// For the servo, C++ only.
  void Read(const haptics::TickRecord& tick, const haptics::ServoReport& report, bool isLive,
    vtkTypeInt64 halts, vtkTypeInt64 lostRecords);
#endif

protected:
  vtkHapticReadings();
  ~vtkHapticReadings() override;

private:
  vtkHapticReadings(const vtkHapticReadings&) = delete;
  void operator=(const vtkHapticReadings&) = delete;

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
