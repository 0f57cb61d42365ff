#ifndef Haptics_TipCheck_h
#define Haptics_TipCheck_h

#include <string>

class vtkHapticDevice;
class vtkHapticWorkspace;

namespace haptics
{
class SurfaceSet;

/// @brief Whether a tip has room: in the device's reach, and next to what it is to touch.
///
/// GUI thread.
class TipCheck
{
public:
  /// What is wrong with a tip of this radius [m], device frame; empty where nothing is.
  static std::string Check(double radius, const SurfaceSet& surfaces, vtkHapticWorkspace* workspace,
    vtkHapticDevice* device);
};
}

#endif
