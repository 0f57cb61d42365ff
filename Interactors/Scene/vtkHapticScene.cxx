#include "vtkHapticScene.h"

#include "haptics/Filters/ErrorText.h"
#include "haptics/Scene/HapticSceneInternals.h"
#include "haptics/Scene/Rounding.h"
#include "haptics/Scene/TipCheck.h"
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
#include "vtkHapticReadings.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkProp3D.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
/// Between two looks in virtual time at a surface in patches: as at 60 pictures a second.
constexpr int TicksPerLook = 16;

// What changes by less is rounding: a hand at rest goes to and fro by a last digit, and would be
// drawn for it again and again. Far below all that a device can do.
constexpr double LeastShift = 1e-12; // [m] in the hand
constexpr double LeastForce = 1e-9;  // [N]

bool IsWithin(double distance, const haptics::Vec3& now, const double last[3])
{
  return haptics::LargestComponent({ now[0] - last[0], now[1] - last[1], now[2] - last[2] }) <=
    distance;
}
}

vtkStandardNewMacro(vtkHapticScene);

vtkHapticScene::vtkHapticScene()
  : Internal(std::make_unique<Internals>(*this))
{
  this->Grip->SetHand(this->Internal.get());
  this->Internal->LimitsSeen = { this->Servo->GetEffectiveMaximumForce(), 0.0 };
  this->FollowParts();
}

vtkHapticScene::~vtkHapticScene()
{
  this->Follower->SetClientData(nullptr); // somebody else may hold the parts
  this->Servo->Stop();
  this->Grip->SetHand(nullptr);
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
  for (vtkObject* part : std::initializer_list<vtkObject*>{
         this->Surfaces, this->Workspace, this->Grip, this->TraceRecorder })
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
      if (part == this->Workspace)
      {
        this->TraceRecorder->SetUnitLength(this->Workspace->GetUnitLength());
        this->Landmarks->SetUnitLength(this->Workspace->GetUnitLength());
      }
      else if (part == this->Surfaces)
      {
        this->ReportBuilds();
      }
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
    if (const haptics::HapticSurface* known = this->Surfaces->GetSet().Find(actor))
    {
      return known->Id();
    }
    this->Modified();
    return this->Surfaces->GetSet().Add(std::make_unique<haptics::ActorSource>(actor));
  }
  if (vtkAssembly* const assembly = vtkAssembly::SafeDownCast(prop))
  {
    this->Modified();
    return this->Surfaces->GetSet().Add(assembly);
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
  return this->Surfaces->GetSet().Add(std::make_unique<haptics::PortSource>(geometry));
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
  const bool isRemoved = this->Surfaces->GetSet().Remove(id);
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
    return this->RemoveSurface(this->Surfaces->GetSet().FindAssembly(assembly));
  }
  vtkActor* const actor = vtkActor::SafeDownCast(prop);
  const haptics::HapticSurface* surface = this->Surfaces->GetSet().Find(actor);
  return surface && this->RemoveSurface(surface->Id());
}

void vtkHapticScene::RemoveAllSurfaces()
{
  this->Surfaces->GetSet().Clear();
  this->Modified();
}

void vtkHapticScene::FinishBuilds()
{
  // What has changed during one is built by the next.
  while (this->Surfaces->IsBuilding() && !this->Internal->IsPulling)
  {
    this->Surfaces->GetWorker().Wait();
    this->PullSurfaces();
  }
}

void vtkHapticScene::ReportBuilds()
{
  const bool isBuilding = this->Surfaces->IsBuilding();
  const double progress = this->Surfaces->GetBuildProgress();
  if (isBuilding != this->Internal->WasBuilding || progress != this->Internal->BuildProgress)
  {
    this->Internal->WasBuilding = isBuilding;
    this->Internal->BuildProgress = progress;
    this->InvokeEvent(vtkHapticScene::BuildEvent);
  }
}

bool vtkHapticScene::PullSurfaces()
{
  if (this->Internal->IsPulling)
  {
    return false; // a source that waits, for a server or a file, may let a timer's event in
  }
  haptics::BackgroundWorker& worker = this->Surfaces->GetWorker();
  const bool isInBackground = this->Surfaces->GetBackgroundBuilding();
  if (!isInBackground && this->Surfaces->IsBuilding())
  {
    worker.Wait(); // what was begun before it was turned off
  }
  worker.Collect();
  haptics::PullSettings settings;
  settings.Worker = isInBackground ? &worker : nullptr;
  const int state = this->Servo->GetState();
  settings.IsLive = state == vtkHapticServo::Running || state == vtkHapticServo::Stepping;
  settings.IsRunning = state == vtkHapticServo::Running;
  settings.IsTaken =
    this->Servo->GetLatestRecord().Generation == this->Internal->PublishedGeneration;
  settings.Now = this->Servo->GetLatestRecord().Time;
  settings.Interval = settings.Now - std::exchange(this->Internal->LastPull, settings.Now);
  settings.Scale = this->Workspace->GetScale();
  if (settings.IsLive && this->Internal->Latest)
  {
    const haptics::TickRecord& latest = this->Servo->GetLatestRecord();
    settings.Hand = haptics::HandState{ latest.Time, latest.Hip, latest.Position, latest.IsAstray,
      latest.AwaitsData };
  }
  std::vector<std::string> errors;
  haptics::SurfaceSet& surfaces = this->Surfaces->GetSet();
  surfaces.PullAssemblies();
  this->Internal->IsPulling = true;
  const bool isNew = surfaces.Pull(settings, errors);
  this->Internal->IsPulling = false;
  const bool changed = this->PullTip() || isNew;
  const int lost = this->Grip->ReleaseMissing();
  if (changed)
  {
    const std::uint64_t generation = this->Servo->PublishGodObject(
      std::make_unique<haptics::GodObject>(surfaces.TouchableSurfaces(),
        this->Internal->HasBall ? haptics::Tip::Ball : haptics::Tip::Point));
    this->Internal->PublishedGeneration = generation;
    this->Grip->OnPublished(generation);
    if (!this->Servo->IsRunning())
    {
      // All records are drained: no tick can refer to others than the last, and what the servo has
      // not taken since was dropped.
      const auto& latest = this->Internal->Latest;
      surfaces.ForgetAllBut(latest ? latest->Generation : generation);
    }
    surfaces.OnPublished(generation);
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
  this->ReportBuilds();
  return changed || surfaces.HaveMoved();
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

void vtkHapticScene::SetTipRadius(double radius)
{
  this->ForgetMessage();
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    std::ostringstream text;
    text << "The radius of the tip must be finite and not below 0 m, but is " << radius
         << "; it stays " << this->TipRadius << " m.";
    this->Fail(text.str());
    return;
  }
  if (this->TipRadius != radius)
  {
    this->TipRadius = radius;
    this->Modified();
  }
}

double vtkHapticScene::GetEffectiveTipRadius()
{
  return this->Servo->GetTipRadius();
}

/// Takes in the tip, as far as it has room. True where the god-object has to become a ball.
bool vtkHapticScene::PullTip()
{
  const std::string fault = haptics::TipCheck::Check(
    this->TipRadius, this->Surfaces->GetSet(), this->Workspace, this->GetDevice());
  this->Internal->WasTipFault = this->Internal->WasTipFault && !fault.empty();
  this->Internal->TipFault = fault;
  const double radius = fault.empty() ? this->TipRadius : 0.0;
  this->Servo->SetTipRadius(radius);
  const bool hadBall = std::exchange(this->Internal->HasBall, radius > 0.0);
  return this->Internal->HasBall && !hadBall;
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
    const bool isWaiting = this->Surfaces->GetSet().IsWaiting();
    // Patches follow the hand as they would in real time, once it is known where that is now.
    const bool isInPatches = this->Surfaces->GetSet().IsInPatches();
    const int longest = isWaiting || (isInPatches && done == 0) ? 1
      : isInPatches                                             ? TicksPerLook
                                                                : 8192;
    const int portion = std::min(n - done, longest);
    const int stepped = this->Servo->Step(portion);
    done += stepped;
    this->PullState();
    if (isWaiting || isInPatches)
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
  this->OnButtons();
  if (this->Internal->Latest) // what came before has been probed by now
  {
    this->Surfaces->GetSet().Forget(this->Internal->Latest->Generation);
  }
  this->Internal->Events.Dispatch(this);
  // After the events, so that an observer of a grip finds the actor where it was.
  const bool carried = this->Grip->Carry();
  // They are drawn as well, however the hand rests.
  const std::pair<double, double> limits(
    this->Servo->GetEffectiveMaximumForce(), this->GetEffectiveTipRadius());
  const bool isLimited = std::exchange(this->Internal->LimitsSeen, limits) != limits;
  return changed || carried || isLimited;
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

  this->TraceRecorder->OnLostTicks(this->Servo->GetReadings()->GetNumberOfLostRecords());
  for (const haptics::TickRecord& record : records)
  {
    this->Grip->OnTick(record);
    this->Internal->Events.Take(record, this->Surfaces->GetSet(), this);
    if (this->TraceRecorder->GetRecording())
    {
      this->TraceRecorder->Add(record, this->Surfaces->GetSet().Trace(record));
    }
  }
  if (!records.empty())
  {
    this->Internal->Latest = records.back();
    this->Internal->LatestCell = this->Surfaces->GetSet().Locate(records.back());
    this->Internal->Events.EndOfTicks(this->Surfaces->GetSet(), this);
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
  const haptics::UpdateStatus status = live ? latest.Status : haptics::UpdateStatus();
  const haptics::SceneCell cell = touching ? this->Internal->LatestCell : haptics::SceneCell();

  if (!live)
  {
    this->Internal->Events.Stop(this);
  }
  if (this->Probe)
  {
    this->UpdateProbe(touching);
  }

  const double largest =
    std::max(haptics::LargestComponent(latest.Hip), haptics::LargestComponent(latest.Position));
  const double shift =
    LeastShift * this->Workspace->GetScale() + haptics::CoordinateRounding * largest;
  const double step = force == haptics::Vec3{} ? 0.0 : LeastForce; // none is none
  const bool isSame = IsWithin(shift, latest.Hip, this->HapticInterfacePoint) &&
    IsWithin(shift, latest.Position, this->GodObject) && IsWithin(step, force, this->Force) &&
    touching == this->Touching;
  const bool changed = !isSame || status != this->Internal->Status ||
    this->Internal->LandmarksSeen != this->Landmarks->GetMTime();

  if (!isSame)
  {
    std::copy(latest.Hip.begin(), latest.Hip.end(), this->HapticInterfacePoint);
    std::copy(latest.Position.begin(), latest.Position.end(), this->GodObject);
    std::copy(force.begin(), force.end(), this->Force);
    this->Penetration = touching ? latest.Penetration : 0.0;
  }
  this->Touching = touching;
  this->Internal->Status = status;
  this->TouchedSurface = cell.Surface;
  this->TouchedCell = cell.Cell;

  this->Internal->LandmarksSeen = this->Landmarks->GetMTime();
  this->InvokeEvent(vtkHapticScene::StateEvent);
  return changed;
}

void vtkHapticScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const double v[3])
  { os << indent << name << ": (" << v[0] << ", " << v[1] << ", " << v[2] << ")\n"; };
  os << indent << "Engaged: " << (this->Engaged ? "yes" : "no") << "\n";
  os << indent << "TipRadius: " << this->TipRadius << " m, in effect "
     << this->GetEffectiveTipRadius() << " m\n";
  print("HapticInterfacePoint [world unit]", this->HapticInterfacePoint);
  print("GodObject [world unit]", this->GodObject);
  print("Force [N]", this->Force);
  os << indent << "Penetration [world unit]: " << this->Penetration << "\n";
  os << indent << "Touching: " << (this->Touching ? "yes" : "no") << "\n";
  os << indent << "TouchedSurface: " << this->TouchedSurface << "\n";
  os << indent << "TouchedCell: " << this->TouchedCell << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}

//--- the hand -------------------------------------------------------------------------------------

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

void vtkHapticScene::OnButtons()
{
  for (const haptics::TickRecord& tick :
    this->Internal->Events.TakePresses(this->Landmarks->GetButton()))
  {
    if (tick.NumberOfConstraints > 0)
    {
      auto probe = vtkSmartPointer<vtkHapticProbe>::New();
      this->Surfaces->GetSet().Probe(tick, probe);
      if (this->Landmarks->Drop(probe) >= 0)
      {
        this->Internal->Events.Add(
          vtkHapticScene::LandmarkEvent, this->Landmarks->GetNumberOfLandmarks());
      }
    }
  }
  const unsigned int buttons = this->Internal->Latest ? this->Internal->Latest->Buttons : 0;
  this->Workspace->OnButtons(buttons);
  this->Grip->OnButtons(buttons);
}

void vtkHapticScene::UpdateProbe(bool touching)
{
  this->Probe = vtkSmartPointer<vtkHapticProbe>::New();
  if (touching)
  {
    this->Surfaces->GetSet().Probe(*this->Internal->Latest, this->Probe);
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
  return this->Touching ? this->Surfaces->GetSet().ActiveCorners(*this->Internal->Latest)
                        : std::vector<haptics::Vec3>();
}

//--- the workspace --------------------------------------------------------------------------------

bool vtkHapticScene::FitWorkspace(vtkCamera* camera)
{
  this->ForgetMessage();
  this->PullSurfaces();
  vtkBoundingBox box;
  for (const auto& surface : this->Surfaces->GetSet().All())
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
  return this->Workspace->Fit(bounds, camera);
}

bool vtkHapticScene::EngageInView(vtkCamera* camera)
{
  if (!this->IsEngaged() && this->GetDevice() && !this->Workspace->GetChosen())
  {
    this->PullSurfaces();
    const auto& surfaces = this->Surfaces->GetSet().All();
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
    this->Internal->Reach.Check(this->Surfaces->GetSet(), this->Workspace, this->GetDevice());
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  if (!this->Internal->TipFault.empty() && !std::exchange(this->Internal->WasTipFault, true))
  {
    this->Fail(this->Internal->TipFault);
  }
}
