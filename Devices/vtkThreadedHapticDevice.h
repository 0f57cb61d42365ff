/**
 * @class   vtkThreadedHapticDevice
 * @brief   a device that is brought up and exchanged with on a thread of its own
 *
 * Open() begins to bring the device up and returns at once. Call Update() now and then
 * (vtkHapticServo and vtkHapticScene do) until the state is Ready or Faulted; GetStatusMessage()
 * reports what goes on, what is wrong, and what helps. Close() asks the thread to leave the device
 * without force and does not wait for it.
 *
 * GUI thread.
 *
 * @sa vtkHapticDevice vtkDriverHapticDevice vtkFalconHapticDevice
 */
#ifndef Haptics_vtkThreadedHapticDevice_h
#define Haptics_vtkThreadedHapticDevice_h

#include "vtkHapticDevice.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace haptics
{
enum class DevicePhase;
struct LinkCounts;
}

class VTKHAPTICSDEVICES_EXPORT vtkThreadedHapticDevice : public vtkHapticDevice
{
public:
  vtkAbstractTypeMacro(vtkThreadedHapticDevice, vtkHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// From Update(), Open() and Close(); no call data.
  enum ThreadedDeviceEvents
  {
    StatusMessageChangedEvent = vtkCommand::UserEvent + 4110
  };

  /**
   * Begin to bring the device up. True where it is ready already; else false, and Update() reports
   * how it goes. Does nothing while it is under way.
   */
  bool Open() override;
  /// Let go of the device, at any time. Does not wait for it.
  void Close() override;
  void Update() override;
  const char* GetStatusMessage() const override;

  ///@{
  /// Since the device was opened: exchanges; forces that were withdrawn because the servo was
  /// silent for 20 ms.
  vtkTypeInt64 GetNumberOfExchanges() const;
  vtkTypeInt64 GetNumberOfLateCommands() const;
  ///@}
  /// The time [s] within which a share (0 to 1) of the exchanges was over while ready, to 20 us and
  /// up to 20 ms. GetExchangeTime(0.99) well above 2 ms is a sign of a bad hub or a busy machine.
  double GetExchangeTime(double share) const;

protected:
  vtkThreadedHapticDevice();
  ~vtkThreadedHapticDevice() override;

  ///@{
  /// For Open(): begins the thread with the settings of now, after any before has ended. Throws
  /// std::system_error where the system gives no thread.
  virtual void BeginThread() = 0;
  /// Has the thread let go of the device, without waiting; forgets the channel.
  virtual void EndThread() = 0;
  /// Whether a thread was begun that has not been asked to end.
  virtual bool HasThread() const = 0;
  ///@}
  /// For Update(), while there is a thread: what it reports, by Follow().
  virtual void FollowThread() = 0;
  /// Why the device is lost as the servo sees it; empty where it is not, or where the thread
  /// reports the cause itself. While Ready.
  virtual std::string GetProblem() const = 0;
  /// The channel of a device that has become ready.
  virtual std::shared_ptr<haptics::MonitoredChannel> MakeChannel() = 0;
  /// Never null.
  virtual const haptics::LinkCounts& GetCounts() const = 0;

  /// What the thread reports: where it is, a message, and whether it has lost the device and brings
  /// it up again.
  void Follow(haptics::DevicePhase phase, const std::string& text, bool isNewSession);
  /// A count of the link, for everybody.
  static vtkTypeInt64 Load(const std::atomic<std::uint64_t>& count);
  /// For PrintSelf().
  bool HasRealTimePriority = false;

private:
  vtkThreadedHapticDevice(const vtkThreadedHapticDevice&) = delete;
  void operator=(const vtkThreadedHapticDevice&) = delete;

  void FailFor(const std::string& problem);
  bool ChangeStatusMessage(const std::string& message);
  void ReportStatusMessage(bool changed);

  std::string StatusMessage;
};

#endif
