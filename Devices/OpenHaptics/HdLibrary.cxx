#include "haptics/Devices/OpenHaptics/HdLibrary.h"

#include "haptics/Devices/Driver/VendorLibrary.h"

namespace haptics
{
HdLibrary::HdLibrary(const std::string& file)
{
  const VendorLibrary library({ file },
    "Install 3D Systems' OpenHaptics and its Touch device driver, or set LibraryFile. The USB "
    "models of the Touch from 2022 on need the driver with libPhantomIOLib42.so.");
  library.Get(this->InitDevice, "hdInitDevice");
  library.Get(this->DisableDevice, "hdDisableDevice");
  library.Get(this->MakeCurrentDevice, "hdMakeCurrentDevice");
  library.Get(this->Enable, "hdEnable");
  library.Get(this->BeginFrame, "hdBeginFrame");
  library.Get(this->EndFrame, "hdEndFrame");
  library.Get(this->GetError, "hdGetError");
  library.Get(this->GetErrorString, "hdGetErrorString");
  library.Get(this->GetIntegerv, "hdGetIntegerv");
  library.Get(this->GetDoublev, "hdGetDoublev");
  library.Get(this->SetDoublev, "hdSetDoublev");
  library.Get(this->GetString, "hdGetString");
  library.Get(this->CheckCalibration, "hdCheckCalibration");
  library.Get(this->UpdateCalibration, "hdUpdateCalibration");
  library.Get(this->ScheduleAsynchronous, "hdScheduleAsynchronous");
  library.Get(this->Unschedule, "hdUnschedule");
  library.Get(this->StartScheduler, "hdStartScheduler");
  library.Get(this->StopScheduler, "hdStopScheduler");
}

std::string HdLibrary::Explain(unsigned int code) const
{
  switch (code)
  {
    case 0x0200:
      return "The device's motors are warm, and it gives no force. Let it rest for some minutes, "
             "use a smaller ForceLimit, then open it again.";
    case 0x0201:
    case 0x0202:
      return "The device was asked for more force than it takes. Use a smaller ForceLimit, then "
             "open it again.";
    case 0x0203:
      return "The device was moved faster than it takes with force. Hold it more firmly, use a "
             "smaller stiffness, then open it again.";
    case 0x0204:
      return "The device's motors or amplifiers have failed. Switch it off and on, then open it "
             "again.";
    case 0x0300:
    case 0x0302:
    case 0x0303:
      return "The device cannot be reached: it is not plugged in, has no power, was set up under "
             "another name, or may not be opened by this user. Check its cables; run the maker's "
             "Touch_Setup, which has to have written its settings to $GTDD_HOME; let the user "
             "read and write /dev/hidraw* (USB models, 2988:0304), /dev/ttyACM* or the network "
             "interface. USB models need libPhantomIOLib42.so.";
    case 0x0301:
      return "The device is in use by another program or another device object. Close that one, "
             "then open it again.";
    case 0x0304:
    case 0x0500:
    case 0x0501:
      return "OpenHaptics' scheduler does not run: end other programs that use it, then open the "
             "device again.";
    case 0x0600:
      return "OpenHaptics has no valid licence. Install the licence with the maker's licence "
             "manager, then open the device again.";
    default:
    {
      const char* const text = this->GetErrorString(code);
      return "OpenHaptics reports an error: " + std::string(text && *text ? text : "unknown") +
        " (" + std::to_string(code) + "). Open the device again.";
    }
  }
}
}
