/**
 * @class   vtkHapticSafety
 * @brief   what stands between a computed force and a hand: limits that are on by default
 *
 * vtkHapticServo has one (GetSafety()); a change acts at the next tick, WatchdogTime and
 * MissedTickShare at the next Start().
 *
 * No limit can be loosened by accident. A Set method goes from the default to stricter; a looser
 * value is an error that changes nothing and names the Loosen method, whose name and range say what
 * one does. A value outside the range is an error that changes nothing.
 *
 * Not here, since nothing loosens it: the device's own MaximumForce and MaximumStiffness, and zero
 * force at once when the device is lost, a number is not finite, the servo is stopped or destroyed,
 * or the process ends.
 *
 * Every method is for the GUI thread.
 *
 * @sa vtkHapticServo haptics::ForceGuard haptics::StiffnessLimit haptics::PassivityController
 */
#ifndef Haptics_vtkHapticSafety_h
#define Haptics_vtkHapticSafety_h

#include "vtkHapticsSceneModule.h"
#include "vtkObject.h"

class VTKHAPTICSSCENE_EXPORT vtkHapticSafety : public vtkObject
{
public:
  static vtkHapticSafety* New();
  vtkTypeMacro(vtkHapticSafety, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How fast a force may grow or turn [N/s]; it may shrink at once. Default 1000: 1 N in a
   * millisecond. Set: 1 to 1000. Loosen: 1 to 100,000.
   */
  void SetSlewLimit(double rate);
  void LoosenSlewLimit(double rate);
  vtkGetMacro(SlewLimit, double);
  ///@}

  ///@{
  /**
   * For so long [s] after a start, a pause or a halt by the watchdog a force grows only so fast
   * that it would take as long to the largest one; as fast goes what a change of surfaces under the
   * hand or of the workspace does to it. Default 0.1. Set: 0.1 to 10. Loosen: 0 to 10.
   */
  void SetSoftStartTime(double time);
  void LoosenSoftStartTime(double time);
  vtkGetMacro(SoftStartTime, double);
  ///@}

  ///@{
  /**
   * How much is used of the stiffness that stays passive at the measured periods,
   * K = b / (E[T^2] / (2 E[T]) + latency), with the device's Damping b and Latency; nothing is
   * limited by it where the device's Damping is 0, that is, not known. Default 0.9. Set: 0.05 to
   * 0.9. Loosen: 0.05 to 100. From 1 on a surface may shake.
   */
  void SetStiffnessMargin(double share);
  void LoosenStiffnessMargin(double share);
  vtkGetMacro(StiffnessMargin, double);
  ///@}

  ///@{
  /**
   * After a tick has been due for so long [s] a watchdog's thread takes the force from the device.
   * Default 0.025. Set: 0.005 to 0.025. Loosen: 0.005 to 1.
   */
  void SetWatchdogTime(double time);
  void LoosenWatchdogTime(double time);
  vtkGetMacro(WatchdogTime, double);
  ///@}

  ///@{
  /**
   * The share of the deadlines that may be missed: more for about a second, or as many in one
   * burst, ends the run. Default 0.5. Set: 0.01 to 0.5. Loosen: 0.01 to 60; from 1 on only a burst
   * of so many seconds does.
   */
  void SetMissedTickShare(double share);
  void LoosenMissedTickShare(double share);
  vtkGetMacro(MissedTickShare, double);
  ///@}

  ///@{
  /**
   * Damping of a contact along its normal [N s/m]; it takes force away and adds some, but never
   * pulls. It takes from the damping that the stiffness limit reckons with. Default 0; 0 to 20.
   */
  void SetContactDamping(double damping);
  vtkGetMacro(ContactDamping, double);
  ///@}
  ///@{
  /// Observe the energy between servo and hand, and damp while the servo has made some. Default
  /// off: a god-object on static surfaces under the stiffness limit makes none.
  vtkSetMacro(PassivityControl, bool);
  vtkGetMacro(PassivityControl, bool);
  vtkBooleanMacro(PassivityControl, bool);
  ///@}

  /// Back to the defaults, all of them.
  void Reset();
  /// True where a Loosen method has made a limit looser than its default.
  bool IsLoosened();

protected:
  vtkHapticSafety();
  ~vtkHapticSafety() override;

private:
  vtkHapticSafety(const vtkHapticSafety&) = delete;
  void operator=(const vtkHapticSafety&) = delete;

  struct Limit;
  void Change(const Limit& limit, double value, bool mayLoosen);

  double SlewLimit;
  double SoftStartTime;
  double StiffnessMargin;
  double WatchdogTime;
  double MissedTickShare;
  double ContactDamping;
  bool PassivityControl;
};

#endif
