// How the device's workspace lies over what a vtkHapticScene touches.
#include "vtkHapticScene.h"

#include "haptics/Math/WorkspaceTransform.h"
#include "haptics/Scene/HapticSceneInternals.h"
#include "haptics/Scene/WorkspaceFit.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkHapticDevice.h"
#include "vtkHapticServo.h"
#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>
#include <sstream>

bool vtkHapticScene::SetWorkspaceTransform(vtkMatrix4x4* deviceToWorld)
{
  this->ForgetMessage();
  if (!deviceToWorld)
  {
    this->Fail("There is no matrix to take as the workspace transform. Give one.");
    return false;
  }
  if (!this->MoveWorkspace(deviceToWorld))
  {
    return false;
  }
  std::copy_n(deviceToWorld->GetData(), 16, this->Internal->HomeWorkspace.begin());
  this->Internal->WorkspaceChosen = true;
  return true;
}

bool vtkHapticScene::MoveWorkspace(vtkMatrix4x4* deviceToWorld)
{
  std::string error;
  if (!haptics::WorkspaceTransform().SetMatrix(deviceToWorld->GetData(), error))
  {
    this->Fail(error + " The last one stays.");
    return false;
  }
  this->Servo->SetWorkspaceTransform(deviceToWorld);
  this->Workspace->DeepCopy(deviceToWorld);
  this->Modified();
  return true;
}

vtkMatrix4x4* vtkHapticScene::GetWorkspaceTransform()
{
  return this->Workspace;
}

void vtkHapticScene::ResetWorkspace()
{
  this->SetClutched(false);
  vtkNew<vtkMatrix4x4> home;
  if (this->Internal->WorkspaceChosen)
  {
    home->DeepCopy(this->Internal->HomeWorkspace.data());
  }
  this->MoveWorkspace(home);
}

bool vtkHapticScene::FitWorkspace(vtkCamera* camera)
{
  this->ForgetMessage();
  this->PullSurfaces();
  vtkBoundingBox box;
  for (const auto& surface : this->Internal->Surfaces.All())
  {
    surface->AddBounds(box);
  }
  if (!box.IsValid())
  {
    this->Fail(
      "The workspace fits nothing: the scene has no surface that can be touched. Add one.");
    return false;
  }
  double bounds[6];
  box.GetBounds(bounds);
  return this->FitWorkspace(bounds, camera);
}

bool vtkHapticScene::FitWorkspace(const double bounds[6], vtkCamera* camera)
{
  this->ForgetMessage();
  vtkHapticDevice* device = this->GetDevice();
  if (!device)
  {
    this->Fail("The workspace cannot be fitted without a device. Call SetDevice() first.");
    return false;
  }
  vtkNew<vtkMatrix4x4> fitted;
  std::string error;
  if (!haptics::FitWorkspace(device->GetWorkspaceBounds(), bounds, camera, fitted, error))
  {
    this->Fail("The workspace cannot be fitted: " + error + ".");
    return false;
  }
  return this->SetWorkspaceTransform(fitted);
}

bool vtkHapticScene::EngageInView(vtkCamera* camera)
{
  if (!this->IsEngaged() && this->GetDevice() && !this->Internal->WorkspaceChosen)
  {
    this->PullSurfaces();
    const auto& surfaces = this->Internal->Surfaces.All();
    const bool any = std::any_of(surfaces.begin(), surfaces.end(),
      [](const auto& surface)
      {
        vtkBoundingBox box;
        surface->AddBounds(box);
        return box.IsValid() && box.GetMaxLength() > 0.0;
      });
    if (any && !this->FitWorkspace(camera))
    {
      return false;
    }
  }
  return this->Engage();
}

/// Of a surface in another unit than the metre, where nobody has chosen a workspace: there a device
/// touches next to nothing of it, with a force that has little to do with it. Once, until there is
/// none.
void vtkHapticScene::WarnOfReach()
{
  constexpr double largestRatio = 30.0;
  const double* const bounds = this->GetDevice()->GetWorkspaceBounds();
  const double reach =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  const double scale = std::cbrt(this->Workspace->Determinant());
  const auto& surfaces = this->Internal->Surfaces.All();
  const auto found = std::find_if(surfaces.begin(), surfaces.end(),
    [limit = largestRatio * reach * scale](const auto& surface)
    {
      const auto touched = surface->Touched();
      return touched && 2.0 * touched->Radius() > limit;
    });
  const bool isTooLarge =
    !this->Internal->WorkspaceChosen && reach > 0.0 && found != surfaces.end();
  if (isTooLarge && !this->Internal->HasWarnedOfReach)
  {
    std::ostringstream text;
    text.precision(2);
    text << (*found)->Title() << " has a size of " << 2.0 * (*found)->Touched()->Radius()
         << " world units, and the device reaches over " << reach * scale
         << " of them: no workspace was set, so that "
         << (scale == 1.0 ? "a world unit is a metre" : "the workspace was scaled alone")
         << " in the hand. Call FitWorkspace() or EngageInView() to lay the workspace over the "
            "surfaces, or set the scale with SetWorkspaceTransform(), such as 1000 for a surface "
            "in millimetres in its true size.";
    vtkWarningMacro(<< text.str());
  }
  this->Internal->HasWarnedOfReach = isTooLarge;
}

bool vtkHapticScene::ScaleWorkspace(double factor)
{
  this->ForgetMessage();
  if (!std::isfinite(factor) || !(factor > 0.0))
  {
    this->Fail("The workspace cannot be scaled by " + std::to_string(factor) +
      ". Give a finite factor > 0.");
    return false;
  }
  vtkNew<vtkMatrix4x4> scaled;
  scaled->DeepCopy(this->Workspace);
  // About the god-object: a displacement in the hand stays as it is, and so does its force.
  double middle[4] = { this->GodObject[0], this->GodObject[1], this->GodObject[2], 1.0 };
  if (!this->Internal->Latest)
  {
    const double device[4] = { 0.0, 0.0, 0.0, 1.0 };
    this->Workspace->MultiplyPoint(device, middle); // nobody has been there: the device's origin
  }
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      scaled->SetElement(i, j, factor * scaled->GetElement(i, j));
    }
    scaled->SetElement(i, 3, middle[i] + factor * (scaled->GetElement(i, 3) - middle[i]));
  }
  return this->MoveWorkspace(scaled);
}
