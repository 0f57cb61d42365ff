// What a vtkHapticScene shows: the hand in the picture, the read-out, the probe.
#include "vtkHapticScene.h"

#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProbe.h"
#include "vtkHapticServo.h"
#include "vtkMath.h"

#include <vector>

void vtkHapticScene::ShowInPicture()
{
  if (this->Overlay)
  {
    this->Overlay->SetForce(vtkMath::Norm(this->Force));
    const double limit = this->Servo->GetEffectiveMaximumForce();
    this->Overlay->SetMaximumForce(limit > 0.0 && limit < VTK_DOUBLE_MAX ? limit : 3.3);
    this->Overlay->SetReadout(this->Overlay->GetShowReadout() ? this->DescribeContact() : "");
  }
  if (this->Actor)
  {
    this->Actor->SetHapticInterfacePoint(this->HapticInterfacePoint);
    this->Actor->SetGodObject(this->GodObject);
    this->Actor->SetForce(this->Force);
    this->Actor->SetTouching(this->Touching);
    if (this->Actor->GetShowActiveTriangles() && this->Touching)
    {
      const std::vector<haptics::Vec3> corners =
        this->Internal->Surfaces.ActiveCorners(*this->Internal->Latest);
      this->Actor->SetActiveTriangles(
        corners.empty() ? nullptr : corners.front().data(), static_cast<int>(corners.size() / 3));
    }
    if (this->Internal->LandmarksShown != this->Landmarks->GetMTime())
    {
      this->Internal->LandmarksShown = this->Landmarks->GetMTime();
      this->Actor->SetLandmarks(this->Landmarks->GetOutput());
    }
  }
}

std::string vtkHapticScene::DescribeContact()
{
  const std::string contact = this->GetProbe()->GetText();
  const char* state = this->Squeezed                ? "surfaces leave no room here: no force"
    : this->Overloaded                              ? "too many triangles here: held"
    : this->IsSurfaceOutdated(this->TouchedSurface) ? "older than shown: the newest is no good"
                                                    : "";
  return contact + (contact.empty() || !*state ? "" : "\n") + state;
}

vtkGodObjectActor* vtkHapticScene::GetGodObjectActor()
{
  if (!this->Actor)
  {
    this->Actor = vtkSmartPointer<vtkGodObjectActor>::New();
    this->Internal->LandmarksShown = 0;
    this->ShowInPicture();
  }
  return this->Actor;
}

vtkHapticOverlay* vtkHapticScene::GetOverlay()
{
  if (!this->Overlay)
  {
    this->Overlay = vtkSmartPointer<vtkHapticOverlay>::New();
    this->ShowInPicture();
  }
  return this->Overlay;
}

void vtkHapticScene::UpdateProbe(bool touching)
{
  this->Probe = vtkSmartPointer<vtkHapticProbe>::New();
  if (touching)
  {
    this->Internal->Surfaces.Probe(*this->Internal->Latest, this->Probe);
  }
}

vtkHapticProbe* vtkHapticScene::GetProbe()
{
  if (!this->Probe)
  {
    this->UpdateProbe(this->Touching);
  }
  return this->Probe;
}
