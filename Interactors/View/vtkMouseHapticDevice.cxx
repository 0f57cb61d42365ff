#include "vtkMouseHapticDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/LatestValue.h"
#include "haptics/Devices/MonitoredChannel.h"
#include "haptics/View/ViewHeight.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkHapticGrip.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkInteractorStyle.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkTimerLog.h"
#include "vtkTransform.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

vtkStandardNewMacro(vtkMouseHapticDevice);

namespace
{
constexpr double Arrived = 1e-7;       // [m]: less than a hand notices; then it is there
constexpr double HoverHeight = 0.001;  // [m] above the surface, towards the viewer
constexpr int RepeatDelay = 25;        // [ms] in which a held key's next press follows its release
constexpr double StartHeight = 5e-5;   // [m] from which a hand goes in that is put down pressing
constexpr double CarrySteps = 5.0;     // a notch carries this many times as far as it presses
constexpr double SteepestStep = 0.5;   // sine between step and surface; beyond, there is an edge
constexpr double SharpestEdge = 0.9;   // cosine between normals; a hand does not slide over sharper
constexpr double Shallow = 0.02;       // of the depth may be missing
constexpr double DeepeningShare = 0.3; // of what is missing, at each look
constexpr int MostPlacesBetween = 12;  // that are looked at between two places of the cursor
constexpr double DeepestFold = 0.5;    // in pressing depths; a hand does not slide over deeper
constexpr double StrayPixels = 12.0;   // more from the cursor than that is astray
constexpr double AlongBall = 0.3;      // of its radius, at most, in a tick
constexpr double GivesWayAt = 1.15;    // in depths that were set; a hand gives way to more
constexpr double StrayTime = 0.05;     // [s] after which a hand that is astray is put down anew

const haptics::DeviceRegistration Registration(
  "mouse", "Mouse", []() -> vtkHapticDevice* { return vtkMouseHapticDevice::New(); });

enum MouseButton : unsigned int
{
  LeftButton = 1,
  MiddleButton = 2,
  RightButton = 4
};
}

/// The servo's end: a hand that is drawn to the mouse's position, or put down there.
class vtkMouseHapticDevice::MouseChannel : public haptics::MonitoredChannel
{
public:
  /// Where the hand is to go, and whether it starts from another place than the one it is at.
  struct Order
  {
    std::array<double, 3> Target{};
    std::array<double, 3> Place{};
    std::uint32_t Placements = 0; ///< whenever it changes the hand is there at once, from Place
    double MostDepth = Unlimited; ///< below the god-object [m]
  };
  static constexpr double Unlimited = std::numeric_limits<double>::infinity();

  MouseChannel(const std::array<double, 3>& target, double smoothing)
    : Smoothing(smoothing)
    , Wanted(Order{ target, target, 0, Unlimited })
    , Hand(target)
  {
    this->Latest.Target = target;
  }

  void Move(const std::array<double, 3>& target, double mostDepth)
  {
    this->Latest.Target = target;
    this->Latest.MostDepth = mostDepth;
    this->Wanted.Publish(this->Latest);
  }

  void Place(
    const std::array<double, 3>& place, const std::array<double, 3>& target, double mostDepth)
  {
    this->Latest.Place = place;
    ++this->Latest.Placements;
    this->Move(target, mostDepth);
  }

  /// Whether the surface keeps the hand from where it is to go. GUI thread.
  bool IsKeptAway() const { return this->IsKept.load(std::memory_order_relaxed); }

  /// The surface pushes a hand away that it would let deeper in than the hand is set to: the
  /// god-object stays behind at a fold or a rim, and whoever looks at it does so only between two
  /// pictures.
  void Notice(const std::array<double, 3>& displacement) noexcept override
  {
    this->Displacement = displacement;
  }

protected:
  bool ReadDevice(double time, haptics::DeviceSample& sample) noexcept override
  {
    this->Wanted.Update();
    const Order& order = this->Wanted.Get();
    if (order.Placements != this->Placements)
    {
      this->Placements = order.Placements;
      this->Hand = order.Target;
      this->IsKept.store(false, std::memory_order_relaxed);
    }
    else
    {
      this->Approach(order, std::max(0.0, time - this->LastTime));
    }
    this->LastTime = time;
    sample.Position = this->Hand;
    sample.Buttons = 0;
    sample.Placements = this->Placements;
    sample.Place = order.Place;
    return true;
  }

  void WriteDevice(const std::array<double, 3>&) noexcept override {}

private:
  void Approach(const Order& order, double elapsed) noexcept
  {
    double share = this->Smoothing > 0.0 ? 1.0 - std::exp(-elapsed / this->Smoothing) : 1.0;
    double step[3];
    vtkMath::Subtract(order.Target.data(), this->Hand.data(), step);
    if ((1.0 - share) * vtkMath::Norm(step) < Arrived)
    {
      share = 1.0; // so that a hand at rest gives the same picture, which is not drawn again
    }
    vtkMath::MultiplyScalar(step, share);
    // Rounding leaves a hand that is kept just inside.
    const bool isKept = vtkMath::Norm(this->Displacement.data()) >= (1.0 - 1e-9) * order.MostDepth;
    this->IsKept.store(isKept, std::memory_order_relaxed);
    if (isKept)
    {
      this->GoRound(order.MostDepth, step);
    }
    vtkMath::Add(this->Hand.data(), step, this->Hand.data());
  }

  /// Where the god-object has not followed, the hand goes no farther from it than `radius`: back to
  /// the ball of that radius around it, and along it.
  void GoRound(double radius, double step[3]) const noexcept
  {
    const double* toGod = this->Displacement.data();
    const double distance = vtkMath::Norm(toGod);
    const double outwards = std::max(0.0, -vtkMath::Dot(step, toGod)) / (distance * distance);
    for (int i = 0; i < 3; ++i)
    {
      step[i] += outwards * toGod[i];
    }
    const double length = vtkMath::Norm(step);
    const double share = std::min(1.0, AlongBall * radius / std::max(length, Arrived));
    for (int i = 0; i < 3; ++i)
    {
      step[i] = share * step[i] + (1.0 - radius / distance) * toGod[i];
    }
  }

  const double Smoothing;
  Order Latest; // the GUI thread's
  haptics::LatestValue<Order> Wanted;
  std::array<double, 3> Hand;           // the servo thread's, as what follows
  std::array<double, 3> Displacement{}; // to the god-object, at the last tick
  std::uint32_t Placements = 0;
  double LastTime = 0.0;
  std::atomic<bool> IsKept{ false };
};

/// Where on a surface the cursor was.
struct vtkMouseHapticDevice::Place
{
  double Hit[3];
  double Normal[3];
  int Cursor[2];
};

/// The ray under the cursor, world frame.
struct vtkMouseHapticDevice::View
{
  double Eye[3];       ///< the camera's position, from which depths are measured
  double Forward[3];   ///< unit
  double From[3];      ///< a point of the ray
  double Direction[3]; ///< one unit of depth long
  vtkMTimeType Time;   ///< of the camera
  double Near;         ///< depth at which rays begin
  bool IsParallel;
  double Pixel[2]; ///< the width of a pixel [world unit]: at depth d, Pixel[0] + d Pixel[1]

  double Depth(const double point[3]) const
  {
    double toPoint[3];
    vtkMath::Subtract(point, this->Eye, toPoint);
    return vtkMath::Dot(toPoint, this->Forward);
  }
  /// The ray that meets a point.
  void RayOf(const double point[3], double from[3], double direction[3]) const
  {
    const double depth = this->Depth(point);
    for (int i = 0; i < 3; ++i)
    {
      direction[i] =
        this->IsParallel ? this->Forward[i] : (point[i] - this->Eye[i]) / std::max(depth, 1e-300);
      from[i] = point[i] - (depth - this->Near) * direction[i];
    }
  }
  /// The point of the ray at a depth.
  void At(double depth, double point[3]) const
  {
    const double t = depth - this->Depth(this->From);
    for (int i = 0; i < 3; ++i)
    {
      point[i] = this->From[i] + t * this->Direction[i]; // `point` may be From
    }
  }
};

vtkMouseHapticDevice::vtkMouseHapticDevice()
{
  this->MaximumForce = 5.0;
  this->MaximumStiffness = 2000.0;
  this->NumberOfButtons = 0;
  const double bounds[6] = { -0.08, 0.08, -0.06, 0.06, -0.05, 0.05 };
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
  this->Callback->SetClientData(this);
  this->Callback->SetCallback(vtkMouseHapticDevice::OnEvent);
  // Passive: a style that moves the camera takes all other observers' events.
  this->PassiveCallback->SetClientData(this);
  this->PassiveCallback->SetCallback(vtkMouseHapticDevice::OnPassiveEvent);
  this->PassiveCallback->SetPassiveObserver(1);
}

vtkMouseHapticDevice::~vtkMouseHapticDevice()
{
  this->SetInteractor(nullptr);
}

bool vtkMouseHapticDevice::Open()
{
  if (!this->IsOpen())
  {
    this->Mouse = std::make_shared<MouseChannel>(this->Target, this->Smoothing);
    this->BecomeReady(this->Mouse);
  }
  return true;
}

void vtkMouseHapticDevice::Close()
{
  this->Mouse.reset();
  this->Pressed = false;
  this->IsPressing = false;
  this->WheelDepth = 0.0;
  this->BecomeClosed();
}

void vtkMouseHapticDevice::FindDevices(vtkStringArray* ids, vtkStringArray* states)
{
  ids->InsertNextValue("");
  states->InsertNextValue("ready, in a window; it moves the hand and cannot push back.");
}

void vtkMouseHapticDevice::StartInFront()
{
  const double* reach = this->WorkspaceBounds;
  this->Close();
  this->SetTarget(0.5 * (reach[0] + reach[1]), 0.5 * (reach[2] + reach[3]), reach[5]);
}

void vtkMouseHapticDevice::SetInteractor(vtkRenderWindowInteractor* interactor)
{
  if (interactor == this->Interactor)
  {
    return;
  }
  if (this->Interactor)
  {
    this->ForgetRelease();
    this->Interactor->RemoveObserver(this->Callback);
    this->Interactor->RemoveObserver(this->PassiveCallback);
  }
  this->ReleaseTimer = 0;
  this->Interactor = interactor;
  this->Pressed = false;
  if (interactor)
  {
    const float beforeStyles = 2.0f;
    for (const unsigned long event :
      { vtkCommand::MouseMoveEvent, vtkCommand::MouseWheelForwardEvent,
        vtkCommand::MouseWheelBackwardEvent, vtkCommand::KeyPressEvent, vtkCommand::KeyReleaseEvent,
        vtkCommand::LeaveEvent, vtkCommand::TimerEvent, vtkCommand::LeftButtonPressEvent,
        vtkCommand::LeftButtonReleaseEvent })
    {
      interactor->AddObserver(event, this->Callback, beforeStyles);
    }
    for (const unsigned long event :
      { vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent,
        vtkCommand::MiddleButtonPressEvent, vtkCommand::MiddleButtonReleaseEvent,
        vtkCommand::RightButtonPressEvent, vtkCommand::RightButtonReleaseEvent,
        vtkCommand::KeyReleaseEvent, vtkCommand::TimerEvent })
    {
      interactor->AddObserver(event, this->PassiveCallback, beforeStyles);
    }
  }
  this->Modified();
}

vtkRenderWindowInteractor* vtkMouseHapticDevice::GetInteractor()
{
  return this->Interactor;
}

void vtkMouseHapticDevice::SetScene(vtkHapticScene* scene)
{
  if (scene != this->Scene)
  {
    this->Scene = scene;
    this->Modified();
  }
}

void vtkMouseHapticDevice::SetRenderer(vtkRenderer* renderer)
{
  if (renderer != this->Renderer)
  {
    this->Renderer = renderer;
    this->Modified();
  }
}

vtkRenderer* vtkMouseHapticDevice::GetRenderer()
{
  return this->Renderer;
}

vtkHapticScene* vtkMouseHapticDevice::GetScene()
{
  return this->Scene;
}

void vtkMouseHapticDevice::OnEvent(
  vtkObject*, unsigned long event, void* clientData, void* callData)
{
  auto* self = static_cast<vtkMouseHapticDevice*>(clientData);
  self->Callback->SetAbortFlag(self->Handle(event, callData) ? 1 : 0);
}

/// Whether a scene asks where the hand is. Before and after, the mouse is the camera's alone.
bool vtkMouseHapticDevice::HasView()
{
  return this->Interactor != nullptr;
}

void vtkMouseHapticDevice::ConnectView(vtkRenderWindowInteractor* interactor, vtkHapticScene* scene)
{
  this->SetInteractor(interactor);
  this->SetScene(scene);
}

bool vtkMouseHapticDevice::IsInUse()
{
  const int state = this->Scene ? this->Scene->GetServo()->GetState() : vtkHapticServo::Running;
  return this->IsOpen() && (state == vtkHapticServo::Running || state == vtkHapticServo::Stepping);
}

/// True where nobody else is to see the event.
bool vtkMouseHapticDevice::Handle(unsigned long event, void* callData)
{
  if (event == vtkCommand::TimerEvent)
  {
    const bool isMine =
      this->TimerThatRanOut && callData && *static_cast<int*>(callData) == this->TimerThatRanOut;
    this->TimerThatRanOut = 0;
    return isMine; // the trackball takes any timer for its own
  }
  const bool isInUse = this->IsInUse();
  if (!isInUse)
  {
    this->ForgetRelease();
    this->Pressed = false; // a key that is let go of now is not heard
    this->IsPressing = false;
    this->WheelDepth = 0.0;
  }
  if (event == vtkCommand::LeftButtonPressEvent || event == vtkCommand::LeftButtonReleaseEvent)
  {
    return this->HandleButton(event);
  }
  if (!isInUse)
  {
    return false;
  }
  const int* position = this->Interactor->GetEventPosition();
  const char* key = this->Interactor->GetKeySym();
  const bool space = key && std::strcmp(key, "space") == 0;
  auto* style = vtkInteractorStyle::SafeDownCast(this->Interactor->GetInteractorStyle());
  const bool isCamerasTurn = this->ButtonsHeld != 0 || (style && style->GetState() != VTKIS_NONE);
  switch (event)
  {
    case vtkCommand::MouseMoveEvent:
      if (!isCamerasTurn)
      {
        this->MoveTo(position[0], position[1]);
      }
      return this->ShiftPresses; // or the style would move the camera
    case vtkCommand::MouseWheelForwardEvent:
    case vtkCommand::MouseWheelBackwardEvent:
      if (isCamerasTurn || this->Interactor->GetControlKey())
      {
        return false;
      }
      std::copy(position, position + 2, this->Cursor);
      this->Turn(event == vtkCommand::MouseWheelForwardEvent ? 1 : -1);
      return true;
    case vtkCommand::KeyPressEvent:
      if (space)
      {
        if (!isCamerasTurn)
        {
          std::copy(position, position + 2, this->Cursor);
        }
        this->HandleSpace(true);
      }
      return space;
    case vtkCommand::KeyReleaseEvent: // OnPassiveEvent() has heard it
      return space;
    default: // the mouse has left the window: keys held there go unheard
      this->ForgetRelease();
      if (this->IsHeld)
      {
        this->SetPressed(false);
      }
      return false;
  }
}

void vtkMouseHapticDevice::HandleTimer(void* callData)
{
  if (this->ReleaseTimer && callData && *static_cast<int*>(callData) == this->ReleaseTimer)
  {
    this->TimerThatRanOut = this->ReleaseTimer;
    this->ReleaseTimer = 0; // VTK takes it away; not to be destroyed while it fires
    this->SetPressed(false);
  }
  this->WatchContact();
}

/// Left with Shift presses. True where nobody else is to see it.
bool vtkMouseHapticDevice::HandleButton(unsigned long event)
{
  const bool isPress = event == vtkCommand::LeftButtonPressEvent;
  if (!this->ShiftPresses && !(isPress && this->Interactor->GetShiftKey() && this->IsInUse()))
  {
    return false;
  }
  this->ShiftPresses = isPress;
  this->ButtonsHeld &= ~static_cast<unsigned int>(LeftButton); // it is not the camera's
  std::copy_n(this->Interactor->GetEventPosition(), 2, this->Cursor);
  this->SetPressed(isPress);
  this->IsHeld = isPress;
  return true;
}

/// Hears what the style keeps for itself while it moves the camera: that the space bar is let go
/// of, and the buttons with which the mouse is the camera's.
void vtkMouseHapticDevice::OnPassiveEvent(
  vtkObject*, unsigned long event, void* clientData, void* callData)
{
  auto* self = static_cast<vtkMouseHapticDevice*>(clientData);
  if (event == vtkCommand::TimerEvent)
  {
    self->HandleTimer(callData);
    return;
  }
  if (event == vtkCommand::KeyReleaseEvent)
  {
    const char* key = self->Interactor->GetKeySym();
    if (key && std::strcmp(key, "space") == 0 && self->IsInUse())
    {
      self->HandleSpace(false);
    }
    return;
  }
  unsigned int button = RightButton;
  if (event == vtkCommand::LeftButtonPressEvent || event == vtkCommand::LeftButtonReleaseEvent)
  {
    button = LeftButton;
  }
  else if (event == vtkCommand::MiddleButtonPressEvent ||
    event == vtkCommand::MiddleButtonReleaseEvent)
  {
    button = MiddleButton;
  }
  const bool isPress = event == vtkCommand::LeftButtonPressEvent ||
    event == vtkCommand::MiddleButtonPressEvent || event == vtkCommand::RightButtonPressEvent;
  self->ButtonsHeld = isPress ? self->ButtonsHeld | button : self->ButtonsHeld & ~button;
  self->Waiting = self->Waiting || self->ButtonsHeld != 0;
}

void vtkMouseHapticDevice::HandleSpace(bool down)
{
  this->ForgetRelease();
  if (!down)
  {
    this->ReleaseTimer =
      std::max(0, this->Interactor->CreateOneShotTimer(static_cast<unsigned long>(RepeatDelay)));
  }
  if (down || this->ReleaseTimer == 0)
  {
    this->SetPressed(down);
  }
  this->IsHeld = down || this->ReleaseTimer != 0;
}

void vtkMouseHapticDevice::ForgetRelease()
{
  if (this->ReleaseTimer)
  {
    this->Interactor->DestroyTimer(this->ReleaseTimer);
    this->ReleaseTimer = 0;
  }
}

bool vtkMouseHapticDevice::Look(View& view)
{
  if (!this->Interactor || !this->Scene || !this->Interactor->GetRenderWindow())
  {
    return false;
  }
  vtkRenderer* renderer = this->Interactor->FindPokedRenderer(this->Cursor[0], this->Cursor[1]);
  if (!renderer)
  {
    return false;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  view.Time = camera->GetViewTransformObject()->GetMTime();
  camera->GetPosition(view.Eye);
  camera->GetDirectionOfProjection(view.Forward);
  double ends[2][4];
  for (int i = 0; i < 2; ++i)
  {
    renderer->SetDisplayPoint(this->Cursor[0], this->Cursor[1], i);
    renderer->DisplayToWorld();
    renderer->GetWorldPoint(ends[i]);
    for (int j = 0; j < 3; ++j)
    {
      ends[i][j] /= ends[i][3];
    }
  }
  // From the eye, not from the near plane, which may lie behind what is not drawn yet.
  view.IsParallel = camera->GetParallelProjection() != 0;
  const double* begin = view.IsParallel ? ends[0] : view.Eye;
  vtkMath::Subtract(ends[1], begin, view.Direction);
  const double deep = vtkMath::Dot(view.Direction, view.Forward);
  if (!(deep > 0.0) || !std::isfinite(deep))
  {
    return false;
  }
  vtkMath::MultiplyScalar(view.Direction, 1.0 / deep);
  view.Near =
    view.IsParallel ? -10.0 * (camera->GetDistance() + camera->GetClippingRange()[1]) : 0.0;
  std::copy(begin, begin + 3, view.From);
  view.At(view.Near, view.From);
  const double pixel = haptics::ViewHeight(camera, 1.0) / std::max(1, renderer->GetSize()[1]);
  view.Pixel[0] = view.IsParallel ? pixel : 0.0;
  view.Pixel[1] = view.IsParallel ? 0.0 : pixel;
  return true;
}

double vtkMouseHapticDevice::Scale()
{
  return std::cbrt(this->Scene->GetWorkspaceTransform()->Determinant());
}

/// Device depth that the hand is to press [m]; 0 in the air.
double vtkMouseHapticDevice::PressingDepth()
{
  return this->Pressed ? std::max(this->PressDepth, this->WheelDepth) : this->WheelDepth;
}

bool vtkMouseHapticDevice::IsCarrying()
{
  return this->Scene && this->Scene->GetGrip()->GetSurface() >= 0;
}

/// Whether the cursor is over what another renderer draws.
bool vtkMouseHapticDevice::IsElsewhere()
{
  return this->Renderer &&
    this->Interactor->FindPokedRenderer(this->Cursor[0], this->Cursor[1]) != this->Renderer;
}

/// Takes in what is under the cursor. False, and all as it was, where that is nothing.
bool vtkMouseHapticDevice::Find(const View& view)
{
  double hit[3];
  double normal[3];
  if (!this->Scene->GetSurfaces()->IntersectRay(view.From, view.Direction, hit, normal))
  {
    return false;
  }
  const double depth = view.Depth(hit);
  view.At(depth - HoverHeight * this->Scale(), this->Hover);
  std::copy(hit, hit + 3, this->Hit);
  std::copy(normal, normal + 3, this->Normal);
  std::copy(this->Cursor, this->Cursor + 2, this->FoundAt);
  this->Pixel = view.Pixel[0] + depth * view.Pixel[1];
  return true;
}

void vtkMouseHapticDevice::ToDevice(const double world[3], double device[3])
{
  vtkNew<vtkMatrix4x4> toDevice;
  vtkMatrix4x4::Invert(this->Scene->GetWorkspaceTransform(), toDevice);
  const double point[4] = { world[0], world[1], world[2], 1.0 };
  double result[4];
  toDevice->MultiplyPoint(point, result);
  std::copy(result, result + 3, device);
}

/// Draws the hand to `world`, from `place` where that is not null.
void vtkMouseHapticDevice::Want(const double world[3], const double* place)
{
  double target[3];
  this->ToDevice(world, target);
  if (place && this->Mouse)
  {
    std::array<double, 3> start;
    this->ToDevice(place, start.data());
    if (std::isfinite(start[0] + start[1] + start[2]) &&
      std::isfinite(target[0] + target[1] + target[2]))
    {
      std::copy(target, target + 3, this->Target.begin());
      this->Mouse->Place(start, this->Target, this->MostDepth());
      return;
    }
  }
  this->MoveHand(target);
}

/// Whether the surface between the last place of the cursor and this one is one that a hand can
/// slide along: without edges and folds.
bool vtkMouseHapticDevice::IsSmooth(const View& view, const Place& before)
{
  double step[3];
  vtkMath::Subtract(this->Hit, before.Hit, step);
  const double depth = this->PressingDepth() * this->Scale();
  const double aside = std::max(
    std::abs(vtkMath::Dot(this->Normal, step)), std::abs(vtkMath::Dot(before.Normal, step)));
  if (vtkMath::Dot(this->Normal, before.Normal) < SharpestEdge ||
    aside > SteepestStep * vtkMath::Norm(step) + 0.1 * depth)
  {
    return false;
  }
  const int width = std::max(
    std::abs(this->Cursor[0] - before.Cursor[0]), std::abs(this->Cursor[1] - before.Cursor[1]));
  const int places = std::clamp(width - 1, 0, MostPlacesBetween);
  const double ends[2] = { view.Depth(before.Hit), view.Depth(this->Hit) };
  double normals[2][3]; // of two neighbours
  std::copy(before.Normal, before.Normal + 3, normals[0]);
  for (int i = 1; i <= places; ++i)
  {
    double* const previous = normals[(i - 1) % 2];
    double* const normal = normals[i % 2];
    // The rays between: the two at the ends, mixed as their points are.
    const double share = static_cast<double>(i) / (places + 1);
    double between[3];
    for (int j = 0; j < 3; ++j)
    {
      between[j] = before.Hit[j] + share * step[j];
    }
    double from[3];
    double direction[3];
    view.RayOf(between, from, direction);
    double hit[3];
    if (!this->Scene->GetSurfaces()->IntersectRay(from, direction, hit, normal) ||
      vtkMath::Dot(previous, normal) < SharpestEdge ||
      std::abs(view.Depth(hit) - (ends[0] + share * (ends[1] - ends[0]))) > DeepestFold * depth)
    {
      return false;
    }
  }
  return vtkMath::Dot(normals[places % 2], this->Normal) >= SharpestEdge;
}

/// Brings the hand to where the cursor is: over the surface, or into it. While it presses it goes
/// there through the surface's inside, with the god-object on the surface, unless the way leads
/// over an edge, or `mustPlace`; else it is put down there.
void vtkMouseHapticDevice::Follow(bool mustPlace)
{
  View view;
  if (!this->Look(view))
  {
    return;
  }
  if (this->IsCarrying())
  {
    this->Carry(view, 0.0);
    return;
  }
  const bool isSameView = view.Time == this->LookedAt;
  Place before;
  std::copy(this->Hit, this->Hit + 3, before.Hit);
  std::copy(this->Normal, this->Normal + 3, before.Normal);
  before.Cursor[0] = this->FoundAt[0];
  before.Cursor[1] = this->FoundAt[1];
  this->LookedAt = view.Time;
  this->Waiting = this->IsElsewhere() || !this->Find(view);
  if (this->Waiting)
  {
    if (this->IsPressing)
    {
      this->IsPressing = false;
      this->Want(this->Hover, this->Hover);
    }
    return;
  }
  const double depth = this->PressingDepth();
  const bool slides =
    depth > 0.0 && this->IsPressing && isSameView && !mustPlace && this->IsSmooth(view, before);
  const double* place = slides ? nullptr : this->Hover;
  this->IsPressing = depth > 0.0;
  this->AstraySince = 0.0;
  if (place)
  {
    this->Extra = 0.0;
  }
  if (this->IsPressing)
  {
    this->Press(place != nullptr);
  }
  else
  {
    this->Want(this->Hover, place);
  }
}

/// Draws the hand into the surface where the cursor is, or puts it down there.
void vtkMouseHapticDevice::Press(bool isPlaced)
{
  const double depth = this->PressingDepth() * this->Scale() + this->Extra;
  double wanted[3];
  double start[3];
  for (int i = 0; i < 3; ++i)
  {
    wanted[i] = this->Hit[i] - depth * this->Normal[i];
    start[i] = this->Hit[i] + StartHeight / HoverHeight * (this->Hover[i] - this->Hit[i]);
  }
  this->Want(wanted, isPlaced ? start : nullptr);
}

/// Moves the hand within the plane of the view at its depth, and farther away by `change` [world
/// unit].
void vtkMouseHapticDevice::Carry(const View& view, double change)
{
  double hand[4] = { this->Target[0], this->Target[1], this->Target[2], 1.0 };
  this->Scene->GetWorkspaceTransform()->MultiplyPoint(hand, hand);
  double world[3];
  view.At(view.Depth(hand) + change, world);
  this->Waiting = false;
  this->IsPressing = false;
  this->Want(world, nullptr);
}

/// Whether a surface lies between the viewer and a place.
bool vtkMouseHapticDevice::IsHidden(const View& view, const double place[3])
{
  // From the near plane, along the ray of that place.
  double from[3];
  double direction[3];
  view.RayOf(place, from, direction);
  double hit[3];
  return this->Scene->IntersectRay(from, direction, hit) &&
    view.Depth(place) - view.Depth(hit) > HoverHeight * this->Scale();
}

/// In a hollow or at a rim the surface yields to the side, and the hand is less deep below the
/// god-object than it was set to: goes on until it is.
void vtkMouseHapticDevice::Deepen(double depth)
{
  const double missing = depth - this->Scene->GetPenetration();
  if (missing > Shallow * depth && this->Extra < depth)
  {
    this->Extra = std::min(depth, this->Extra + DeepeningShare * missing);
    this->Press(false);
  }
}

/// Puts a pressing hand down anew where the surface keeps it from the cursor: behind a rim that the
/// hand has slid under, or in a pocket.
void vtkMouseHapticDevice::WatchContact()
{
  if (!this->IsPressing || this->ButtonsHeld != 0 || !this->IsInUse() || !this->Scene ||
    this->IsCarrying())
  {
    this->AstraySince = 0.0;
    return;
  }
  View view;
  if (!this->Look(view))
  {
    return;
  }
  double god[3];
  this->Scene->GetGodObject(god);
  double away[3];
  vtkMath::Subtract(god, this->Hit, away);
  const double depth = this->PressingDepth() * this->Scale();
  const bool isAstray = !this->Scene->GetTouching() ||
    vtkMath::Norm(away) > std::max(depth, StrayPixels * this->Pixel) || this->Mouse->IsKeptAway();
  if (!isAstray && this->IsHidden(view, god))
  {
    this->Follow(true);
    return;
  }
  if (!isAstray)
  {
    this->Deepen(depth);
  }
  const double now = vtkTimerLog::GetUniversalTime();
  if (!isAstray)
  {
    this->AstraySince = 0.0;
  }
  else if (this->AstraySince == 0.0)
  {
    this->AstraySince = now;
  }
  else if (now - this->AstraySince > StrayTime)
  {
    this->Follow(true);
  }
}

void vtkMouseHapticDevice::SetTarget(double x, double y, double z)
{
  this->IsPressing = false; // a script's hand is pressed as deep as it says
  const double target[3] = { x, y, z };
  this->MoveHand(target);
}

void vtkMouseHapticDevice::MoveHand(const double target[3])
{
  if (!std::isfinite(target[0] + target[1] + target[2]))
  {
    vtkErrorMacro("The hand cannot be drawn to ("
      << target[0] << ", " << target[1] << ", " << target[2]
      << "), which is not finite; it stays. Check the camera and the workspace transform.");
    return;
  }
  std::copy(target, target + 3, this->Target.begin());
  if (this->Mouse)
  {
    this->Mouse->Move(this->Target, this->MostDepth());
  }
}

/// How deep the hand may be below the god-object [m], device frame.
double vtkMouseHapticDevice::MostDepth()
{
  return this->IsPressing ? GivesWayAt * this->PressingDepth() : MouseChannel::Unlimited;
}

void vtkMouseHapticDevice::GetTarget(double target[3])
{
  std::copy(this->Target.begin(), this->Target.end(), target);
}

void vtkMouseHapticDevice::MoveTo(int x, int y)
{
  this->Cursor[0] = x;
  this->Cursor[1] = y;
  this->Follow(false);
}

void vtkMouseHapticDevice::Turn(int notches)
{
  View view;
  if (!this->Look(view))
  {
    return;
  }
  if (this->IsCarrying())
  {
    this->Carry(view, notches * CarrySteps * this->WheelStep * this->Scale());
    return;
  }
  const double change = notches * this->WheelStep;
  const double stiffness = std::max(1.0, this->Scene->GetStiffness());
  const double deepest = std::max(this->WheelStep, this->MaximumForce / stiffness);
  if (this->Pressed)
  {
    this->SetPressDepth(std::clamp(this->PressDepth + change, this->WheelStep, deepest));
    this->WheelDepth = 0.0;
  }
  else
  {
    this->WheelDepth = std::clamp(this->WheelDepth + change, 0.0, deepest);
  }
  this->Follow(false);
}

void vtkMouseHapticDevice::SetPressed(bool pressed)
{
  this->IsHeld = false;
  if (pressed == this->Pressed)
  {
    return;
  }
  this->Pressed = pressed;
  if (!pressed)
  {
    this->WheelDepth = 0.0;
  }
  if (this->ButtonsHeld != 0 && !pressed && this->IsPressing && this->Scene && !this->IsCarrying())
  {
    // The cursor is the camera's; the hand lifts where it is.
    this->IsPressing = false;
    this->Want(this->Hover, this->Hover);
    return;
  }
  if (this->ButtonsHeld == 0)
  {
    this->Follow(false);
  }
}

const char* vtkMouseHapticDevice::GetStatusMessage() const
{
  return this->Waiting ? "waiting: move the mouse over a surface" : "";
}

void vtkMouseHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interactor: " << this->Interactor.Get() << "\n";
  os << indent << "Scene: " << this->Scene.Get() << "\n";
  os << indent << "Renderer: " << this->Renderer.Get() << "\n";
  os << indent << "Target [m]: (" << this->Target[0] << ", " << this->Target[1] << ", "
     << this->Target[2] << ")\n";
  os << indent << "Pressed: " << (this->Pressed ? "yes" : "no") << "\n";
  os << indent << "Waiting: " << (this->Waiting ? "yes" : "no") << "\n";
  os << indent << "WheelStep [m]: " << this->WheelStep << "\n";
  os << indent << "PressDepth [m]: " << this->PressDepth << "\n";
  os << indent << "Smoothing [s]: " << this->Smoothing << "\n";
}
