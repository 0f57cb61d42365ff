#ifndef Haptics_HdLibrary_h
#define Haptics_HdLibrary_h

#include <string>

namespace haptics
{
/// @brief What this driver uses of OpenHaptics' HDAPI, libHD.so, which the user has installed.
///
/// The declarations are this project's own, after the facts that HDAPI's programmer's guide and
/// public bindings of several languages agree on. Positions are in mm, forces in N, stiffness in
/// N/mm; a frame's calls are for the scheduler's thread.
class HdLibrary
{
public:
  /// What hdGetError() returns, by value.
  struct Error
  {
    unsigned int Code;
    int InternalCode;
    unsigned int Device;
  };
  using Callback = unsigned int (*)(void* data);

  enum : unsigned int
  {
    InvalidDevice = 0xFFFFFFFF,
    CallAgain = 1, ///< what a callback returns
    CallNoMore = 0,

    CurrentButtons = 0x2000,
    CurrentPosition = 0x2050,
    CurrentTransform = 0x2052, ///< 16 numbers, column by column
    ModelType = 0x2501,
    SerialNumber = 0x2504,
    UsableWorkspace = 0x2551, ///< xmin, ymin, zmin, xmax, ymax, zmax
    CalibrationStyle = 0x2555,
    NominalMaximumStiffness = 0x2602,
    NominalMaximumForce = 0x2603,
    CurrentForce = 0x2700,
    ForceOutput = 0x4000,

    CalibrationIsGood = 0x5000,
    CalibrationNeedsUpdate = 0x5001,
    CalibrationNeedsHand = 0x5002,
    EncoderReset = 1, ///< styles, bits
    Automatic = 2,
    Inkwell = 4,

    DefaultPriority = 0x7fff
  };

  /// Loads it from a path or by its name. Throws DeviceFault.
  explicit HdLibrary(const std::string& file);

  /// What an error means, and what helps.
  std::string Explain(unsigned int code) const;

  unsigned int (*InitDevice)(const char* name);
  void (*DisableDevice)(unsigned int device);
  void (*MakeCurrentDevice)(unsigned int device);
  void (*Enable)(unsigned int capability);
  void (*BeginFrame)(unsigned int device);
  void (*EndFrame)(unsigned int device);
  Error (*GetError)();
  const char* (*GetErrorString)(unsigned int code);
  void (*GetIntegerv)(unsigned int what, int* values);
  void (*GetDoublev)(unsigned int what, double* values);
  void (*SetDoublev)(unsigned int what, const double* values);
  const char* (*GetString)(unsigned int what);
  unsigned int (*CheckCalibration)();
  void (*UpdateCalibration)(unsigned int style);
  unsigned long (*ScheduleAsynchronous)(Callback callback, void* data, unsigned short priority);
  void (*Unschedule)(unsigned long callback);
  void (*StartScheduler)();
  void (*StopScheduler)();
};
}

#endif
