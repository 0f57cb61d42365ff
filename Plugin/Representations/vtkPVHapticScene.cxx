#include "vtkPVHapticScene.h"

#include "PVHapticSceneInternals.h"
#include "vtkCommand.h"
#include "vtkHapticGrip.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticServo.h"
#include "vtkMapper.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

vtkStandardNewMacro(vtkPVHapticScene);

namespace
{
constexpr const char* MouseHint = "Move the mouse over the surface.\n"
                                  "Hold the space bar to press; move to stroke.\n"
                                  "The wheel sets how deep; with Ctrl it zooms. Drag to turn.";

/// How far apart two processes may place the same point [world unit]: some units of the last place
/// of the precision that points are stored in. The last such width where that will still do: with
/// another one a surface whose points move would be built anew instead of deformed.
double SeamWidth(vtkDataSet* data, double last)
{
  auto* surface = vtkPolyData::SafeDownCast(data);
  if (!surface || !surface->GetPoints())
  {
    return 0.0;
  }
  double bounds[6];
  surface->GetBounds(bounds);
  const double largest = *std::max_element(
    bounds, bounds + 6, [](double a, double b) { return std::abs(a) < std::abs(b); });
  const bool isFloat = surface->GetPoints()->GetDataType() == VTK_FLOAT;
  const double least = 4.0 * std::abs(largest) *
    (isFloat ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon());
  return last >= least && last <= 4.0 * least ? last : 2.0 * least;
}
}

vtkPVHapticScene::vtkPVHapticScene()
  : Internal(std::make_unique<Internals>())
{
  this->Internal->Scene->GetServo()->SetMaximumForce(this->Internal->MaximumForce);
  this->Internal->Scene->BackgroundBuildingOn();
  // What is touched is an actor in no renderer: carried, it would leave the picture and the server.
  this->Internal->Scene->GetGrip()->SetButton(-1);
  this->Internal->Scene->AddObserver(
    vtkHapticScene::SurfaceErrorEvent, this, &vtkPVHapticScene::OnSurfaceError);
}

vtkPVHapticScene::~vtkPVHapticScene()
{
  this->SetEngaged(false);
  this->SetView(nullptr);
}

void vtkPVHapticScene::Fail(const std::string& message)
{
  this->Internal->Message = message;
  this->Internal->MessageIsOfSurface = false;
  vtkErrorMacro(<< message);
}

/// Where no surface can be touched and the scene has reported why, that is the cause.
void vtkPVHapticScene::FailWithoutSurface(const std::string& message)
{
  const std::string cause = this->Internal->Scene->GetErrorMessage();
  if (cause.empty() || this->GetNumberOfTouchableSurfaces() > 0)
  {
    this->Fail(message);
    return;
  }
  this->Internal->Message = cause;
  this->Internal->MessageIsOfSurface = true;
}

vtkHapticScene* vtkPVHapticScene::GetScene()
{
  return this->Internal->Scene;
}

vtkHapticView* vtkPVHapticScene::GetPicture()
{
  return this->Internal->Picture;
}

//--- view -----------------------------------------------------------------------------------------

vtkPVRenderView* vtkPVHapticScene::GetView()
{
  return this->Internal->View;
}

void vtkPVHapticScene::SetView(vtkObject* object)
{
  vtkPVRenderView* view = vtkPVRenderView::SafeDownCast(object);
  if (object && !view)
  {
    this->Fail("A view of the kind " + std::string(object->GetClassName()) +
      " cannot be touched. Activate a render view.");
  }
  Internals& self = *this->Internal;
  if (view == self.View && view)
  {
    return;
  }
  if (view)
  {
    this->SetEngaged(false);
  }
  else
  {
    this->ReleaseBecause("there is no view to touch in");
  }
  if (self.View)
  {
    self.Show(nullptr);
    if (self.OverlayRenderer)
    {
      self.OverlayRenderer->RemoveViewProp(self.Picture->GetOverlay());
    }
    self.View->GetRenderWindow()->RemoveObserver(self.ViewObservers.at(0));
    self.View->RemoveObserver(self.ViewObservers.at(1));
    self.ViewObservers.clear();
  }
  self.View = view;
  if (vtkHapticDevice* device = self.Scene->GetDevice())
  {
    device->ConnectView(view ? view->GetInteractor() : nullptr, self.Scene);
  }
  self.Fitted = false; // another view looks elsewhere
  if (view)
  {
    self.OverlayRenderer = view->GetNonCompositedRenderer();
    self.OverlayRenderer->AddViewProp(self.Picture->GetOverlay());
    self.Show(view->GetRenderer());
    this->ShowHand();
    self.ViewObservers = { view->GetRenderWindow()->AddObserver(
                             vtkCommand::StartEvent, &self, &Internals::OnRender),
      view->AddObserver(vtkCommand::DeleteEvent, this, &vtkPVHapticScene::OnViewDeleted) };
  }
  this->Modified();
}

void vtkPVHapticScene::OnViewDeleted()
{
  // Its window and renderers go with it, and our props in them.
  this->Internal->View = nullptr;
  this->Internal->ViewObservers.clear();
  this->ReleaseBecause("the view was closed");
}

//--- surfaces -------------------------------------------------------------------------------------

void vtkPVHapticScene::AddSurface(vtkObject* representation)
{
  if (!vtkCompositeRepresentation::SafeDownCast(representation) &&
    !vtkHapticSurfaceRepresentation::SafeDownCast(representation))
  {
    this->Fail(std::string(representation ? representation->GetClassName() : "Nothing") +
      " has no surface to touch. Give a representation of a render view.");
    return;
  }
  Internals::Surface surface;
  surface.Representation = representation;
  this->Internal->Surfaces.push_back(surface);
  this->Modified();
}

void vtkPVHapticScene::SetSurfaceSource(
  vtkObject* representation, const std::string& name, vtkHapticSurfaceRepresentation* beside)
{
  for (Internals::Surface& surface : this->Internal->Surfaces)
  {
    if (surface.Representation == representation)
    {
      surface.Name = name;
      surface.Beside = beside;
      this->Internal->Scene->SetSurfaceName(surface.Id, name.c_str());
    }
  }
}

void vtkPVHapticScene::RemoveAllSurfaces()
{
  this->Internal->Surfaces.clear();
  this->Modified();
}

void vtkPVHapticScene::SyncSurfaces()
{
  Internals& self = *this->Internal;
  self.Surfaces.erase(std::remove_if(self.Surfaces.begin(), self.Surfaces.end(),
                        [](const Internals::Surface& s) { return !s.Representation; }),
    self.Surfaces.end());
  std::set<vtkActor*> wanted;
  for (Internals::Surface& surface : self.Surfaces)
  {
    vtkHapticSurfaceRepresentation* representation = Internals::Touched(surface);
    surface.Actor = representation ? representation->GetTouchedActor() : nullptr;
    surface.Id = -1;
    if (surface.Actor)
    {
      wanted.insert(surface.Actor);
      surface.Id = self.Scene->AddSurface(surface.Actor);
      self.Scene->SetSurfaceName(surface.Id, surface.Name.c_str());
      vtkGodObjectFilter* filter = self.Scene->GetSurfaceFilter(surface.Id);
      filter->SetSide(self.Side);
      representation->Configure(filter);
      filter->SetMergeToleranceIsAbsolute(true);
      vtkDataSet* data = surface.Actor->GetMapper()->GetInput();
      filter->SetMergeTolerance(self.InPieces ? SeamWidth(data, filter->GetMergeTolerance()) : 0.0);
    }
  }
  for (int i = self.Scene->GetNumberOfSurfaces() - 1; i >= 0; --i)
  {
    const int id = self.Scene->GetSurfaceId(i);
    if (wanted.count(self.Scene->GetSurfaceActor(id)) == 0)
    {
      self.Scene->RemoveSurface(id);
    }
  }
}

int vtkPVHapticScene::GetNumberOfTouchableSurfaces()
{
  int touchable = 0;
  for (const Internals::Surface& surface : this->Internal->Surfaces)
  {
    touchable += this->Internal->Scene->IsSurfaceTouchable(surface.Id) ? 1 : 0;
  }
  return touchable;
}

/// Whether one that is shown cannot be touched, or not as it is shown. One that is being built may
/// be.
bool vtkPVHapticScene::HasBadSurface()
{
  vtkHapticScene* scene = this->Internal->Scene;
  const std::vector<Internals::Surface>& surfaces = this->Internal->Surfaces;
  return scene->IsBuilding() ||
    std::any_of(surfaces.begin(), surfaces.end(),
      [scene](const Internals::Surface& surface)
      {
        return surface.Actor && surface.Actor->GetVisibility() &&
          (!scene->IsSurfaceTouchable(surface.Id) || scene->IsSurfaceOutdated(surface.Id));
      });
}

void vtkPVHapticScene::OnSurfaceError()
{
  this->Internal->Message = this->Internal->Scene->GetErrorMessage(); // it has reported it itself
  this->Internal->MessageIsOfSurface = true;
}

void vtkPVHapticScene::SetInPieces(bool inPieces)
{
  this->Internal->InPieces = inPieces;
}

void vtkPVHapticScene::SetSide(int side)
{
  this->Internal->Side = std::clamp(
    side, static_cast<int>(vtkGodObjectFilter::FRONT), +vtkGodObjectFilter::AUTOMATIC_SIDE);
  this->Modified();
}

int vtkPVHapticScene::GetSide()
{
  return this->Internal->Side;
}

//--- device ---------------------------------------------------------------------------------------

void vtkPVHapticScene::SetDeviceName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (wanted != this->Internal->DeviceName)
  {
    this->SetEngaged(false);
    this->Internal->Scene->SetDevice(nullptr);
    this->Internal->Choice = haptics::DeviceChoice();
    this->Internal->DeviceName = wanted;
    this->Internal->Fitted = false; // another device reaches elsewhere
    this->Internal->Message.clear();
    this->Modified();
  }
}

const char* vtkPVHapticScene::GetDeviceName()
{
  return this->Internal->DeviceName.c_str();
}

bool vtkPVHapticScene::ChooseDevice()
{
  Internals& self = *this->Internal;
  if (self.Choice.Device())
  {
    return true;
  }
  std::string error;
  self.Choice = haptics::DeviceChoice::Make(self.DeviceName, error);
  if (!self.Choice.Device())
  {
    this->Fail(error);
    return false;
  }
  self.Scene->SetDevice(self.Choice.Device());
  self.PathIsKnown = false;
  self.Choice.Device()->ConnectView(self.View ? self.View->GetInteractor() : nullptr, self.Scene);
  return true;
}

bool vtkPVHapticScene::Prepare()
{
  Internals& self = *this->Internal;
  if (!self.View)
  {
    this->Fail("There is no render view to touch in. Activate one.");
    return false;
  }
  if (self.Surfaces.empty())
  {
    this->Fail("There is nothing to touch. Select a source and press Touch.");
    return false;
  }
  return this->ChooseDevice() && (self.Fitted || this->Fit()) && this->ChoosePath();
}

bool vtkPVHapticScene::ChoosePath()
{
  Internals& self = *this->Internal;
  if (self.PathIsKnown)
  {
    return true;
  }
  if (!self.Choice.MakeStroke(self.Scene))
  {
    this->FailWithoutSurface("The simulated hand finds no surface to stroke in the middle of the "
                             "view. Turn the camera to one.");
    return false;
  }
  self.Scene->GetServo()->Stop(); // in virtual time too: the device is opened anew
  self.Choice.FollowPath(self.Scene->GetWorkspaceTransform());
  self.PathIsKnown = true;
  return true;
}

void vtkPVHapticScene::SetEngaged(bool engaged)
{
  Internals& self = *this->Internal;
  if (!engaged)
  {
    self.Wanted = false;
    self.Scene->Release();
    this->ShowHand();
    return;
  }
  if (self.Scene->IsEngaged())
  {
    return;
  }
  self.Message.clear();
  self.ReleasedBecause.clear();
  this->SyncSurfaces();
  if (!this->ChooseDevice())
  {
    return;
  }
  self.Scene->Update();
  if (this->HasToWait())
  {
    self.Wanted = true; // Update() engages then
    return;
  }
  if (!this->Prepare())
  {
    return;
  }
  self.Wanted = self.Scene->Engage();
  if (!self.Wanted)
  {
    const int state = self.Scene->GetDevice()->GetState();
    self.Wanted = state != vtkHapticDevice::Closed && state != vtkHapticDevice::Faulted &&
      state != vtkHapticDevice::Ready;
    self.Message = self.Wanted ? "" : self.Scene->GetErrorMessage();
  }
}

/// Whether the device must not move before a surface that is built for the first time is there: a
/// stroke follows it, a path might go into it.
bool vtkPVHapticScene::HasToWait()
{
  Internals& self = *this->Internal;
  const bool isLed = !self.Choice.Strokes() && !self.Choice.WorldPath();
  return !isLed && self.Scene->IsBuilding() &&
    this->GetNumberOfTouchableSurfaces() < static_cast<int>(self.Surfaces.size());
}

void vtkPVHapticScene::ReleaseBecause(const std::string& reason)
{
  if (this->Internal->Wanted || this->Internal->Scene->IsEngaged())
  {
    this->SetEngaged(false);
    this->Internal->ReleasedBecause = reason;
  }
}

bool vtkPVHapticScene::GetEngaged()
{
  return this->Internal->Scene->IsEngaged();
}

void vtkPVHapticScene::SetStiffness(double stiffness)
{
  this->Internal->Scene->SetStiffness(stiffness);
  this->Modified();
}

double vtkPVHapticScene::GetStiffness()
{
  return this->Internal->Scene->GetStiffness();
}

double vtkPVHapticScene::GetEffectiveStiffness()
{
  return this->Internal->Scene->GetServo()->GetEffectiveStiffness();
}

void vtkPVHapticScene::SetMaximumForce(double force)
{
  this->Internal->Scene->GetServo()->SetMaximumForce(force);
  this->Internal->MaximumForce = this->Internal->Scene->GetServo()->GetMaximumForce();
  this->Modified();
}

double vtkPVHapticScene::GetMaximumForce()
{
  return this->Internal->MaximumForce;
}

//--- running --------------------------------------------------------------------------------------

bool vtkPVHapticScene::Update()
{
  Internals& self = *this->Internal;
  this->SyncSurfaces();
  if (self.Surfaces.empty())
  {
    this->ReleaseBecause("nothing is left to touch");
  }
  const bool wasEngaged = self.Scene->IsEngaged();
  bool changed = self.Scene->Update();
  if (self.MessageIsOfSurface && !this->HasBadSurface())
  {
    self.MessageIsOfSurface = false;
    self.Message.clear(); // the fault is mended, or its surface gone
  }
  if (wasEngaged && !self.Scene->IsEngaged())
  {
    self.Wanted = false;
    self.Message = self.Scene->GetErrorMessage();
    changed = true;
  }
  if (self.Wanted && !self.Scene->IsEngaged())
  {
    this->EngageWhenReady();
    changed = true;
  }
  // What the panel says is part of the picture.
  if (self.ShownState != this->GetState())
  {
    self.ShownState = self.State;
    changed = true;
  }
  this->ShowHand();
  self.MustRender = self.MustRender || changed;
  return self.MustRender;
}

/// Hand and force are in the picture as long as a hand is there, and what it left stays.
void vtkPVHapticScene::ShowHand()
{
  Internals& self = *this->Internal;
  if (!self.View)
  {
    return;
  }
  const int state = self.Scene->GetServo()->GetState();
  const bool isThere = state == vtkHapticServo::Running || state == vtkHapticServo::Stepping;
  vtkHapticOverlay* overlay = self.Picture->GetOverlay();
  self.HasTouched = self.HasTouched || self.Scene->GetTouching();
  vtkHapticDevice* device = self.Scene->GetDevice();
  overlay->SetHint(device && device->UsesView() && !self.HasTouched ? MouseHint : "");
  const std::string what = self.Scene->IsEngaged() || self.Wanted ? this->GetState() : "";
  const std::string engaged = "Engaged, ";
  overlay->SetStatus(what.rfind(engaged, 0) == 0 ? what.substr(engaged.size()) : what);
  const bool isShown = isThere || self.Wanted;
  if (isShown != (overlay->GetVisibility() != 0))
  {
    overlay->SetVisibility(isShown);
    self.MustRender = true;
  }
  self.Picture->GetGodObjectActor()->SetShowHand(isThere);
}

void vtkPVHapticScene::EngageWhenReady()
{
  Internals& self = *this->Internal;
  const int state = self.Scene->GetDevice()->GetState();
  if (state == vtkHapticDevice::Faulted)
  {
    self.Wanted = false;
    self.Message = self.Scene->GetDevice()->GetErrorMessage();
  }
  else if (!this->HasToWait() &&
    (state == vtkHapticDevice::Ready || state == vtkHapticDevice::Closed))
  {
    self.Wanted = false;
    this->SetEngaged(true);
  }
}

void vtkPVHapticScene::Step(int ticks)
{
  vtkHapticScene* scene = this->Internal->Scene;
  this->Internal->Message.clear();
  this->Internal->ReleasedBecause.clear();
  this->SyncSurfaces();
  scene->BackgroundBuildingOff(); // virtual time waits for what is to be touched
  scene->Update();
  if (this->Prepare() && scene->Step(ticks) < std::max(ticks, 1))
  {
    this->Internal->Message = scene->GetErrorMessage();
  }
  scene->BackgroundBuildingOn();
  this->ShowHand();
}
