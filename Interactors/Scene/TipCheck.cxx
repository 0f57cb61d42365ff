#include "haptics/Scene/TipCheck.h"

#include "haptics/Scene/SurfaceSet.h"
#include "vtkHapticDevice.h"
#include "vtkHapticWorkspace.h"

#include <algorithm>
#include <sstream>

namespace haptics
{
std::string TipCheck::Check(
  double radius, const SurfaceSet& surfaces, vtkHapticWorkspace* workspace, vtkHapticDevice* device)
{
  if (!(radius > 0.0))
  {
    return {};
  }
  std::ostringstream text;
  text.precision(2);
  text << "A tip with a radius of " << radius << " m is larger than ";
  if (device)
  {
    const double* const bounds = device->GetWorkspaceBounds();
    const double reach =
      std::min({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
    if (reach > 0.0 && radius > 0.5 * reach)
    {
      text << "what the device reaches, " << reach << " m across. The hand is a point until "
           << "SetTipRadius() gives at most " << 0.5 * reach << " m.";
      return text.str();
    }
  }
  double size = 0.0;
  const HapticSurface* largest = nullptr;
  for (const auto& surface : surfaces.All())
  {
    const auto touched = surface->TouchableSurface();
    if (touched && touched->Diagonal() > size)
    {
      size = touched->Diagonal();
      largest = surface.get();
    }
  }
  const double inHand = size / workspace->GetScale();
  if (largest && radius > 0.5 * inHand)
  {
    text << largest->Title() << ", which has a size of " << inHand
         << " m in the hand. The hand is a point until SetTipRadius() gives at most "
         << 0.5 * inHand << " m, or FitWorkspace() makes the surface larger in the hand.";
    return text.str();
  }
  return {};
}
}
