#ifndef Haptics_EventCounter_h
#define Haptics_EventCounter_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

/// Counts events of a kind; an error or warning that is counted stays out of the test's output.
class EventCounter
{
public:
  EventCounter(vtkObject* object, unsigned long event)
    : Object(object)
  {
    this->Command->SetClientData(&this->Count);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
    object->AddObserver(event, this->Command);
  }
  ~EventCounter() { this->Object->RemoveObserver(this->Command); }
  EventCounter(const EventCounter&) = delete;
  EventCounter& operator=(const EventCounter&) = delete;

  int Count = 0;

private:
  vtkSmartPointer<vtkObject> Object;
  vtkNew<vtkCallbackCommand> Command;
};

#endif
