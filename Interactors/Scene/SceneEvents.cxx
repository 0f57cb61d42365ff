#include "haptics/Scene/SceneEvents.h"

#include "vtkHapticScene.h"

#include <utility>

namespace haptics
{
void SceneEvents::AddProbe(
  unsigned long event, const TickRecord* tick, const SurfaceSet* surfaces, vtkHapticScene* scene)
{
  if (scene->HasObserver(event))
  {
    auto probe = vtkSmartPointer<vtkHapticProbe>::New();
    if (tick)
    {
      surfaces->Probe(*tick, probe);
    }
    this->Pending.push_back({ event, probe, 0 });
  }
}

void SceneEvents::TakeButtons(std::uint32_t buttons, const TickRecord* tick)
{
  const std::uint32_t changed = buttons ^ this->Buttons;
  this->Buttons = buttons;
  for (int button = 0; button < 32; ++button)
  {
    const std::uint32_t bit = std::uint32_t{ 1 } << button;
    if (changed & bit)
    {
      const bool pressed = (buttons & bit) != 0;
      this->Add(
        pressed ? vtkHapticScene::ButtonPressEvent : vtkHapticScene::ButtonReleaseEvent, button);
      if (pressed && tick)
      {
        this->Presses.push_back({ button, *tick });
      }
    }
  }
}

void SceneEvents::Take(const TickRecord& tick, const SurfaceSet& surfaces, vtkHapticScene* scene)
{
  const bool touching = tick.NumberOfConstraints > 0;
  if (tick.Buttons != this->Buttons)
  {
    this->TakeButtons(tick.Buttons, &tick);
  }
  if (touching && !this->LastTouch)
  {
    this->AddProbe(vtkHapticScene::ContactBeginEvent, &tick, &surfaces, scene);
    this->SlidFrom = tick.Local;
  }
  else if (!touching && this->LastTouch)
  {
    this->AddProbe(vtkHapticScene::ContactEndEvent, &tick, &surfaces, scene);
  }
  if (tick.Status != this->Status)
  {
    this->Status = tick.Status;
    const bool isOverload = tick.Status == UpdateStatus::Overloaded;
    if (isOverload || tick.Status == UpdateStatus::Squeezed)
    {
      this->AddProbe(isOverload ? vtkHapticScene::OverloadEvent : vtkHapticScene::SqueezeEvent,
        &tick, &surfaces, scene);
    }
  }
  if (touching)
  {
    this->LastTouch = tick;
  }
  else
  {
    this->LastTouch.reset();
  }
}

void SceneEvents::EndOfTicks(const SurfaceSet& surfaces, vtkHapticScene* scene)
{
  if (this->LastTouch && this->LastTouch->Local != this->SlidFrom)
  {
    this->SlidFrom = this->LastTouch->Local;
    this->AddProbe(vtkHapticScene::ContactSlideEvent, &*this->LastTouch, &surfaces, scene);
  }
}

void SceneEvents::Stop(vtkHapticScene* scene)
{
  this->TakeButtons(0, nullptr);
  if (this->LastTouch)
  {
    this->LastTouch.reset();
    this->AddProbe(vtkHapticScene::ContactEndEvent, nullptr, nullptr, scene);
  }
  this->Status = UpdateStatus::Free;
}

void SceneEvents::Dispatch(vtkHapticScene* scene)
{
  // An observer may update the scene, which collects and invokes events of its own meanwhile.
  const std::vector<Event> events = std::exchange(this->Pending, {});
  for (const Event& event : events)
  {
    int value = event.Value;
    void* number = value == NoData ? nullptr : &value;
    scene->InvokeEvent(event.Id, event.Probe ? event.Probe.Get() : number);
  }
}

std::vector<TickRecord> SceneEvents::TakePresses(int button)
{
  std::vector<TickRecord> ticks;
  for (const Press& press : std::exchange(this->Presses, {}))
  {
    if (press.Button == button)
    {
      ticks.push_back(press.Tick);
    }
  }
  return ticks;
}
}
