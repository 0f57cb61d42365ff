#include "vtkHapticScene.h"

#include "haptics/Filters/ErrorText.h"
#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkAssembly.h"
#include "vtkBoundingBox.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticDevice.h"
#include "vtkHapticGrip.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticProbe.h"
#include "vtkHapticServo.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkProp3D.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>
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

void vtkHapticScene::NoticePart(vtkObject*, unsigned long event, const char* report)
{
  std::string text;
  switch (event)
  {
    case vtkCommand::ErrorEvent:
      haptics::AppendErrorText(text, report);
      this->Fail(text);
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

//--- what is touched ------------------------------------------------------------------------------

// One overload for all props: VTK 9.6 crashes in wrapping methods of one property (Add...,
// Remove...) whose arguments are of several classes of which the module does not know the second.
int vtkHapticScene::AddSurface(vtkProp3D* prop)
{
  if (!prop)
  {
    this->Fail("There is no actor or assembly to add as a surface. Give one.");
    return -1;
  }
  if (vtkActor* const actor = vtkActor::SafeDownCast(prop))
  {
    if (const haptics::HapticSurface* known = this->Internal->Surfaces.Find(actor))
    {
      return known->Id();
    }
    this->Modified();
    return this->Internal->Surfaces.Add(std::make_unique<haptics::ActorSource>(actor));
  }
  if (vtkAssembly* const assembly = vtkAssembly::SafeDownCast(prop))
  {
    this->Modified();
    return this->Internal->Surfaces.Add(assembly);
  }
  this->Fail(std::string("A ") + prop->GetClassName() +
    " shows no surface. Give a vtkActor or a vtkAssembly; of a volume that of a contour.");
  return -1;
}

int vtkHapticScene::AddSurfaceActor(vtkActor* actor)
{
  return this->AddSurface(actor);
}

int vtkHapticScene::AddSurface(vtkAlgorithmOutput* geometry)
{
  if (!geometry)
  {
    this->Fail("There is no output port to add as a surface. Give one.");
    return -1;
  }
  this->Modified();
  return this->Internal->Surfaces.Add(std::make_unique<haptics::PortSource>(geometry));
}

int vtkHapticScene::AddSurface(vtkPolyData* geometry)
{
  if (!geometry)
  {
    this->Fail("There is no geometry to add as a surface. Give a vtkPolyData.");
    return -1;
  }
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(geometry);
  return this->AddSurface(producer->GetOutputPort());
}

bool vtkHapticScene::RemoveSurface(int id)
{
  const bool isRemoved = this->Internal->Surfaces.Remove(id);
  if (isRemoved)
  {
    this->Modified();
  }
  return isRemoved;
}

bool vtkHapticScene::RemoveSurface(vtkProp3D* prop)
{
  if (vtkAssembly* const assembly = vtkAssembly::SafeDownCast(prop))
  {
    return this->RemoveSurface(this->Internal->Surfaces.FindAssembly(assembly));
  }
  vtkActor* const actor = vtkActor::SafeDownCast(prop);
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(actor);
  return surface && this->RemoveSurface(surface->Id());
}

void vtkHapticScene::RemoveAllSurfaces()
{
  this->Internal->Surfaces.Clear();
  this->Modified();
}

int vtkHapticScene::GetNumberOfSurfaces()
{
  return static_cast<int>(this->Internal->Surfaces.All().size());
}

int vtkHapticScene::GetSurfaceId(int i)
{
  return i >= 0 && i < this->GetNumberOfSurfaces() ? this->Internal->Surfaces.All()[i]->Id() : -1;
}

vtkAssembly* vtkHapticScene::GetSurfaceAssembly(int id)
{
  return this->Internal->Surfaces.AssemblyOf(id);
}

vtkActor* vtkHapticScene::GetSurfaceActor(int id)
{
  return this->Internal->Surfaces.ActorOf(id);
}

vtkGodObjectFilter* vtkHapticScene::GetSurfaceFilter(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface ? surface->Filter() : nullptr;
}

vtkHapticProperties* vtkHapticScene::GetSurfaceProperties(int id)
{
  vtkGodObjectFilter* filter = this->GetSurfaceFilter(id);
  return filter ? filter->GetProperties() : nullptr;
}

bool vtkHapticScene::SetSurfacePropertyArray(
  int id, int property, int association, const char* name)
{
  vtkGodObjectFilter* filter = this->GetSurfaceFilter(id);
  if (filter)
  {
    filter->SetInputArrayToProcess(property, 0, 0, association, name ? name : "");
  }
  return filter != nullptr;
}

bool vtkHapticScene::SetSurfaceName(int id, const char* name)
{
  haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  if (surface)
  {
    surface->Name = name ? name : "";
  }
  return surface != nullptr;
}

std::string vtkHapticScene::GetSurfaceName(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface ? surface->Name : "";
}

bool vtkHapticScene::IsSurfaceTouchable(int id)
{
  return this->Internal->Surfaces.IsTouchable(id);
}

bool vtkHapticScene::IsSurfaceOutdated(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface && surface->IsOutdated();
}

void vtkHapticScene::SetBackgroundBuilding(bool background)
{
  if (background != this->Internal->BackgroundBuilding)
  {
    this->Internal->BackgroundBuilding = background;
    this->Modified();
  }
}

bool vtkHapticScene::GetBackgroundBuilding()
{
  return this->Internal->BackgroundBuilding;
}

bool vtkHapticScene::IsBuilding()
{
  return this->Internal->Surfaces.IsBuilding();
}

double vtkHapticScene::GetBuildProgress()
{
  return this->Internal->Surfaces.BuildProgress();
}

void vtkHapticScene::CancelBuild()
{
  this->Internal->Surfaces.CancelBuilds();
  this->TellOfBuilds();
}

void vtkHapticScene::FinishBuilds()
{
  while (this->IsBuilding()) // what has changed during one is built by the next
  {
    this->Internal->Worker.Wait();
    this->PullSurfaces();
  }
}

void vtkHapticScene::TellOfBuilds()
{
  const bool isBuilding = this->IsBuilding();
  const double progress = this->GetBuildProgress();
  if (isBuilding != this->Internal->WasBuilding || progress != this->Internal->BuildProgress)
  {
    this->Internal->WasBuilding = isBuilding;
    this->Internal->BuildProgress = progress;
    this->InvokeEvent(vtkHapticScene::BuildEvent);
  }
}

bool vtkHapticScene::PullSurfaces()
{
  if (!this->Internal->BackgroundBuilding && this->IsBuilding())
  {
    this->Internal->Worker.Wait(); // what was begun before it was turned off
  }
  this->Internal->Worker.Collect();
  haptics::PullSettings settings;
  settings.Worker = this->Internal->BackgroundBuilding ? &this->Internal->Worker : nullptr;
  const int state = this->Servo->GetState();
  settings.IsLive = state == vtkHapticServo::Running || state == vtkHapticServo::Stepping;
  settings.IsRunning = state == vtkHapticServo::Running;
  settings.IsTaken = this->Servo->GetLatestRecord().Generation == this->Internal->Published;
  settings.Now = this->Servo->GetTime();
  settings.Interval = settings.Now - std::exchange(this->Internal->LastPull, settings.Now);
  settings.Scale = this->Workspace->GetScale();
  std::vector<std::string> errors;
  haptics::SurfaceSet& surfaces = this->Internal->Surfaces;
  surfaces.PullAssemblies();
  const bool changed = surfaces.Pull(settings, errors);
  const int lost = this->Grip->LetGoOfLost();
  if (changed)
  {
    const std::uint64_t generation =
      this->Servo->PublishGodObject(std::make_unique<haptics::GodObject>(surfaces.Touched()));
    this->Internal->Published = generation;
    this->Grip->Published(generation);
    if (!this->Servo->IsRunning())
    {
      // All records are drained: no tick can refer to others than the last, and what the servo has
      // not taken since was dropped.
      const auto& latest = this->Internal->Latest;
      surfaces.ForgetAllBut(latest ? latest->Generation : generation);
    }
    surfaces.Published(generation);
  }
  this->Landmarks->Follow(surfaces);
  for (const std::string& error : errors)
  {
    this->Fail(error);
    this->IsMessageOfSurface = true;
    this->InvokeEvent(vtkHapticScene::SurfaceErrorEvent);
  }
  const bool isFaulty = surfaces.IsFaulty();
  if (this->IsMessageOfSurface && errors.empty() && this->HasFaultySurface && !isFaulty)
  {
    this->ErrorMessage.clear(); // the fault is mended, or its surface gone
    this->IsMessageOfSurface = false;
  }
  this->HasFaultySurface = isFaulty;
  if (lost >= 0)
  {
    this->Internal->Events.Add(vtkHapticScene::LetGoEvent, lost);
    this->Internal->Events.Dispatch(this); // after a grip that waits to be reported
  }
  this->TellOfBuilds();
  return changed || surfaces.HaveMoved();
}

bool vtkHapticScene::IntersectRay(const double from[3], const double direction[3], double hit[3])
{
  double normal[3];
  return this->IntersectRay(from, direction, hit, normal);
}

bool vtkHapticScene::IntersectRay(
  const double from[3], const double direction[3], double hit[3], double normal[3])
{
  const std::optional<haptics::RayHit> nearest = this->Internal->Surfaces.CastRay(
    { { from[0], from[1], from[2] } }, { { direction[0], direction[1], direction[2] } });
  for (int i = 0; nearest && i < 3; ++i)
  {
    hit[i] = from[i] + nearest->Distance * direction[i];
    normal[i] = nearest->Normal[static_cast<std::size_t>(i)];
  }
  return nearest.has_value();
}

//--- the run --------------------------------------------------------------------------------------

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
  // After the events, so that an observer of a grip finds the actor where it was.
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
      this->TraceRecorder->Add(record, this->Internal->Surfaces.Trace(record));
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

void vtkHapticScene::WarnOfReach()
{
  const std::string warning =
    this->Internal->Reach.Check(this->Internal->Surfaces, this->Workspace, this->GetDevice());
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
}

void vtkHapticScene::SetUnitLength(double metres)
{
  this->ForgetMessage();
  this->Workspace->SetUnitLength(metres);
  const double unitLength = this->GetUnitLength();
  this->TraceRecorder->SetUnitLength(unitLength);
  this->Landmarks->SetUnitLength(unitLength);
}

double vtkHapticScene::GetUnitLength()
{
  return this->Workspace->GetUnitLength();
}
