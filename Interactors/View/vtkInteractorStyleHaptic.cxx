#include "vtkInteractorStyleHaptic.h"

#include "haptics/Filters/LengthUnit.h"
#include "haptics/Servo/EmergencyStop.h"
#include "haptics/View/TypedKey.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticDevice.h"
#include "vtkHapticGrip.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkHapticView.h"
#include "vtkHapticWorkspace.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkTimerLog.h"
#include "vtkVersion.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkInteractorStyleHaptic);

namespace
{
constexpr double LeastRest = 0.004; // [s] between two pictures, for the events
constexpr double RestShare = 0.15;  // of the time that the last picture took

constexpr double RefusalTime = 5.0; // [s] for which a reason can be read
constexpr double NoticeTime = 2.0;  // [s] for which a few words can be read

constexpr const char* CommandsOfVtk = "3aefjlpqrsuwAEFJLPQRSUW"; // that change what is drawn

constexpr const char* MouseHint = "Move the mouse over the surface.\n"
                                  "Hold the space bar to press; move to stroke.\n"
                                  "The wheel sets how deep. Drag to turn.\n"
                                  "? lists all keys, q quits.";
constexpr const char* MouseHelp = "move         hand, over the surface under the cursor\n"
                                  "space held   press; move to stroke (or Shift + left button)\n"
                                  "wheel        how deep; alone: press, and stay\n"
                                  "Ctrl+wheel   zoom\n"
                                  "\n";
constexpr const char* KeysHelp = "drag         turn the camera (Shift: pan, Ctrl: roll)\n"
                                 "h            engage or release the hand\n"
                                 "v            fit the hand's space to the view\n"
                                 "b            trail\n"
                                 "d   z        drop a landmark, take the last one away\n"
                                 "c            clutch: let go, and take hold again\n"
                                 "x            grip what is touched and carry it, let it go\n"
                                 "+   -   0    the hand goes farther, less far, reset\n"
                                 "o            hand occluded or seen through the surface\n"
                                 "t   g        touched triangles, colours of the force\n"
                                 "r   f        reset the camera, fly to the cursor\n"
                                 "w   s        wireframe, surface\n"
                                 "?   F1       this help\n"
                                 "q   e        quit";
}

vtkInteractorStyleHaptic::vtkInteractorStyleHaptic()
  : Scene(vtkSmartPointer<vtkHapticScene>::New())
{
  this->View->SetScene(this->Scene);
  this->InteractorCallback->SetClientData(this);
  this->InteractorCallback->SetCallback(vtkInteractorStyleHaptic::OnInteractorEvent);
  this->ClippingRangeCallback->SetClientData(this);
  this->ClippingRangeCallback->SetCallback(vtkInteractorStyleHaptic::OnClippingRangeReset);
}

vtkInteractorStyleHaptic::~vtkInteractorStyleHaptic()
{
  this->Watch(nullptr);
  this->SetInteractor(nullptr);
}

void vtkInteractorStyleHaptic::SetScene(vtkHapticScene* scene)
{
  if (scene && this->Scene == scene)
  {
    return;
  }
  this->Scene =
    scene ? vtkSmartPointer<vtkHapticScene>(scene) : vtkSmartPointer<vtkHapticScene>::New();
  this->View->SetScene(this->Scene);
  this->Modified();
}

vtkHapticScene* vtkInteractorStyleHaptic::GetScene()
{
  return this->Scene;
}

vtkHapticView* vtkInteractorStyleHaptic::GetView()
{
  return this->View;
}

void vtkInteractorStyleHaptic::SetMaximumFrameRate(double rate)
{
  if (!std::isfinite(rate))
  {
    vtkErrorMacro("A frame rate of " << rate << " means nothing; " << this->MaximumFrameRate
                                     << " stays. Give 1 to 240.");
    return;
  }
  rate = std::clamp(rate, 1.0, 240.0);
  if (rate != this->MaximumFrameRate)
  {
    this->MaximumFrameRate = rate;
    if (this->TimerId)
    {
      this->StopUpdateTimer();
      this->StartUpdateTimer();
    }
    this->Modified();
  }
}

void vtkInteractorStyleHaptic::SetInteractor(vtkRenderWindowInteractor* interactor)
{
  if (interactor == this->Interactor)
  {
    return;
  }
  if (this->Interactor)
  {
    this->StopUpdateTimer();
    this->Interactor->RemoveObserver(this->InteractorCallback);
  }
  this->Superclass::SetInteractor(interactor);
  if (interactor)
  {
    // Before the style's own observers, which would take the timer for the trackball's.
    const float before = static_cast<float>(this->Priority) + 1.0f;
    for (const unsigned long event : { vtkCommand::TimerEvent, vtkCommand::ExitEvent,
           vtkCommand::DeleteEvent, vtkCommand::ModifiedEvent, vtkCommand::RenderEvent })
    {
      interactor->AddObserver(event, this->InteractorCallback, before);
    }
    this->StartUpdateTimer();
  }
}

void vtkInteractorStyleHaptic::OnInteractorEvent(
  vtkObject*, unsigned long event, void* clientData, void* callData)
{
  auto* self = static_cast<vtkInteractorStyleHaptic*>(clientData);
  switch (event)
  {
    case vtkCommand::TimerEvent:
    {
      const int timer = callData ? *static_cast<int*>(callData) : 0;
      if (timer == 0 || (timer != self->TimerId && timer != self->SleepingTimerId))
      {
        break;
      }
      if (timer == self->SleepingTimerId)
      {
        self->StartUpdateTimer(); // where the event loop runs again
      }
      else if (haptics::EmergencyStop::CountInterrupts() != self->InterruptsBefore)
      {
        self->Interrupted = true;
        self->Interactor->ExitCallback();
      }
      else
      {
        self->UpdateScene();
      }
      // The trackball takes any timer for its own and would go on turning the camera. Last, as
      // a render sends this command events that clear the flag.
      self->InteractorCallback->SetAbortFlag(1);
      break;
    }
    case vtkCommand::ExitEvent:
      self->Exit();
      break;
    case vtkCommand::DeleteEvent:
      self->Scene->Release();
      self->TimerId = 0;
      self->SleepingTimerId = 0;
      break;
    default:
      self->StartUpdateTimer();
  }
}

void vtkInteractorStyleHaptic::Exit()
{
  // VTK does not bear that a timer is destroyed while it fires, as it may do now.
  this->SleepingTimerId = this->TimerId;
  this->TimerId = 0;
  this->Scene->Release();
  // As the interactor does by itself where nobody observes ExitEvent.
  this->Interactor->TerminateApp();
}

void vtkInteractorStyleHaptic::StartUpdateTimer()
{
  // On some systems timers belong to the window, which is there once the interactor is
  // initialised; the interactor's Modified and Render events bring us back here then.
  if (!this->TimerId && !this->StartingTimer && this->Interactor &&
    this->Interactor->GetInitialized() && !this->Interactor->GetDone())
  {
    haptics::EmergencyStop::Install();
    this->InterruptsBefore = haptics::EmergencyStop::CountInterruptsBeforeLoop();
    std::swap(this->TimerId, this->SleepingTimerId);
    if (this->TimerId)
    {
      return; // the event loop has started again
    }
    // Creating a timer modifies the interactor, whose event comes back here.
    this->StartingTimer = true;
    const double period = std::ceil(1000.0 / this->MaximumFrameRate);
    this->TimerId =
      std::max(0, this->Interactor->CreateRepeatingTimer(static_cast<unsigned long>(period)));
    this->StartingTimer = false;
  }
}

void vtkInteractorStyleHaptic::StopUpdateTimer()
{
  for (int* timer : { &this->TimerId, &this->SleepingTimerId })
  {
    if (*timer)
    {
      this->Interactor->DestroyTimer(*timer);
      *timer = 0;
    }
  }
}

vtkRenderer* vtkInteractorStyleHaptic::FindRenderer()
{
  vtkRenderWindow* window = this->Interactor ? this->Interactor->GetRenderWindow() : nullptr;
  if (!window)
  {
    return nullptr;
  }
  vtkProp* prop = this->View->GetGodObjectActor();
  vtkRendererCollection* renderers = window->GetRenderers();
  vtkCollectionSimpleIterator iterator;
  renderers->InitTraversal(iterator);
  while (vtkRenderer* renderer = renderers->GetNextRenderer(iterator))
  {
    if (renderer->HasViewProp(prop))
    {
      return renderer;
    }
  }
  return renderers->GetFirstRenderer();
}

void vtkInteractorStyleHaptic::Watch(vtkRenderer* renderer)
{
  if (renderer == this->WatchedRenderer)
  {
    return;
  }
  if (this->WatchedRenderer)
  {
    this->WatchedRenderer->RemoveObserver(this->ClippingRangeCallback);
  }
  this->WatchedRenderer = renderer;
  if (renderer)
  {
    renderer->AddObserver(vtkCommand::ResetCameraClippingRangeEvent, this->ClippingRangeCallback);
  }
}

void vtkInteractorStyleHaptic::OnClippingRangeReset(
  vtkObject* caller, unsigned long, void* clientData, void*)
{
  auto* self = static_cast<vtkInteractorStyleHaptic*>(clientData);
  self->View->GetGodObjectActor()->IncludeInClippingRange(vtkRenderer::SafeDownCast(caller));
}

void vtkInteractorStyleHaptic::ConnectDevice()
{
  vtkHapticDevice* device = this->Scene->GetDevice();
  if (device && this->Interactor && device->UsesView() && !device->HasView())
  {
    device->ConnectView(this->Interactor, this->Scene);
  }
}

void vtkInteractorStyleHaptic::ToggleHelp()
{
  vtkHapticOverlay* overlay = this->View->GetOverlay();
  vtkRenderer* renderer = this->FindRenderer();
  if (!renderer)
  {
    return;
  }
  if (!renderer->HasViewProp(overlay))
  {
    renderer->AddViewProp(overlay);
  }
  vtkHapticDevice* device = this->Scene->GetDevice();
  const bool mouse = device && device->UsesView();
  overlay->SetHelp(std::string(mouse ? MouseHelp : "") + KeysHelp);
  overlay->SetShowHelp(!overlay->GetShowHelp());
}

void vtkInteractorStyleHaptic::ToggleLook(char key)
{
  vtkGodObjectActor* actor = this->View->GetGodObjectActor();
  switch (key)
  {
    case 'o':
    case 'O':
      actor->SetSeeThrough(!actor->GetSeeThrough());
      this->Notify(actor->GetSeeThrough() ? "the hand is seen through the surface"
                                          : "the surface hides the hand");
      break;
    case 't':
    case 'T':
      actor->SetShowActiveTriangles(!actor->GetShowActiveTriangles());
      this->Notify(
        actor->GetShowActiveTriangles() ? "touched triangles: on" : "touched triangles: off");
      break;
    default:
      actor->SetShowLegend(!actor->GetShowLegend());
      actor->SetColorForceByMagnitude(actor->GetShowLegend());
      this->Notify(
        actor->GetShowLegend() ? "colours of the force: on" : "colours of the force: off");
  }
}

bool vtkInteractorStyleHaptic::UpdateScene()
{
  this->ConnectDevice();
  this->MustRender = this->Scene->Update() || this->MustRender;
  this->ShowStatus();
  vtkRenderer* renderer = this->FindRenderer();
  this->Watch(renderer);
  if (!this->MustRender || !renderer || !this->Interactor->GetInitialized() ||
    vtkTimerLog::GetUniversalTime() < this->RestsUntil)
  {
    return false;
  }
  this->MustRender = false;
  this->Render(renderer);
  return true;
}

void vtkInteractorStyleHaptic::Render(vtkRenderer* renderer)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  renderer->ResetCameraClippingRange();
  ++this->NumberOfRenders;
  this->Interactor->Render();
  // Before VTK 9.4 the X11 event loop looks at one event, then at the timers. Without a rest a
  // timer that draws for longer than its period would let in one event a picture.
  const double end = vtkTimerLog::GetUniversalTime();
  this->RestsUntil = end + std::max(LeastRest, RestShare * (end - begin));
}

void vtkInteractorStyleHaptic::RenderSoon()
{
  if (this->TimerId)
  {
    this->MustRender = true;
  }
  else
  {
    this->Interactor->Render();
  }
}

template <typename Function>
void vtkInteractorStyleHaptic::DrawLater(Function handle)
{
  if (!this->TimerId || !this->Interactor->GetEnableRender())
  {
    handle();
    return;
  }
  // The trackball draws at every event; of a turn of the wheel that is one picture a notch, which
  // on a large surface goes on long after the wheel has stopped.
  vtkSmartPointer<vtkRenderWindowInteractor> interactor = this->Interactor;
  vtkCamera* camera = this->CurrentRenderer ? this->CurrentRenderer->GetActiveCamera() : nullptr;
  const vtkMTimeType before = camera ? camera->GetMTime() : 0;
  const int state = this->State;
  interactor->EnableRenderOff();
  handle();
  interactor->EnableRenderOn();
  vtkCamera* after = this->CurrentRenderer ? this->CurrentRenderer->GetActiveCamera() : nullptr;
  this->MustRender = this->MustRender || state != this->State || after != camera ||
    (after && after->GetMTime() != before);
}

void vtkInteractorStyleHaptic::OnMouseMove()
{
  this->DrawLater([this] { this->Superclass::OnMouseMove(); });
}

void vtkInteractorStyleHaptic::OnLeftButtonDown()
{
  this->DrawLater([this] { this->Superclass::OnLeftButtonDown(); });
}

void vtkInteractorStyleHaptic::OnLeftButtonUp()
{
  this->DrawLater([this] { this->Superclass::OnLeftButtonUp(); });
}

void vtkInteractorStyleHaptic::OnMiddleButtonDown()
{
  this->DrawLater([this] { this->Superclass::OnMiddleButtonDown(); });
}

void vtkInteractorStyleHaptic::OnMiddleButtonUp()
{
  this->DrawLater([this] { this->Superclass::OnMiddleButtonUp(); });
}

void vtkInteractorStyleHaptic::OnRightButtonDown()
{
  this->DrawLater([this] { this->Superclass::OnRightButtonDown(); });
}

void vtkInteractorStyleHaptic::OnRightButtonUp()
{
  this->DrawLater([this] { this->Superclass::OnRightButtonUp(); });
}

void vtkInteractorStyleHaptic::OnMouseWheelForward()
{
  this->DrawLater([this] { this->Superclass::OnMouseWheelForward(); });
}

void vtkInteractorStyleHaptic::OnMouseWheelBackward()
{
  this->DrawLater([this] { this->Superclass::OnMouseWheelBackward(); });
}

void vtkInteractorStyleHaptic::Engage()
{
  if (this->Scene->IsEngaged())
  {
    this->Scene->Release();
    return;
  }
  vtkRenderer* renderer = this->FindRenderer();
  if (!this->Scene->EngageInView(renderer ? renderer->GetActiveCamera() : nullptr))
  {
    this->Refuse(this->Scene->GetErrorMessage());
  }
}

void vtkInteractorStyleHaptic::DropLandmark()
{
  if (this->Scene->GetTouching())
  {
    this->Scene->DropLandmark();
  }
  else
  {
    this->Refuse("A landmark lies where the hand touches: touch a surface, then press d.");
  }
}

void vtkInteractorStyleHaptic::Refuse(const std::string& reason)
{
  this->Notice = reason;
  this->NoticedUntil = vtkTimerLog::GetUniversalTime() + RefusalTime;
}

/// Says what a key has done that is not seen at once, or not everywhere.
void vtkInteractorStyleHaptic::Notify(const std::string& what)
{
  this->Notice = what;
  this->NoticedUntil = vtkTimerLog::GetUniversalTime() + NoticeTime;
  this->ShowStatus();
}

std::string vtkInteractorStyleHaptic::DescribeState()
{
  if (vtkTimerLog::GetUniversalTime() < this->NoticedUntil)
  {
    return this->Notice;
  }
  vtkHapticDevice* device = this->Scene->GetDevice();
  const char* waits = device ? device->GetStatusMessage() : "";
  const int state = this->Scene->GetServo()->GetState();
  const bool isLive = state == vtkHapticServo::Running || state == vtkHapticServo::Stepping;
  if (this->Scene->GetSurfaces()->IsBuilding())
  {
    const int share = static_cast<int>(100.0 * this->Scene->GetSurfaces()->GetBuildProgress());
    const int filled = share / 5;
    return "preparing the surfaces  [" + std::string(filled, '#') + std::string(20 - filled, '.') +
      "]  " + std::to_string(share) + " %";
  }
  if (!isLive)
  {
    return *waits ? std::string("released: ") + waits : "released: h engages the hand";
  }
  if (this->Scene->GetClutched())
  {
    return "clutched: c takes hold again";
  }
  if (this->Scene->GetGrip()->GetSurface() >= 0)
  {
    return "carrying: x lets go";
  }
  if (this->Scene->GetTouching())
  {
    return "touching";
  }
  return *waits ? waits : "in free space";
}

void vtkInteractorStyleHaptic::ShowStatus()
{
  vtkRenderer* renderer = this->FindRenderer();
  if (!renderer)
  {
    return;
  }
  vtkHapticOverlay* overlay = this->View->GetOverlay();
  if (!renderer->HasViewProp(overlay))
  {
    return;
  }
  this->HasTouched = this->HasTouched || this->Scene->GetTouching();
  vtkHapticDevice* device = this->Scene->GetDevice();
  const bool isMouse = device && device->UsesView();
  overlay->SetHint(isMouse && !this->HasTouched ? MouseHint : "");
  overlay->SetStatus(this->DescribeState());
  this->MustRender = this->MustRender || overlay->GetMTime() > this->ShownOverlay;
  this->ShownOverlay = overlay->GetMTime();
}

void vtkInteractorStyleHaptic::ToggleTrail()
{
  vtkGodObjectActor* actor = this->View->GetGodObjectActor();
  actor->SetShowTrail(!actor->GetShowTrail());
  if (!actor->GetShowTrail())
  {
    actor->ClearTrail();
  }
  this->Notify(actor->GetShowTrail() ? "trail: on" : "trail: off");
}

void vtkInteractorStyleHaptic::FitWorkspace()
{
  vtkRenderer* renderer = this->FindRenderer();
  if (renderer && !this->Scene->FitWorkspace(renderer->GetActiveCamera()))
  {
    this->Refuse(this->Scene->GetErrorMessage());
  }
  else if (renderer)
  {
    this->Notify("the hand's space is fitted to the view");
  }
}

/// Says how far the hand goes as well, as one press is seen like the next.
void vtkInteractorStyleHaptic::ScaleWorkspace(double factor)
{
  if (factor > 0.0)
  {
    this->Scene->ScaleWorkspace(factor);
  }
  else
  {
    this->Scene->ResetWorkspace();
  }
  vtkHapticWorkspace* const workspace = this->Scene->GetWorkspace();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << (factor > 1.0      ? "farther"
              : factor > 0.0 ? "less far"
                             : "as far as at first")
       << ": 10 mm move the hand by " << std::setprecision(3) << 0.01 * workspace->GetScale() << " "
       << haptics::LengthUnitName(workspace->GetUnitLength());
  this->Notify(text.str());
}

void vtkInteractorStyleHaptic::ToggleGrip()
{
  if (this->Scene->GetGrip()->GetSurface() >= 0)
  {
    this->Scene->GetGrip()->LetGo();
  }
  else if (!this->Scene->GetTouching())
  {
    this->Refuse("What is touched is gripped: touch a surface, then press x.");
  }
  else if (!this->Scene->GetGrip()->Take())
  {
    this->Refuse(this->Scene->GetErrorMessage());
  }
}

void vtkInteractorStyleHaptic::OnChar()
{
  haptics::ReportedKey reported;
  reported.Code = this->Interactor->GetKeyCode();
  reported.Symbol = this->Interactor->GetKeySym();
  reported.Shift = this->Interactor->GetShiftKey() != 0;
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 20240201)
  reported.IgnoresShift = this->Interactor->IsA("vtkXRenderWindowInteractor");
#endif
  const char key = haptics::TypedKey(reported);
  if (this->Interactor->GetControlKey() || this->Interactor->GetAltKey())
  {
    return; // no command of ours nor of VTK's, but perhaps one of the program's
  }
  if (std::strchr("hHcCxX", key))
  {
    this->NoticedUntil = 0.0; // the state says it
  }
  switch (key)
  {
    case 'h':
    case 'H':
      this->Engage();
      break;
    case '?':
      this->ToggleHelp();
      break;
    case 'v':
    case 'V':
      this->FitWorkspace();
      break;
    case 'b':
    case 'B':
      this->ToggleTrail();
      break;
    case 'd':
    case 'D':
      this->DropLandmark();
      break;
    case 'z':
    case 'Z':
      this->Scene->GetLandmarks()->Undo();
      break;
    case 'c':
    case 'C':
      this->Scene->SetClutched(!this->Scene->GetClutched());
      break;
    case 'x':
    case 'X':
      this->ToggleGrip();
      break;
    case '+':
    case '-':
      this->ScaleWorkspace(key == '+' ? 1.25 : 0.8);
      break;
    case '0':
      this->ScaleWorkspace(0.0);
      break;
    case 'o':
    case 'O':
    case 't':
    case 'T':
    case 'g':
    case 'G':
      this->ToggleLook(key);
      break;
    default:
      this->DrawLater([this] { this->Superclass::OnChar(); });
      // A key that is held repeats itself: the space bar is to draw nothing. No timer: the end.
      this->MustRender = this->TimerId != 0 &&
        (this->MustRender || (key != 0 && std::strchr(CommandsOfVtk, key) != nullptr));
      return;
  }
  this->RenderSoon();
}

void vtkInteractorStyleHaptic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumFrameRate [1/s]: " << this->MaximumFrameRate << "\n";
  os << indent << "Interrupted: " << (this->Interrupted ? "yes" : "no") << "\n";
  os << indent << "TimerId: " << this->TimerId << "\n";
  os << indent << "NumberOfRenders: " << this->NumberOfRenders << "\n";
  os << indent << "Scene:\n";
  this->Scene->PrintSelf(os, indent.GetNextIndent());
}
