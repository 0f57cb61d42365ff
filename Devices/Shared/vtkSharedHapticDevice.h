/**
 * @class   vtkSharedHapticDevice
 * @brief   a device of one's own, in any language: positions in and forces out through shared
 * memory
 *
 * The program that drives the device calls Exchange() about a thousand times a second from a thread
 * of its own; or it writes to GetSharedArray() itself, from another process too, by the layout of
 * haptics::SharedValue. In Python derive from vtkhaptics.HapticDevice, which does either. A device
 * in C++ is better a class of its own: see haptics::MonitoredChannel, and `share/vtkhaptics/device`
 * of an installation, a project to begin with.
 *
 * Open() invokes StateChangedEvent in the state Opening, in which an observer may start what drives
 * the device, and waits 50 ms for a first position; where none has come the device stays
 * Opening and becomes Ready in the Update() after it has.
 *
 * Safety, besides what vtkHapticServo does for every device: where no new position has come for
 * Timeout the device is lost, and the servo ends with zero force in the same tick; so where the
 * program says that it is lost, and where a position is not finite. The force in the shared memory
 * is zero after a run, and counts only while ForceLive is 1, which it is not from Close() on nor
 * while the watchdog has halted the device. A program that drives motors has to withdraw a force by
 * itself whose ForceSequence does not change any more, which is what it sees of a process that
 * crashed.
 *
 * Exchange() is for any one thread; all else for the GUI thread.
 *
 * @sa vtkHapticDevice
 */
#ifndef Haptics_vtkSharedHapticDevice_h
#define Haptics_vtkSharedHapticDevice_h

#include "vtkHapticDevice.h"
#include "vtkSmartPointer.h"

#include <memory>

class vtkDoubleArray;

class VTKHAPTICSDEVICES_EXPORT vtkSharedHapticDevice : public vtkHapticDevice
{
public:
  static vtkSharedHapticDevice* New();
  vtkTypeMacro(vtkSharedHapticDevice, vtkHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  bool Open() override;
  void Close() override;
  void Update() override;
  const char* GetStatusMessage() const override;

  ///@{
  /**
   * The shared memory: 16 float64 (haptics::SharedValue). Default one of its own; null sets that
   * anew. Fewer values are an error and change nothing, as is setting it while the device is open.
   */
  void SetSharedArray(vtkDoubleArray* values);
  vtkDoubleArray* GetSharedArray();
  ///@}

  /**
   * Reports the position of the hand, device frame [m], and the buttons that it holds; returns the
   * force to give it [N]: zero while no servo runs. Wait-free. Any one thread.
   */
  void Exchange(const double position[3], unsigned int buttons, double force[3]);
  /// Reports that the device is lost: zero force from the servo's next tick on. As Exchange().
  void Lose();

  ///@{
  /// The longest time without a new position [s]. Default 0.02, clamped to 0.001 to 60; read by
  /// Open().
  vtkSetClampMacro(Timeout, double, 0.001, 60.0);
  vtkGetMacro(Timeout, double);
  ///@}

  ///@{
  /**
   * What the device can do, to be set before Open(). Defaults: 3.3 N, 500 N/m, damping 0 (not
   * known), latency 0.001 s, a box of 200 mm around the origin, no buttons.
   */
  vtkSetClampMacro(MaximumForce, double, 0.0, VTK_DOUBLE_MAX);
  vtkSetClampMacro(MaximumStiffness, double, 0.0, VTK_DOUBLE_MAX);
  vtkSetClampMacro(Damping, double, 0.0, VTK_DOUBLE_MAX);
  vtkSetClampMacro(Latency, double, 0.0, 1.0);
  vtkSetVector6Macro(WorkspaceBounds, double);
  vtkSetClampMacro(NumberOfButtons, int, 0, 32);
  ///@}

protected:
  vtkSharedHapticDevice();
  ~vtkSharedHapticDevice() override;

private:
  vtkSharedHapticDevice(const vtkSharedHapticDevice&) = delete;
  void operator=(const vtkSharedHapticDevice&) = delete;

  class SharedChannel;

  bool HasNewPosition() const;

  vtkSmartPointer<vtkDoubleArray> Values;
  std::shared_ptr<SharedChannel> Shared; // null while not Ready
  double OpenedAt = 0.0;                 // HandSequence then
  double Timeout = 0.02;
};

#endif
