#include "vtkHapticView.h"

#include "haptics/Tick/TickRecord.h"
#include "vtkCallbackCommand.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProbe.h"
#include "vtkHapticReadings.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"

#include <cmath>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkHapticView);

namespace
{
constexpr double UnlimitedScale = 3.3; // [N], what is strongest where nothing limits the force
}

vtkHapticView::vtkHapticView()
{
  this->Callback->SetClientData(this);
  this->Callback->SetCallback(vtkHapticView::OnSceneState);
  this->ServoCallback->SetClientData(this);
  this->ServoCallback->SetCallback(vtkHapticView::OnServo);
  this->LandmarksCallback->SetClientData(this);
  this->LandmarksCallback->SetCallback(vtkHapticView::OnLandmarks);
}

vtkHapticView::~vtkHapticView()
{
  this->SetScene(nullptr);
}

void vtkHapticView::SetScene(vtkHapticScene* scene)
{
  if (scene == this->Scene)
  {
    return;
  }
  if (this->Scene)
  {
    this->Scene->RemoveObserver(this->Callback);
    this->Scene->GetServo()->RemoveObserver(this->ServoCallback);
    this->Scene->GetLandmarks()->RemoveObserver(this->LandmarksCallback);
  }
  this->Scene = scene;
  this->LandmarksShown = 0;
  this->StrongestShown = 0.0;
  if (scene)
  {
    scene->AddObserver(vtkHapticScene::StateEvent, this->Callback);
    scene->GetServo()->AddObserver(vtkCommand::ModifiedEvent, this->ServoCallback);
    scene->GetLandmarks()->AddObserver(vtkCommand::ModifiedEvent, this->LandmarksCallback);
    this->Show();
  }
  this->Modified();
}

vtkHapticScene* vtkHapticView::GetScene()
{
  return this->Scene;
}

void vtkHapticView::OnSceneState(vtkObject*, unsigned long, void* clientData, void*)
{
  auto* self = static_cast<vtkHapticView*>(clientData);
  self->ShowTrail();
  self->Show();
}

/// Without a hand there is no new state, and these can change all the same.
void vtkHapticView::OnServo(vtkObject*, unsigned long, void* clientData, void*)
{
  static_cast<vtkHapticView*>(clientData)->ShowScale();
}

void vtkHapticView::OnLandmarks(vtkObject*, unsigned long, void* clientData, void*)
{
  static_cast<vtkHapticView*>(clientData)->ShowLandmarks();
}

void vtkHapticView::ShowLandmarks()
{
  vtkHapticLandmarks* const landmarks = this->Scene->GetLandmarks();
  if (this->Actor && this->LandmarksShown != landmarks->GetMTime())
  {
    this->LandmarksShown = landmarks->GetMTime();
    this->Actor->SetLandmarks(landmarks->GetOutput());
  }
}

void vtkHapticView::ShowTrail()
{
  if (this->Actor)
  {
    for (const haptics::TickRecord& tick : this->Scene->GetNewTicks())
    {
      this->Actor->AddTrailPoint(tick.Position.data(), tick.NumberOfConstraints > 0);
    }
  }
}

/// Bar, arrow, ring, colours and legend end at one force: the largest that the hand can meet.
void vtkHapticView::ShowScale()
{
  const double limit = this->Scene->GetServo()->GetEffectiveMaximumForce();
  const double strongest = limit > 0.0 && limit < VTK_DOUBLE_MAX ? limit : UnlimitedScale;
  if (strongest == this->StrongestShown)
  {
    return; // what the program has set itself stays
  }
  this->StrongestShown = strongest;
  if (this->Overlay)
  {
    this->Overlay->SetMaximumForce(strongest);
  }
  if (this->Actor)
  {
    this->Actor->SetReferenceForce(strongest);
  }
}

void vtkHapticView::Show()
{
  this->ShowScale();
  if (this->Overlay)
  {
    this->Overlay->SetForce(vtkMath::Norm(this->Scene->GetForce()));
    this->Overlay->SetReadout(this->Overlay->GetShowReadout() ? this->DescribeContact() : "");
  }
  if (this->Actor)
  {
    this->Actor->SetHapticInterfacePoint(this->Scene->GetHapticInterfacePoint());
    this->Actor->SetGodObject(this->Scene->GetGodObject());
    this->Actor->SetForce(this->Scene->GetForce());
    this->Actor->SetTipRadius(
      this->Scene->GetEffectiveTipRadius() * this->Scene->GetWorkspace()->GetScale());
    this->Actor->SetTouching(this->Scene->GetTouching());
    if (this->Actor->GetShowActiveTriangles() && this->Scene->GetTouching())
    {
      const std::vector<haptics::Vec3> corners = this->Scene->GetActiveCorners();
      this->Actor->SetActiveTriangles(
        corners.empty() ? nullptr : corners.front().data(), static_cast<int>(corners.size() / 3));
    }
    this->ShowLandmarks();
  }
}

std::string vtkHapticView::DescribeContact()
{
  const std::string contact = this->Scene->GetProbe()->GetText();
  vtkHapticReadings* readings = this->Scene->GetServo()->GetReadings();
  const char* state = readings->GetSqueezed() ? "surfaces leave no room here: no force"
    : readings->GetOverloaded()               ? "too many triangles here: held"
    : this->Scene->GetSurfaces()->IsOutdated(this->Scene->GetTouchedSurface())
    ? "older than shown: the newest is no good"
    : "";
  const std::string marks = this->DescribeLandmarks();
  return contact + (contact.empty() || !*state ? "" : "\n") + state +
    (marks.empty() || (contact.empty() && !*state) ? "" : "\n") + marks;
}

/// The last two, and how far apart they are.
std::string vtkHapticView::DescribeLandmarks()
{
  vtkHapticLandmarks* const landmarks = this->Scene->GetLandmarks();
  const int last = landmarks->GetNumberOfLandmarks() - 1;
  if (last < 0)
  {
    return {};
  }
  const bool isApart = std::isfinite(landmarks->GetDistanceToPrevious(last));
  return "landmark " + landmarks->GetText(last) +
    (isApart ? " from " + landmarks->GetLabel(last - 1) : "");
}

vtkGodObjectActor* vtkHapticView::GetGodObjectActor()
{
  if (!this->Actor)
  {
    this->Actor = vtkSmartPointer<vtkGodObjectActor>::New();
    this->LandmarksShown = 0;
    this->StrongestShown = 0.0;
    if (this->Scene)
    {
      this->Show();
    }
  }
  return this->Actor;
}

vtkHapticOverlay* vtkHapticView::GetOverlay()
{
  if (!this->Overlay)
  {
    this->Overlay = vtkSmartPointer<vtkHapticOverlay>::New();
    this->StrongestShown = 0.0;
    if (this->Scene)
    {
      this->Show();
    }
  }
  return this->Overlay;
}

void vtkHapticView::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene: " << this->Scene.Get() << "\n";
  os << indent << "GodObjectActor: " << this->Actor.Get() << "\n";
  os << indent << "Overlay: " << this->Overlay.Get() << "\n";
}
