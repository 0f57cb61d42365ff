#include "haptics/Scene/ReachCheck.h"

#include "haptics/Scene/SurfaceSet.h"
#include "vtkHapticDevice.h"
#include "vtkHapticWorkspace.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace haptics
{
std::string ReachCheck::Check(
  const SurfaceSet& surfaces, vtkHapticWorkspace* workspace, vtkHapticDevice* device)
{
  constexpr double largestRatio = 30.0;
  const double* const bounds = device->GetWorkspaceBounds();
  const double reach =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  const double scale = workspace->GetScale();
  const auto& all = surfaces.All();
  const auto found = std::find_if(all.begin(), all.end(),
    [limit = largestRatio * reach * scale](const auto& surface)
    {
      const auto touched = surface->Touched();
      return touched && 2.0 * touched->Radius() > limit;
    });
  const bool isTooLarge = !workspace->GetChosen() && reach > 0.0 && found != all.end();
  if (std::exchange(this->HasWarned, isTooLarge) || !isTooLarge)
  {
    return {};
  }
  std::ostringstream text;
  text.precision(2);
  text << (*found)->Title() << " has a size of " << 2.0 * (*found)->Touched()->Radius()
       << " world units, and the device reaches over " << reach * scale
       << " of them: no workspace was set, so that "
       << (scale == 1.0 ? "a world unit is a metre" : "the workspace was scaled alone")
       << " in the hand. Call FitWorkspace() or EngageInView() to lay the workspace over the "
          "surfaces, or set the scale with SetWorkspaceTransform(), such as 1000 for a surface "
          "in millimetres in its true size.";
  return text.str();
}
}
