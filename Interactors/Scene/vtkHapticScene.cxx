#include "vtkHapticScene.h"

#include "haptics/Filters/ErrorText.h"
#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkActor.h"
#include "vtkHapticDevice.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticServo.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkHapticScene);

vtkHapticScene::vtkHapticScene()
  : Internal(std::make_unique<Internals>())
{
  this->ServoObserver =
    this->Servo->AddObserver(vtkCommand::ErrorEvent, this, &vtkHapticScene::PassServoErrorOn);
}

vtkHapticScene::~vtkHapticScene()
{
  this->Servo->RemoveObserver(this->ServoObserver); // somebody else may hold it
  this->Servo->Stop();
}

void vtkHapticScene::PassServoErrorOn(vtkObject*, unsigned long, void* report)
{
  std::string text;
  haptics::AppendErrorText(text, static_cast<const char*>(report));
  vtkErrorMacro(<< text);
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
  this->LetGo(); // who stepped has ended with that
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
  const bool carried = this->CarryGripped();
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

  const vtkIdType lost = this->Servo->GetNumberOfLostRecords();
  if (this->Recording)
  {
    // The servo counts from 0 again at each start.
    this->LostTicks += lost >= this->LostBefore ? lost - this->LostBefore : lost;
  }
  this->LostBefore = lost;

  haptics::TraceRecorder& recorder = this->Internal->Recorder;
  for (const haptics::TickRecord& record : records)
  {
    this->Internal->Grip.Look(record, this->Internal->Surfaces);
    if (this->Recording && recorder.Size() >= this->MaximumTraceTicks)
    {
      this->Recording = false;
      vtkWarningMacro("The trace is full with " << recorder.Size()
                                                << " ticks; recording has stopped. Raise "
                                                   "MaximumTraceTicks to record longer.");
    }
    this->Internal->Events.Take(record, this->Internal->Surfaces, this);
    if (this->Recording)
    {
      const haptics::SceneCell cell = this->Internal->Surfaces.Locate(record);
      recorder.Add({ record, cell.Surface, cell.Cell });
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

void vtkHapticScene::StartRecording()
{
  this->PullState(); // what came before is not recorded
  this->Internal->Recorder.Clear();
  this->LostTicks = 0;
  this->Recording = true;
}

void vtkHapticScene::StopRecording()
{
  this->PullState();
  this->Recording = false;
}

vtkPolyData* vtkHapticScene::GetTrace()
{
  this->Internal->Recorder.Write(this->Trace);
  return this->Trace;
}

vtkIdType vtkHapticScene::GetNumberOfLostTicks()
{
  return this->LostTicks;
}

vtkHapticServo* vtkHapticScene::GetServo()
{
  return this->Servo;
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
  os << indent << "GrippedSurface: " << this->GetGrippedSurface() << "\n";
  os << indent << "Recording: " << (this->Recording ? "yes" : "no") << "\n";
  os << indent << "Recorded ticks: " << this->Internal->Recorder.Size() << " of "
     << this->MaximumTraceTicks << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "WorkspaceTransform:\n";
  this->Workspace->PrintSelf(os, next);
  os << indent << "Servo:\n";
  this->Servo->PrintSelf(os, next);
}
