#include "vtkPVHapticScene.h"

#include "HapticDeviceChoice.h"
#include "RepresentedSurfaces.h"
#include "haptics/Servo/SafetySettings.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkHapticGrip.h"
#include "vtkHapticReadings.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVHapticPicture.h"
#include "vtkPVHapticReadings.h"
#include "vtkPVHapticRecords.h"
#include "vtkPVHapticWorkspace.h"
#include "vtkPVRenderView.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

class vtkPVHapticScene::Internals
{
public:
  vtkNew<vtkHapticScene> Scene;
  vtkSmartPointer<vtkPVHapticPicture> Picture;
  vtkSmartPointer<vtkPVHapticReadings> Readings;
  vtkSmartPointer<vtkPVHapticRecords> Records;
  vtkSmartPointer<vtkPVHapticWorkspace> Workspace;
  vtkWeakPointer<vtkPVRenderView> View;
  unsigned long ViewObserver = 0;
  haptics::RepresentedSurfaces Surfaces{ Scene };
  std::string DeviceName = "mouse";
  haptics::DeviceChoice Choice;
  vtkTimeStamp PathTime; // when the device got its path, for the workspace transform of then
  bool Wanted = false;   // engaged, or about to be when the device is ready
  std::string Message;
  /// What Message is about, and is mended by: it goes then.
  enum class Topic
  {
    Other,
    BadSurface, ///< one that cannot be touched
    Choice,     ///< which surfaces are to be touched
    View
  };
  Topic MessageTopic = Topic::Other;
  void EndMessageOf(Topic topic)
  {
    if (this->MessageTopic == topic)
    {
      this->MessageTopic = Topic::Other;
      this->Message.clear();
    }
  }
  std::string ReleasedBecause; // by what the user did with sources and views
  void EndReason(const char* reason)
  {
    if (this->ReleasedBecause == reason)
    {
      this->ReleasedBecause.clear();
    }
  }
  bool HasTouched = false; // the hint is not needed any more
  std::string State;
  std::string ShownState;

  /// Whether the hand is ahead of what is here of a surface in patches.
  bool AwaitsData() const
  {
    const int limits = this->Scene->GetServo()->GetReadings()->GetForceLimits();
    return (limits & haptics::DataAwaited) != 0;
  }
  /// Whether there is a hand, in virtual time too.
  bool HasHand() const
  {
    const int state = this->Scene->GetServo()->GetState();
    return state == vtkHapticServo::Running || state == vtkHapticServo::Stepping;
  }

  /// Puts a part in the place of another one; what it cannot do is the scene's message.
  template <class Part>
  void Exchange(vtkSmartPointer<Part>& place, Part* part, vtkPVHapticScene* self)
  {
    if (part && part != place)
    {
      if (place)
      {
        place->SetScene(nullptr, nullptr);
      }
      place = part;
      part->SetScene(this->Scene, &this->Surfaces);
      part->AddObserver(vtkPVHapticPart::FailEvent, self, &vtkPVHapticScene::OnPartFailed);
    }
  }
};

vtkStandardNewMacro(vtkPVHapticScene);

namespace
{
// Why a hand was released, as long as it is so.
constexpr const char* NothingLeft = "nothing is left to touch";
constexpr const char* NoView = "there is no view to touch in";

constexpr const char* MouseHint = "Move the mouse over the surface.\n"
                                  "Hold the space bar to press,\n"
                                  "and move to stroke.\n"
                                  "The wheel sets how deep;\n"
                                  "with Ctrl it zooms. Drag to turn.";
}

vtkPVHapticScene::vtkPVHapticScene()
  : Internal(std::make_unique<Internals>())
{
  this->Internal->Scene->GetServo()->SetMaximumForce(3.3);
  this->Internal->Scene->GetSurfaces()->BackgroundBuildingOn();
  // What is touched is an actor in no renderer: carried, it would leave the picture and the server.
  this->Internal->Scene->GetGrip()->SetButton(-1);
  this->Internal->Scene->AddObserver(
    vtkHapticScene::SurfaceErrorEvent, this, &vtkPVHapticScene::OnSurfaceError);
  this->SetPicture(vtkNew<vtkPVHapticPicture>());
  this->SetReadings(vtkNew<vtkPVHapticReadings>());
  this->SetRecords(vtkNew<vtkPVHapticRecords>());
  this->SetWorkspace(vtkNew<vtkPVHapticWorkspace>());
}

vtkPVHapticScene::~vtkPVHapticScene()
{
  this->SetEngaged(false);
  this->SetView(nullptr);
  for (vtkPVHapticPart* part : std::initializer_list<vtkPVHapticPart*>{
         this->GetPicture(), this->GetReadings(), this->GetRecords(), this->GetWorkspace() })
  {
    part->SetScene(nullptr, nullptr);
  }
}

void vtkPVHapticScene::Fail(const std::string& message)
{
  this->Internal->Message = message;
  this->Internal->MessageTopic = Internals::Topic::Other;
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
  this->Internal->MessageTopic = Internals::Topic::BadSurface;
}

vtkHapticScene* vtkPVHapticScene::GetScene()
{
  return this->Internal->Scene;
}

void vtkPVHapticScene::SetPicture(vtkPVHapticPicture* picture)
{
  this->Internal->Exchange(this->Internal->Picture, picture, this);
}

vtkPVHapticPicture* vtkPVHapticScene::GetPicture()
{
  return this->Internal->Picture;
}

void vtkPVHapticScene::SetReadings(vtkPVHapticReadings* readings)
{
  this->Internal->Exchange(this->Internal->Readings, readings, this);
}

vtkPVHapticReadings* vtkPVHapticScene::GetReadings()
{
  return this->Internal->Readings;
}

void vtkPVHapticScene::SetRecords(vtkPVHapticRecords* records)
{
  this->Internal->Exchange(this->Internal->Records, records, this);
}

vtkPVHapticRecords* vtkPVHapticScene::GetRecords()
{
  return this->Internal->Records;
}

void vtkPVHapticScene::SetWorkspace(vtkPVHapticWorkspace* workspace)
{
  this->Internal->Exchange(this->Internal->Workspace, workspace, this);
}

vtkPVHapticWorkspace* vtkPVHapticScene::GetWorkspace()
{
  return this->Internal->Workspace;
}

void vtkPVHapticScene::OnPartFailed(vtkObject*, unsigned long, void* message)
{
  this->Internal->Message = static_cast<const char*>(message); // it has been reported
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
    this->Internal->MessageTopic = Internals::Topic::View;
  }
  else
  {
    this->Internal->EndMessageOf(Internals::Topic::View);
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
    this->ReleaseBecause(NoView);
  }
  if (self.View)
  {
    self.View->RemoveObserver(self.ViewObserver);
  }
  self.View = view;
  self.Picture->SetView(view);
  if (vtkHapticDevice* device = self.Scene->GetDevice())
  {
    device->ConnectView(view ? view->GetInteractor() : nullptr, self.Scene);
  }
  self.Workspace->Forget(); // another view looks elsewhere
  if (view)
  {
    self.EndReason(NoView);
    this->ShowHand();
    self.ViewObserver =
      view->AddObserver(vtkCommand::DeleteEvent, this, &vtkPVHapticScene::OnViewDeleted);
  }
  this->Modified();
}

void vtkPVHapticScene::OnViewDeleted()
{
  this->Internal->View = nullptr;
  this->ReleaseBecause("the view was closed");
}

//--- surfaces -------------------------------------------------------------------------------------

void vtkPVHapticScene::AddSurface(vtkObject* representation)
{
  if (!this->Internal->Surfaces.Add(representation))
  {
    this->Fail(std::string(representation ? representation->GetClassName() : "Nothing") +
      " has no surface to touch. Give a representation of a render view.");
    this->Internal->MessageTopic = Internals::Topic::Choice;
    return;
  }
  this->Internal->EndMessageOf(Internals::Topic::Choice);
  this->Internal->EndReason(NothingLeft);
  this->Modified();
}

void vtkPVHapticScene::SetSurfaceSource(
  vtkObject* representation, const std::string& name, vtkHapticSurfaceRepresentation* source)
{
  this->Internal->Surfaces.SetSource(representation, name, source);
}

void vtkPVHapticScene::RemoveAllSurfaces()
{
  this->Internal->Surfaces.Clear();
  this->Modified();
}

int vtkPVHapticScene::GetNumberOfTouchableSurfaces()
{
  return this->Internal->Surfaces.NumberOfTouchable();
}

void vtkPVHapticScene::OnSurfaceError()
{
  this->Internal->Message = this->Internal->Scene->GetErrorMessage(); // it has reported it itself
  this->Internal->MessageTopic = Internals::Topic::BadSurface;
}

void vtkPVHapticScene::SetInPieces(bool inPieces)
{
  this->Internal->Surfaces.SetInPieces(inPieces);
}

void vtkPVHapticScene::SetSide(int side)
{
  this->Internal->Surfaces.SetSide(side);
  this->Modified();
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
    this->Internal->Workspace->Forget(); // another device reaches elsewhere
    this->Internal->Message.clear();
    this->Modified();
  }
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
  self.PathTime = vtkTimeStamp();
  self.Choice.Device()->ConnectView(self.View ? self.View->GetInteractor() : nullptr, self.Scene);
  return true;
}

bool vtkPVHapticScene::Prepare()
{
  Internals& self = *this->Internal;
  if (!self.View)
  {
    this->Fail("There is no render view to touch in. Activate one.");
    self.MessageTopic = Internals::Topic::View;
    return false;
  }
  if (self.Surfaces.Size() == 0)
  {
    this->Fail("There is nothing to touch. Select a source and press Touch.");
    self.MessageTopic = Internals::Topic::Choice;
    return false;
  }
  return this->ChooseDevice() && (self.Workspace->GetChosen() || this->Fit()) && this->ChoosePath();
}

bool vtkPVHapticScene::ChoosePath()
{
  Internals& self = *this->Internal;
  if (self.PathTime.GetMTime() > self.Workspace->GetChosenTime())
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
  self.PathTime.Modified();
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
  this->Internal->Surfaces.Sync();
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
  return !isLed && self.Scene->GetSurfaces()->IsBuilding() &&
    this->GetNumberOfTouchableSurfaces() < self.Surfaces.Size();
}

void vtkPVHapticScene::ReleaseBecause(const std::string& reason)
{
  if (this->Internal->Wanted || this->Internal->HasHand())
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

void vtkPVHapticScene::SetMaximumForce(double force)
{
  this->Internal->Scene->GetServo()->SetMaximumForce(force);
  this->Modified();
}

void vtkPVHapticScene::SetSubstepLimit(int limit)
{
  this->Internal->Scene->GetServo()->SetSubstepLimit(limit);
  this->Modified();
}

void vtkPVHapticScene::SetTipRadius(double radius)
{
  this->Internal->Scene->SetTipRadius(radius);
  this->Modified();
}

//--- running --------------------------------------------------------------------------------------

bool vtkPVHapticScene::Update()
{
  Internals& self = *this->Internal;
  this->Internal->Surfaces.Sync();
  if (self.Surfaces.Size() == 0)
  {
    this->ReleaseBecause(NothingLeft);
  }
  const bool wasEngaged = self.Scene->IsEngaged();
  bool changed = self.Scene->Update();
  if (self.MessageTopic == Internals::Topic::BadSurface && !self.Surfaces.HasBad())
  {
    self.EndMessageOf(Internals::Topic::BadSurface); // the fault is mended, or its surface gone
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
  if (changed)
  {
    self.Picture->SetOutdated();
  }
  return self.Picture->IsAnyOutdated();
}

/// Hand and force are in the pictures as long as a hand is there, and what it left stays.
void vtkPVHapticScene::ShowHand()
{
  Internals& self = *this->Internal;
  const bool isThere = self.HasHand();
  self.HasTouched = self.HasTouched || self.Scene->GetTouching();
  vtkHapticDevice* device = self.Scene->GetDevice();
  const bool isLed = device && device->UsesView();
  const std::string what = self.Scene->IsEngaged() || self.Wanted ? this->GetState() : "";
  const std::string engaged = "Engaged, ";
  vtkPVHapticPicture::Hand hand;
  hand.IsThere = isThere;
  hand.IsShown = isThere || self.Wanted;
  hand.Status = what.rfind(engaged, 0) == 0 ? what.substr(engaged.size()) : what;
  hand.Hint = isLed && !self.HasTouched ? MouseHint : "";
  self.Picture->Show(hand);
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
  this->Internal->Surfaces.Sync();
  scene->GetSurfaces()->BackgroundBuildingOff(); // virtual time waits for what is to be touched
  scene->Update();
  if (this->Prepare() && scene->Step(ticks) < std::max(ticks, 1))
  {
    this->Internal->Message = scene->GetErrorMessage();
  }
  scene->GetSurfaces()->BackgroundBuildingOn();
  this->ShowHand();
}

bool vtkPVHapticScene::Fit()
{
  Internals& self = *this->Internal;
  if (!self.View)
  {
    this->Fail("There is no render view to fit the device's workspace to. Activate one.");
    self.MessageTopic = Internals::Topic::View;
    return false;
  }
  if (!this->ChooseDevice())
  {
    return false;
  }
  this->Internal->Surfaces.Sync();
  vtkBoundingBox box = self.Surfaces.Bounds();
  vtkPolyData* path = self.Choice.WorldPath();
  if (path && !self.Choice.Strokes())
  {
    box.SetBounds(path->GetBounds());
  }
  if (!box.IsValid())
  {
    this->Fail(
      "The device's workspace fits nothing: what is to be touched is hidden, or has no surface: no "
      "faces. Touch a source with a surface, and render.");
    self.MessageTopic = Internals::Topic::Choice;
    return false;
  }
  double bounds[6];
  box.GetBounds(bounds);
  return self.Workspace->Fit(bounds, self.View->GetActiveCamera());
}

//--- the state ------------------------------------------------------------------------------------

const char* vtkPVHapticScene::GetState()
{
  Internals& self = *this->Internal;
  vtkHapticScene* scene = self.Scene;
  const char* waits = scene->GetDevice() ? scene->GetDevice()->GetStatusMessage() : "";
  if ((scene->IsEngaged() || self.Wanted) && scene->GetSurfaces()->IsBuilding() &&
    !scene->GetTouching() && !self.Surfaces.AreInPatches())
  {
    const double progress = scene->GetSurfaces()->GetBuildProgress();
    self.State =
      "Preparing the surfaces, " + std::to_string(static_cast<int>(100.0 * progress)) + " %";
  }
  else if (scene->IsEngaged())
  {
    self.State = scene->GetClutched() ? "Engaged, clutched: nothing is touched"
      : self.AwaitsData()             ? "Engaged, waiting for data"
      : !self.Surfaces.IsAnyShown()   ? "Engaged, waiting: nothing that can be touched is shown"
      : scene->GetTouching() ? "Engaged, touching " + std::string(self.Readings->GetTouchedName())
      : *waits               ? std::string("Engaged, ") + waits
                             : "Engaged, in free space";
  }
  else if (self.Wanted)
  {
    self.State = waits;
  }
  else
  {
    const std::string& why = self.Message.empty() ? self.ReleasedBecause : self.Message;
    self.State = why.empty() ? "Released" : "Released: " + why;
  }
  if (!self.State.empty() && self.State.back() == ' ')
  {
    self.State.pop_back(); // without a name
  }
  return self.State.c_str();
}

bool vtkPVHapticScene::GetBuilding()
{
  return this->Internal->Scene->GetSurfaces()->IsBuilding();
}

double vtkPVHapticScene::GetBuildProgress()
{
  return this->Internal->Scene->GetSurfaces()->GetBuildProgress();
}

void vtkPVHapticScene::CancelBuild()
{
  this->Internal->Scene->GetSurfaces()->CancelBuild();
}

const char* vtkPVHapticScene::GetMessage()
{
  return this->Internal->Message.c_str();
}

void vtkPVHapticScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View: " << this->Internal->View.Get() << "\n";
  os << indent << "Surfaces: " << this->Internal->Surfaces.Size() << "\n";
  os << indent << "DeviceName: " << this->Internal->DeviceName << "\n";
  os << indent << "State: " << this->GetState() << "\n";
  os << indent << "Message: " << this->Internal->Message << "\n";
  os << indent << "Scene:\n";
  this->Internal->Scene->PrintSelf(os, indent.GetNextIndent());
}
