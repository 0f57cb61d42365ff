#include "vtkMouseHapticDevice.h"

#include "haptics/Devices/LatestValue.h"
#include "haptics/Devices/MonitoredChannel.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkInteractorStyle.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

vtkStandardNewMacro(vtkMouseHapticDevice);

namespace
{
constexpr double Arrived = 1e-7;      // [m]: less than a hand can tell; then it is there
constexpr double HoverHeight = 0.004; // [m] above the surface when the hand lifts off
constexpr int RepeatDelay = 40;       // [ms] in which a held key's next press follows its release
constexpr double FreeSteps = 5.0;     // a notch in free space goes this many times as far
}

/// The servo's end: a hand that is drawn to the mouse's position.
class vtkMouseHapticDevice::MouseChannel : public haptics::MonitoredChannel
{
public:
  MouseChannel(const std::array<double, 3>& target, double smoothing)
    : Smoothing(smoothing)
    , Wanted(target)
    , Hand(target)
  {
  }

  void Want(const std::array<double, 3>& target) { this->Wanted.Publish(target); }

protected:
  bool ReadDevice(double time, haptics::DeviceSample& sample) noexcept override
  {
    this->Wanted.Update();
    const std::array<double, 3>& target = this->Wanted.Get();
    const double elapsed = std::max(0.0, time - this->LastTime);
    const double share = this->Smoothing > 0.0 ? 1.0 - std::exp(-elapsed / this->Smoothing) : 1.0;
    double left = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      this->Hand[i] += share * (target[i] - this->Hand[i]);
      left = std::max(left, std::abs(target[i] - this->Hand[i]));
    }
    if (left < Arrived) // so that a hand at rest gives the same picture, which is not drawn again
    {
      this->Hand = target;
    }
    this->LastTime = time;
    sample.Position = this->Hand;
    sample.Buttons = 0;
    return true;
  }

  void WriteDevice(const std::array<double, 3>&) noexcept override {}

private:
  const double Smoothing;
  haptics::LatestValue<std::array<double, 3>> Wanted;
  std::array<double, 3> Hand; // the servo thread's
  double LastTime = 0.0;
};

/// The ray under the cursor, world frame.
struct vtkMouseHapticDevice::View
{
  double Eye[3];       ///< the camera's position, from which depths are measured
  double Forward[3];   ///< unit
  double From[3];      ///< a point of the ray
  double Direction[3]; ///< one unit of depth long

  double Depth(const double point[3]) const
  {
    double toPoint[3];
    vtkMath::Subtract(point, this->Eye, toPoint);
    return vtkMath::Dot(toPoint, this->Forward);
  }
  void At(double depth, double point[3]) const
  {
    const double t = depth - this->Depth(this->From);
    for (int i = 0; i < 3; ++i)
    {
      point[i] = this->From[i] + t * this->Direction[i];
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
  this->BecomeClosed();
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
        vtkCommand::LeaveEvent, vtkCommand::TimerEvent })
    {
      interactor->AddObserver(event, this->Callback, beforeStyles);
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
      this->ReleaseTimer && callData && *static_cast<int*>(callData) == this->ReleaseTimer;
    if (isMine)
    {
      this->ReleaseTimer = 0; // VTK takes it away; not to be destroyed while it fires
      this->SetPressed(false);
    }
    return isMine; // the trackball takes any timer for its own
  }
  const int* position = this->Interactor->GetEventPosition();
  const char* key = this->Interactor->GetKeySym();
  const bool space = key && std::strcmp(key, "space") == 0;
  auto* style = vtkInteractorStyle::SafeDownCast(this->Interactor->GetInteractorStyle());
  const bool draggingTheCamera = style && style->GetState() != VTKIS_NONE;
  if (!this->IsInUse())
  {
    this->ForgetRelease();
    this->Pressed = false; // a key that is let go of now is not heard
    return false;
  }
  if (draggingTheCamera)
  {
    return false;
  }
  switch (event)
  {
    case vtkCommand::MouseMoveEvent:
      this->MoveTo(position[0], position[1]);
      return false;
    case vtkCommand::MouseWheelForwardEvent:
    case vtkCommand::MouseWheelBackwardEvent:
      if (this->Interactor->GetControlKey())
      {
        return false;
      }
      std::copy(position, position + 2, this->Cursor);
      this->Turn(event == vtkCommand::MouseWheelForwardEvent ? 1 : -1);
      return true;
    case vtkCommand::KeyPressEvent:
    case vtkCommand::KeyReleaseEvent:
      if (space)
      {
        this->HandleSpace(event == vtkCommand::KeyPressEvent);
      }
      return space;
    default: // the mouse has left the window: keys held there go unheard
      this->ForgetRelease();
      this->SetPressed(false);
      return false;
  }
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
  std::copy(ends[0], ends[0] + 3, view.From);
  vtkMath::Subtract(ends[1], ends[0], view.Direction);
  const double deep = vtkMath::Dot(view.Direction, view.Forward);
  if (!(deep > 0.0) || !std::isfinite(deep))
  {
    return false;
  }
  vtkMath::MultiplyScalar(view.Direction, 1.0 / deep);
  return true;
}

double vtkMouseHapticDevice::Scale()
{
  return std::cbrt(this->Scene->GetWorkspaceTransform()->Determinant());
}

double vtkMouseHapticDevice::DepthOfTarget(const View& view)
{
  const double target[4] = { this->Target[0], this->Target[1], this->Target[2], 1.0 };
  double world[4];
  this->Scene->GetWorkspaceTransform()->MultiplyPoint(target, world);
  return view.Depth(world);
}

bool vtkMouseHapticDevice::DepthOfSurface(const View& view, double& depth)
{
  double hit[3];
  if (this->Scene->GetGrippedSurface() >= 0)
  {
    return false; // what lies behind the part in the hand is not what the hand means
  }
  if (!this->Scene->IntersectRay(view.From, view.Direction, hit))
  {
    return false;
  }
  depth = view.Depth(hit);
  return true;
}

void vtkMouseHapticDevice::MoveWithin(const View& view, double depth)
{
  double world[4] = { 0.0, 0.0, 0.0, 1.0 };
  view.At(depth, world);
  vtkNew<vtkMatrix4x4> toDevice;
  vtkMatrix4x4::Invert(this->Scene->GetWorkspaceTransform(), toDevice);
  double device[4];
  toDevice->MultiplyPoint(world, device);
  this->SetTarget(device[0], device[1], device[2]);
}

void vtkMouseHapticDevice::SetTarget(double x, double y, double z)
{
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
  {
    vtkErrorMacro("The hand cannot be drawn to (" << x << ", " << y << ", " << z
                                                  << "), which is not finite; it stays. Check the "
                                                     "camera and the workspace transform.");
    return;
  }
  this->Target = { { x, y, z } };
  if (this->Mouse)
  {
    this->Mouse->Want(this->Target);
  }
}

void vtkMouseHapticDevice::GetTarget(double target[3])
{
  std::copy(this->Target.begin(), this->Target.end(), target);
}

void vtkMouseHapticDevice::MoveTo(int x, int y)
{
  this->Cursor[0] = x;
  this->Cursor[1] = y;
  View view;
  if (this->Look(view))
  {
    double depth = this->DepthOfTarget(view);
    double surface = 0.0;
    if (this->Pressed && this->DepthOfSurface(view, surface))
    {
      depth = surface + this->PressDepth * this->Scale();
    }
    this->MoveWithin(view, depth);
  }
}

void vtkMouseHapticDevice::Turn(int notches)
{
  View view;
  if (!this->Look(view))
  {
    return;
  }
  const double step = this->WheelStep * this->Scale();
  double depth = this->DepthOfTarget(view);
  double surface = 0.0;
  const bool known = this->DepthOfSurface(view, surface);
  for (int i = 0; i < std::abs(notches); ++i)
  {
    const bool free = !this->Scene->GetTouching() && (!known || depth < surface);
    if (notches > 0)
    {
      depth = free && known ? surface + step : depth + (free ? FreeSteps : 1.0) * step;
    }
    else
    {
      depth -= (free ? FreeSteps : 1.0) * step;
    }
  }
  this->MoveWithin(view, depth);
}

void vtkMouseHapticDevice::SetPressed(bool pressed)
{
  if (pressed == this->Pressed)
  {
    return;
  }
  this->Pressed = pressed;
  View view;
  double depth = 0.0;
  if (this->Look(view) && this->DepthOfSurface(view, depth))
  {
    this->MoveWithin(view, depth + (pressed ? this->PressDepth : -HoverHeight) * this->Scale());
  }
}

void vtkMouseHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interactor: " << this->Interactor.Get() << "\n";
  os << indent << "Scene: " << this->Scene.Get() << "\n";
  os << indent << "Target [m]: (" << this->Target[0] << ", " << this->Target[1] << ", "
     << this->Target[2] << ")\n";
  os << indent << "Pressed: " << (this->Pressed ? "yes" : "no") << "\n";
  os << indent << "WheelStep [m]: " << this->WheelStep << "\n";
  os << indent << "PressDepth [m]: " << this->PressDepth << "\n";
  os << indent << "Smoothing [s]: " << this->Smoothing << "\n";
}
