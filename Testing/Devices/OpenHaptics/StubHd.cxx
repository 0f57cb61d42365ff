// Stands for 3D Systems' libHD.so: the same symbols, a scheduler of its own, and faults.
#include "StubHd.h"

#include <chrono>
#include <csignal>
#include <cstring>
#include <mutex>
#include <thread>
#include <vector>

namespace
{
using Callback = unsigned int (*)(void*);

StubHdState Own;
StubHdState* State = &Own;
std::mutex ErrorMutex;
std::vector<unsigned int> Errors;
double NextForce[3];
Callback Scheduled = nullptr;
void* ScheduledData = nullptr;
std::atomic<bool> Runs{ false };
std::thread* Scheduler = nullptr; // not destroyed with a process that exits while it runs

void Push(unsigned int error)
{
  const std::lock_guard<std::mutex> lock(ErrorMutex);
  Errors.push_back(error);
}

void RunScheduler()
{
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr); // a vendor's thread takes no signal
  while (Runs)
  {
    if (!State->IsStalled && Scheduled)
    {
      Scheduled(ScheduledData);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}
}

extern "C"
{
  struct HdError
  {
    unsigned int Code;
    int Internal;
    unsigned int Device;
  };

  void StubHdUse(StubHdState* state)
  {
    State = state;
  }

  unsigned int hdInitDevice(const char* name)
  {
    std::strncpy(State->Name, name ? name : "", sizeof(State->Name) - 1);
    if (State->InitError != 0)
    {
      Push(State->InitError);
      return 0xFFFFFFFF;
    }
    State->IsOpen = true;
    return 7;
  }
  void hdDisableDevice(unsigned int)
  {
    State->IsOpen = false;
  }
  void hdMakeCurrentDevice(unsigned int) {}
  void hdEnable(unsigned int capability)
  {
    State->IsForceEnabled = capability == 0x4000;
  }
  void hdBeginFrame(unsigned int) {}
  void hdEndFrame(unsigned int)
  {
    if (const int delay = State->Delay)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    }
    for (int i = 0; i < 3; ++i)
    {
      State->Force[i] = State->IsForceEnabled ? NextForce[i] : 0.0;
    }
    if (const unsigned int error = State->FrameError.exchange(0))
    {
      Push(error);
    }
    ++State->Frames;
  }
  HdError hdGetError()
  {
    const std::lock_guard<std::mutex> lock(ErrorMutex);
    HdError error{ 0, 0, 0xFFFFFFFF };
    if (!Errors.empty())
    {
      error = { Errors.front(), -1, 7 };
      Errors.erase(Errors.begin());
    }
    return error;
  }
  const char* hdGetErrorString(unsigned int)
  {
    return "stub error";
  }
  void hdGetIntegerv(unsigned int what, int* values)
  {
    *values = what == 0x2000 ? State->Buttons.load() : what == 0x2555 ? State->Style.load() : 0;
  }
  void hdGetDoublev(unsigned int what, double* values)
  {
    const double identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    const double box[6] = { -210, -110, -85, 210, 205, 130 };
    switch (what)
    {
      case 0x2050:
        for (int i = 0; i < 3; ++i)
        {
          values[i] = State->Position[i];
        }
        break;
      case 0x2052:
        std::memcpy(values, identity, sizeof(identity));
        break;
      case 0x2551:
        if (State->KnowsLimits)
        {
          std::memcpy(values, box, sizeof(box));
        }
        break;
      case 0x2602:
        *values = State->KnowsLimits ? 2.3 : 0.0; // [N/mm]
        break;
      case 0x2603:
        *values = State->KnowsLimits ? 3.3 : 0.0;
        break;
      default:
        break;
    }
    if (!State->KnowsLimits && what >= 0x2551 && what <= 0x2603)
    {
      Push(0x0100);
    }
  }
  void hdSetDoublev(unsigned int what, const double* values)
  {
    if (what == 0x2700)
    {
      std::memcpy(NextForce, values, sizeof(NextForce));
    }
  }
  const char* hdGetString(unsigned int what)
  {
    return what == 0x2501 ? "Touch" : "00042";
  }
  unsigned int hdCheckCalibration()
  {
    return State->Calibration;
  }
  void hdUpdateCalibration(unsigned int style)
  {
    State->UpdatedWith = style;
    if (State->Calibration == 0x5001)
    {
      State->Calibration = 0x5000;
    }
  }
  unsigned long hdScheduleAsynchronous(Callback callback, void* data, unsigned short)
  {
    Scheduled = callback;
    ScheduledData = data;
    return 1;
  }
  void hdUnschedule(unsigned long)
  {
    Scheduled = nullptr;
  }
  void hdStartScheduler()
  {
    Runs = true;
    Scheduler = new std::thread(RunScheduler);
  }
#ifndef STUB_IS_OLD
  void hdStopScheduler()
  {
    Runs = false;
    if (Scheduler)
    {
      Scheduler->join();
      delete Scheduler;
      Scheduler = nullptr;
    }
  }
#endif
}
