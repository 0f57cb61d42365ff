// Stands for Force Dimension's libdrd.so: the same symbols, and faults.
#include "StubDhd.h"

#include <chrono>
#include <thread>

namespace
{
StubDhdState Own;
StubDhdState* State = &Own;
const char* LastError = "no error";

int Fail(const char* reason)
{
  LastError = reason;
  return -1;
}
}

extern "C"
{
  void StubDhdUse(StubDhdState* state)
  {
    State = state;
  }

  int dhdGetDeviceCount()
  {
    return State->Count;
  }
  int drdOpenID(char index)
  {
    if (!State->MayOpen)
    {
      return Fail("device already in use");
    }
    State->IsOpen = true;
    return index;
  }
  int drdClose(char)
  {
    State->IsOpen = false;
    return 0;
  }
  bool drdIsSupported(char)
  {
    return State->IsSupported;
  }
  bool drdIsInitialized(char)
  {
    return State->IsInitialized;
  }
  int drdAutoInit(char)
  {
    ++State->AutoInitializations;
    if (State->FailsToInitialize)
    {
      return Fail("timeout");
    }
    State->IsInitialized = true;
    return 0;
  }
#ifndef STUB_IS_OLD
  int drdStop(bool, char)
  {
    State->IsRegulating = false;
    return 0;
  }
#endif
  const char* dhdGetSystemName(char)
  {
    return "omega.3";
  }
  int dhdGetSerialNumber(unsigned short* number, char)
  {
    *number = 1234;
    return 0;
  }
  const char* dhdErrorGetLastStr()
  {
    return LastError;
  }
  int dhdEnableForce(unsigned char isOn, char)
  {
    State->IsForceEnabled = isOn != 0;
    for (auto& component : State->Force)
    {
      component = State->IsForceEnabled ? component.load() : 0.0;
    }
    return 0;
  }
  int dhdGetPosition(double* x, double* y, double* z, char)
  {
    while (State->Hangs)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (const int delay = State->Delay)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    }
    if (State->FailsToRead)
    {
      return Fail("communication error");
    }
    *x = State->Position[0];
    *y = State->Position[1];
    *z = State->Position[2];
    return 1; // the time guard: no newer position, no error
  }
  int dhdSetForce(double x, double y, double z, char)
  {
    if (State->FailsToSetForce)
    {
      return Fail("communication error");
    }
    State->Force[0] = State->IsForceEnabled ? x : 0.0;
    State->Force[1] = State->IsForceEnabled ? y : 0.0;
    State->Force[2] = State->IsForceEnabled ? z : 0.0;
    return State->IsSaturated ? 2 : 0;
  }
  unsigned int dhdGetButtonMask(char)
  {
    return State->Buttons;
  }
  int dhdGetOrientationFrame(double matrix[3][3], char)
  {
    // A quarter turn about the vendor's z, which is up.
    const double turn[3][3] = { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } };
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        matrix[i][j] = turn[i][j];
      }
    }
    return 0;
  }
  bool dhdHasWrist(char)
  {
    return true;
  }
  void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision)
  {
    *major = State->Major;
    *minor = *release = *revision = 0;
  }
}
