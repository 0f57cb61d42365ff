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
  constexpr double smallestRatio = 0.01;
  const double* const bounds = device->GetWorkspaceBounds();
  const double scale = workspace->GetScale();
  const double reach =
    scale * std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  const HapticSurface* largest = nullptr;
  double size = 0.0;
  for (const auto& surface : surfaces.All())
  {
    const auto touched = surface->TouchableSurface();
    if (touched && touched->Diagonal() > size)
    {
      size = touched->Diagonal();
      largest = surface.get();
    }
  }
  const bool isOdd = !workspace->GetChosen() && reach > 0.0 && largest &&
    !(size >= smallestRatio * reach && size <= largestRatio * reach);
  if (std::exchange(this->HasWarned, isOdd) || !isOdd)
  {
    return {};
  }
  const bool isUnitKnown = workspace->GetUnitLength() > 0.0;
  std::ostringstream text;
  text.precision(2);
  text << largest->Title() << " has a size of " << size
       << " world units, and the device reaches over " << reach
       << " of them: no workspace was set, so that "
       << (isUnitKnown       ? "surfaces have their true size"
              : scale == 1.0 ? "a world unit is a metre"
                             : "the workspace was scaled alone")
       << " in the hand. Call FitWorkspace() or EngageInView() to lay the workspace over the "
          "surfaces"
       << (isUnitKnown ? "."
                       : ", or SetUnitLength() where a world unit is no metre, such as 0.001 for "
                         "millimetres.");
  return text.str();
}
}
