#ifndef Haptics_SceneTestTools_h
#define Haptics_SceneTestTools_h

#include "vtkCallbackCommand.h"
#include "vtkHapticSafety.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkSimulatedHapticDevice.h"
#include "vtkSmartPointer.h"

#include <chrono>
#include <cmath>
#include <thread>

/// A square of 0.2 by 0.2 around the z axis, facing up, in two triangles' worth of one quad.
inline vtkSmartPointer<vtkPolyData> MakeTable(double height)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.1, -0.1, height);
  plane->SetPoint1(0.1, -0.1, height);
  plane->SetPoint2(-0.1, 0.1, height);
  plane->Update();
  return plane->GetOutput();
}

/// Counts an event, and keeps VTK's errors out of the output where it is an ErrorEvent.
class EventCounter
{
public:
  EventCounter(vtkObject* subject, unsigned long event)
    : Subject(subject)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void*)
      { ++static_cast<EventCounter*>(self)->Count; });
    subject->AddObserver(event, this->Command);
  }
  ~EventCounter() { this->Subject->RemoveObserver(this->Command); }
  EventCounter(const EventCounter&) = delete;
  EventCounter& operator=(const EventCounter&) = delete;

  int Count = 0;

private:
  vtkSmartPointer<vtkObject> Subject;
  vtkNew<vtkCallbackCommand> Command;
};

/// A scene with a hand that the test leads. Device and world frame are the same.
///
///         hand above
///     ------------------ table at z = 0
///         hand below
struct LedHand
{
  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticScene> Scene;

  LedHand()
  {
    this->Scene->SetDevice(this->Device);
    // This hand jumps by millimetres in a tick, and its force is tested in the next.
    vtkHapticSafety* safety = this->Scene->GetServo()->GetSafety();
    safety->LoosenSoftStartTime(0.0);
    safety->LoosenSlewLimit(1e5);
  }

  /// Moves the hand to a height over the table's middle and lets a tick go by.
  void MoveTo(double height)
  {
    this->Device->SetPosition(0.01, 0.02, height);
    this->Scene->Step(1);
  }
  double GodObjectHeight() { return this->Scene->GetGodObject()[2]; }
  /// Engages a servo that a busy machine may delay without a fault.
  bool EngagePatiently()
  {
    vtkHapticServo* servo = this->Scene->GetServo();
    servo->SetStallLimit(60.0);
    servo->GetSafety()->LoosenMissedTickShare(60.0);
    servo->GetSafety()->LoosenWatchdogTime(1.0);
    return this->Scene->Engage();
  }
  /// Waits until the engaged servo has done so many whole ticks with what was set before, while
  /// the scene does not look.
  void AwaitTicks(int ticks = 1)
  {
    vtkHapticServo* servo = this->Scene->GetServo();
    const vtkTypeInt64 enough = servo->GetNumberOfTicks() + 1 + ticks; // one is under way
    while (servo->GetNumberOfTicks() < enough && servo->IsRunning())
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
};

/// A float32 table is kept at a distance of its crack width: 2^-21 of 0.1, with some room.
constexpr double Clearance = 1e-6;

#endif
