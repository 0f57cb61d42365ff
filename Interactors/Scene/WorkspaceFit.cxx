#include "haptics/Scene/WorkspaceFit.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
bool IsBox(const double bounds[6])
{
  return std::all_of(bounds, bounds + 6, [](double b) { return std::isfinite(b); }) &&
    bounds[0] <= bounds[1] && bounds[2] <= bounds[3] && bounds[4] <= bounds[5];
}

/// Right, up and backwards of the camera as rows.
void CameraAxes(vtkCamera* camera, double axes[3][3])
{
  vtkMatrix4x4* view = camera->GetViewTransformMatrix();
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      axes[i][j] = view->GetElement(i, j);
    }
  }
}
}

bool FitWorkspace(const double workspace[6], const double world[6], vtkCamera* camera,
  vtkMatrix4x4* deviceToWorld, std::string& error)
{
  if (!IsBox(workspace) || !IsBox(world))
  {
    error =
      IsBox(world) ? "the device's workspace is no finite box" : "the bounds are no finite box";
    return false;
  }
  double axes[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  if (camera)
  {
    CameraAxes(camera, axes);
  }
  double scale = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    double extent = 0.0; // of the world's box along the device's axis
    for (int j = 0; j < 3; ++j)
    {
      extent += std::abs(axes[i][j]) * (world[2 * j + 1] - world[2 * j]);
    }
    const double reach = workspace[2 * i + 1] - workspace[2 * i];
    if (!(reach > 0.0))
    {
      error = "the device's workspace has no extent along one axis";
      return false;
    }
    scale = std::max(scale, extent / reach);
  }
  if (!(scale > 0.0) || !std::isfinite(scale))
  {
    error = "the bounds have no extent";
    return false;
  }
  deviceToWorld->Identity();
  for (int i = 0; i < 3; ++i)
  {
    double translation = 0.5 * (world[2 * i] + world[2 * i + 1]);
    for (int j = 0; j < 3; ++j)
    {
      deviceToWorld->SetElement(i, j, scale * axes[j][i]);
      translation -= scale * axes[j][i] * 0.5 * (workspace[2 * j] + workspace[2 * j + 1]);
    }
    deviceToWorld->SetElement(i, 3, translation);
  }
  return true;
}
}
