#ifndef Haptics_StubBench_h
#define Haptics_StubBench_h

#include "DriverBench.h"

#include <new>

#include <dlfcn.h>
#include <sys/mman.h>

/// Has a stub of a vendor's library use this state, in this process and its children. `function`:
/// of the stub, which takes it.
template <class State>
void UseState(const char* library, const char* function, State* state)
{
  void* const stub = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  reinterpret_cast<void (*)(State*)>(dlsym(stub, function))(state);
}

/// A device whose vendor's library is a stub. Its state is memory that processes share.
template <class DeviceType, class StateType>
class StubBench : public DriverBench
{
public:
  StubBench(const char* library, const char* function)
    : Library(library)
    , Memory(
        mmap(nullptr, sizeof(StateType), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
    , State(new (this->Memory) StateType)
  {
    UseState(library, function, this->State);
  }
  ~StubBench() override { munmap(this->Memory, sizeof(StateType)); }

  vtkSmartPointer<vtkDriverHapticDevice> MakeDevice() override
  {
    auto device = vtkSmartPointer<DeviceType>::New();
    device->SetLibraryFile(this->Library);
    return device;
  }
  void SetDelay(int milliseconds) override { this->State->Delay = milliseconds; }

private:
  const char* const Library;
  void* const Memory;

protected:
  StateType* const State;
};

#endif
