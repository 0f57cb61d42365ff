/**
 * @class   vtkPenHapticDevice
 * @brief   a haptic device of one's own: a project to begin with
 *
 * All is in metres, newtons and seconds, in the device's own frame.
 */
#ifndef vtkPenHapticDevice_h
#define vtkPenHapticDevice_h

#include <vtkHapticDevice.h>

#include <memory>

class vtkPenHapticDevice : public vtkHapticDevice
{
public:
  static vtkPenHapticDevice* New();
  vtkTypeMacro(vtkPenHapticDevice, vtkHapticDevice);

  bool Open() override;
  void Close() override;

protected:
  vtkPenHapticDevice();
  ~vtkPenHapticDevice() override;

private:
  class PenChannel;
  std::shared_ptr<PenChannel> Channel; // null while closed
};

#endif
