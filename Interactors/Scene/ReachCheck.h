#ifndef Haptics_ReachCheck_h
#define Haptics_ReachCheck_h

#include <string>

class vtkHapticDevice;
class vtkHapticWorkspace;

namespace haptics
{
class SurfaceSet;

/// @brief Whether surfaces are in another unit than the metre, where nobody has chosen a workspace.
///
/// There a device touches next to nothing of one that is too large, with a force that has little to
/// do with it, and does not find what is too small. GUI thread.
class ReachCheck
{
public:
  /// What to warn of now: once, until there is no such surface; empty elsewhere.
  std::string Check(
    const SurfaceSet& surfaces, vtkHapticWorkspace* workspace, vtkHapticDevice* device);

private:
  bool HasWarned = false;
};
}

#endif
