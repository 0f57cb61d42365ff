#include "vtkHapticScene.h"

#include "haptics/Filters/ErrorText.h"
#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkBoundingBox.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkHapticDevice.h"
#include "vtkHapticGrip.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticProbe.h"
#include "vtkHapticServo.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkHapticScene);

vtkHapticScene::vtkHapticScene()
  : Internal(std::make_unique<Internals>())
{
  this->Workspace->SetServo(this->Servo);
  this->Grip->SetScene(this);
  this->FollowParts();
}

vtkHapticScene::~vtkHapticScene()
{
  this->Follower->SetClientData(nullptr); // somebody else may hold the parts
  this->Servo->Stop();
  this->Grip->SetScene(nullptr);
}

void vtkHapticScene::FollowParts()
{
  this->Follower->SetClientData(this);
  this->Follower->SetCallback(
    [](vtkObject* part, unsigned long event, void* scene, void* report)
    {
      if (scene)
      {
        static_cast<vtkHapticScene*>(scene)->NoticePart(
          part, event, static_cast<const char*>(report));
      }
    });
  this->Servo->AddObserver(vtkCommand::ErrorEvent, this->Follower);
  for (vtkObject* part :
    std::initializer_list<vtkObject*>{ this->Workspace, this->Grip, this->TraceRecorder })
  {
    for (const unsigned long event :
      { vtkCommand::ErrorEvent, vtkCommand::WarningEvent, vtkCommand::ModifiedEvent })
    {
      part->AddObserver(event, this->Follower);
    }
  }
  this->Workspace->AddObserver(vtkHapticWorkspace::ClutchEvent, this->Follower);
  this->TraceRecorder->AddObserver(vtkCommand::StartEvent, this->Follower);
  this->TraceRecorder->AddObserver(vtkCommand::EndEvent, this->Follower);
}

void vtkHapticScene::NoticePart(vtkObject* part, unsigned long event, const char* report)
{
  std::string text;
  switch (event)
  {
    case vtkCommand::ErrorEvent:
      haptics::AppendErrorText(text, report);
      if (part == this->Servo)
      {
        vtkErrorMacro(<< text); // what it means for a call of the scene, that call says
      }
      else
      {
        this->Fail(text);
      }
      break;
    case vtkCommand::WarningEvent:
      haptics::AppendErrorText(text, report);
      vtkWarningMacro(<< text);
      break;
    case vtkHapticWorkspace::ClutchEvent:
      if (this->Workspace->GetClutched())
      {
        this->Grip->LetGo();
      }
      this->PullSurfaces();
      break;
    case vtkCommand::StartEvent:
    case vtkCommand::EndEvent:
      this->PullState(); // what came before belongs to the trace before
      break;
    default:
      this->Modified();
  }
}

void vtkHapticScene::Fail(const std::string& message)
{
  this->ErrorMessage = message;
  this->IsMessageOfSurface = false;
  vtkErrorMacro(<< message);
}

void vtkHapticScene::ForgetMessage()
{
  if (!this->IsMessageOfSurface)
  {
    this->ErrorMessage.clear();
  }
}

void vtkHapticScene::SetDevice(vtkHapticDevice* device)
{
  if (device != this->GetDevice())
  {
    this->Release();
    this->Servo->SetDevice(device);
    this->Modified();
  }
}

vtkHapticDevice* vtkHapticScene::GetDevice()
{
  return this->Servo->GetDevice();
}

void vtkHapticScene::SetStiffness(double stiffness)
{
  this->Servo->SetStiffness(stiffness);
}

double vtkHapticScene::GetStiffness()
{
  return this->Servo->GetStiffness();
}

bool vtkHapticScene::Engage()
{
  if (this->IsEngaged())
  {
    return true;
  }
  this->ForgetMessage();
  vtkHapticDevice* device = this->GetDevice();
  if (!device)
  {
    this->Fail("There is no device to engage. Call SetDevice() first.");
    return false;
  }
  if (!this->OpenDevice(device))
  {
    return false;
  }
  this->PullState();
  this->Grip->LetGo(); // who stepped has ended with that
  this->PullSurfaces();
  this->WarnOfReach();
  if (!this->Servo->Start())
  {
    this->ErrorMessage = this->Servo->GetErrorMessage();
    return false;
  }
  this->Engaged = true;
  this->Modified();
  return true;
}

bool vtkHapticScene::OpenDevice(vtkHapticDevice* device)
{
  if (device->HasChanged())
  {
    device->Close();
  }
  if (device->IsOpen() || device->Open())
  {
    return true;
  }
  // One that loads firmware or has to be homed takes its time, and says what it waits for.
  const bool isOpening = device->GetErrorMessage()[0] == '\0';
  this->Fail(
    std::string(isOpening ? "The device is not ready yet: " : "The device could not be opened: ") +
    device->GetStatusMessage());
  return false;
}

void vtkHapticScene::Release()
{
  if (this->Engaged || this->Servo->GetState() == vtkHapticServo::Stepping)
  {
    this->Engaged = false;
    this->Servo->Stop();
    this->PullState();
    this->Modified();
  }
}

bool vtkHapticScene::IsEngaged()
{
  return this->Engaged;
}

bool vtkHapticScene::Update()
{
  const bool moved = this->PullState();
  const bool changed = this->PullSurfaces();
  if (this->Engaged)
  {
    this->WarnOfReach(); // of what has been built or added meanwhile
  }
  return moved || changed;
}

int vtkHapticScene::Step(int n)
{
  this->ForgetMessage();
  if (this->Engaged)
  {
    this->Fail("Step() is for virtual time, but the hand is engaged in real time. Call Release() "
               "first.");
    return 0;
  }
  if (n < 1)
  {
    this->Fail("Step(" + std::to_string(n) + ") does nothing. Give 1 or more ticks.");
    return 0;
  }
  vtkHapticDevice* device = this->GetDevice();
  if (!device)
  {
    this->Fail("There is no device to step. Call SetDevice() first.");
    return 0;
  }
  if (!this->OpenDevice(device))
  {
    return 0;
  }
  this->PullState();
  this->PullSurfaces();
  this->FinishBuilds();
  this->WarnOfReach();
  int done = 0;
  while (done < n)
  {
    // The servo keeps 16,384 records: drain them before they are lost.
    const bool isWaiting = this->Internal->Surfaces.IsWaiting();
    const int portion = isWaiting ? 1 : std::min(n - done, 8192);
    const int stepped = this->Servo->Step(portion);
    done += stepped;
    this->PullState();
    if (isWaiting)
    {
      this->PullSurfaces(); // it takes part as soon as it can
      this->FinishBuilds();
    }
    if (stepped < portion)
    {
      this->ErrorMessage = this->Servo->GetErrorMessage();
      break;
    }
  }
  return done;
}

bool vtkHapticScene::PullState()
{
  this->Servo->Update();
  this->PullRecords();
  // As of the servo's own last look, so that its message is there.
  if (this->Engaged && this->Servo->GetState() != vtkHapticServo::Running)
  {
    this->Engaged = false;
    this->ErrorMessage = this->Servo->GetErrorMessage();
    this->Internal->Events.Add(vtkHapticScene::FaultEvent, haptics::SceneEvents::NoData);
  }
  this->NoticeDevice();
  const bool changed = this->TakeState();
  this->ObeyButtons();
  if (this->Internal->Latest) // what came before has been probed by now
  {
    this->Internal->Surfaces.Forget(this->Internal->Latest->Generation);
  }
  this->Internal->Events.Dispatch(this);
  // After the events, so that who is told of a grip finds the actor where it was.
  const bool carried = this->Grip->Carry();
  return changed || carried;
}

void vtkHapticScene::NoticeDevice()
{
  const int state = this->GetDevice() ? this->GetDevice()->GetState() : vtkHapticDevice::Closed;
  if (state != this->Internal->DeviceState)
  {
    this->Internal->DeviceState = state;
    this->Internal->Events.Add(vtkHapticScene::DeviceStateEvent, state);
  }
}

void vtkHapticScene::PullRecords()
{
  std::vector<haptics::TickRecord>& records = this->Internal->Drained;
  records.clear();
  this->Servo->DrainRecords(records);

  this->TraceRecorder->CountLost(this->Servo->GetNumberOfLostRecords());
  for (const haptics::TickRecord& record : records)
  {
    this->Grip->Look(record);
    this->Internal->Events.Take(record, this->Internal->Surfaces, this);
    if (this->TraceRecorder->GetRecording())
    {
      const haptics::SceneCell cell = this->Internal->Surfaces.Locate(record);
      this->TraceRecorder->Add(record, cell.Surface, cell.Cell);
    }
  }
  if (!records.empty())
  {
    this->Internal->Latest = records.back();
    this->Internal->LatestCell = this->Internal->Surfaces.Locate(records.back());
    this->Internal->Events.EndOfTicks(this->Internal->Surfaces, this);
  }
}

bool vtkHapticScene::TakeState()
{
  if (!this->Internal->Latest)
  {
    return false;
  }
  const haptics::TickRecord& latest = *this->Internal->Latest;
  const int state = this->Servo->GetState();
  const bool live = state == vtkHapticServo::Running || state == vtkHapticServo::Stepping;
  const haptics::Vec3 force = live ? latest.WorldForce : haptics::Vec3{};
  const bool touching = live && latest.NumberOfConstraints > 0;
  const bool squeezed = live && latest.Status == haptics::UpdateStatus::Squeezed;
  const bool overloaded = live && latest.Status == haptics::UpdateStatus::Overloaded;
  const haptics::SceneCell cell = touching ? this->Internal->LatestCell : haptics::SceneCell();

  if (!live)
  {
    this->Internal->Events.Stop(this);
  }
  if (this->Probe)
  {
    this->UpdateProbe(touching);
  }

  const bool changed =
    !std::equal(latest.Hip.begin(), latest.Hip.end(), this->HapticInterfacePoint) ||
    !std::equal(latest.Position.begin(), latest.Position.end(), this->GodObject) ||
    !std::equal(force.begin(), force.end(), this->Force) || touching != this->Touching ||
    squeezed != this->Squeezed || overloaded != this->Overloaded ||
    this->Internal->LandmarksSeen != this->Landmarks->GetMTime();

  std::copy(latest.Hip.begin(), latest.Hip.end(), this->HapticInterfacePoint);
  std::copy(latest.Position.begin(), latest.Position.end(), this->GodObject);
  std::copy(force.begin(), force.end(), this->Force);
  this->Penetration = touching ? latest.Penetration : 0.0;
  this->Touching = touching;
  this->Squeezed = squeezed;
  this->Overloaded = overloaded;
  this->TouchedSurface = cell.Surface;
  this->TouchedCell = cell.Cell;

  this->Internal->LandmarksSeen = this->Landmarks->GetMTime();
  this->InvokeEvent(vtkHapticScene::StateEvent);
  return changed;
}

vtkHapticServo* vtkHapticScene::GetServo()
{
  return this->Servo;
}

vtkHapticWorkspace* vtkHapticScene::GetWorkspace()
{
  return this->Workspace;
}

vtkHapticGrip* vtkHapticScene::GetGrip()
{
  return this->Grip;
}

vtkHapticTraceRecorder* vtkHapticScene::GetTraceRecorder()
{
  return this->TraceRecorder;
}

void vtkHapticScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const vtkIndent next = indent.GetNextIndent();
  const auto print = [&](const char* name, const double v[3])
  { os << indent << name << ": (" << v[0] << ", " << v[1] << ", " << v[2] << ")\n"; };
  os << indent << "Engaged: " << (this->Engaged ? "yes" : "no") << "\n";
  os << indent << "Surfaces: " << this->GetNumberOfSurfaces() << "\n";
  for (const auto& surface : this->Internal->Surfaces.All())
  {
    os << next << surface->Id() << ": " << (surface->Moves() ? "actor" : "geometry") << ", "
       << (surface->Touched() ? "touchable" : "not touchable") << "\n";
  }
  print("HapticInterfacePoint [world unit]", this->HapticInterfacePoint);
  print("GodObject [world unit]", this->GodObject);
  print("Force [N]", this->Force);
  os << indent << "Penetration [world unit]: " << this->Penetration << "\n";
  os << indent << "Touching: " << (this->Touching ? "yes" : "no") << "\n";
  os << indent << "Squeezed: " << (this->Squeezed ? "yes" : "no") << "\n";
  os << indent << "Overloaded: " << (this->Overloaded ? "yes" : "no") << "\n";
  os << indent << "TouchedSurface: " << this->TouchedSurface << "\n";
  os << indent << "TouchedCell: " << this->TouchedCell << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  const auto printPart = [&](const char* name, vtkObject* part)
  {
    os << indent << name << ":\n";
    part->PrintSelf(os, next);
  };
  printPart("Workspace", this->Workspace);
  printPart("Grip", this->Grip);
  printPart("TraceRecorder", this->TraceRecorder);
  printPart("Servo", this->Servo);
}

//--- the hand -------------------------------------------------------------------------------------

vtkHapticLandmarks* vtkHapticScene::GetLandmarks()
{
  return this->Landmarks;
}

int vtkHapticScene::DropLandmark()
{
  this->ForgetMessage();
  if (!this->Touching)
  {
    this->Fail("A landmark needs a contact, and nothing is touched. Touch a surface first.");
    return -1;
  }
  return this->Landmarks->Drop(this->GetProbe());
}

void vtkHapticScene::ObeyButtons()
{
  for (const haptics::TickRecord& tick : this->Internal->Events.TakePresses(this->LandmarkButton))
  {
    if (tick.NumberOfConstraints > 0)
    {
      auto probe = vtkSmartPointer<vtkHapticProbe>::New();
      this->Internal->Surfaces.Probe(tick, probe);
      if (this->Landmarks->Drop(probe) >= 0)
      {
        this->Internal->Events.Add(
          vtkHapticScene::LandmarkEvent, this->Landmarks->GetNumberOfLandmarks());
      }
    }
  }
  const unsigned int buttons = this->Internal->Latest ? this->Internal->Latest->Buttons : 0;
  this->Workspace->ObeyButtons(buttons);
  this->Grip->ObeyButtons(buttons);
}

bool vtkHapticScene::IsHandThere()
{
  const int state = this->Servo->GetState();
  return (state == vtkHapticServo::Running || state == vtkHapticServo::Stepping) &&
    this->Internal->Latest && !this->Workspace->GetClutched();
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

const std::vector<haptics::TickRecord>& vtkHapticScene::GetNewTicks()
{
  return this->Internal->Drained;
}

std::vector<haptics::Vec3> vtkHapticScene::GetActiveCorners()
{
  return this->Touching ? this->Internal->Surfaces.ActiveCorners(*this->Internal->Latest)
                        : std::vector<haptics::Vec3>();
}

//--- the workspace --------------------------------------------------------------------------------

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
  return this->Workspace->Fit(bounds, camera);
}

bool vtkHapticScene::EngageInView(vtkCamera* camera)
{
  if (!this->IsEngaged() && this->GetDevice() && !this->Workspace->GetChosen())
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
  const double scale = this->Workspace->GetScale();
  const auto& surfaces = this->Internal->Surfaces.All();
  const auto found = std::find_if(surfaces.begin(), surfaces.end(),
    [limit = largestRatio * reach * scale](const auto& surface)
    {
      const auto touched = surface->Touched();
      return touched && 2.0 * touched->Radius() > limit;
    });
  const bool isTooLarge = !this->Workspace->GetChosen() && reach > 0.0 && found != surfaces.end();
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
