#ifndef Haptics_StubDhd_h
#define Haptics_StubDhd_h

#include <atomic>

/// What the stub of libdrd.so does and what its device got. In memory that a test may share with
/// another process. The vendor's axes.
struct StubDhdState
{
  std::atomic<double> Position[3]{}; ///< [m]
  std::atomic<double> Force[3]{};    ///< [N]
  std::atomic<int> Count{ 1 };
  std::atomic<bool> MayOpen{ true };
  std::atomic<bool> IsSupported{ true };
  std::atomic<bool> IsInitialized{ true };
  std::atomic<bool> FailsToInitialize{ false };
  std::atomic<int> AutoInitializations{ 0 };
  std::atomic<bool> IsRegulating{ true };
  std::atomic<bool> IsForceEnabled{ false };
  std::atomic<bool> FailsToSetForce{ false };
  std::atomic<bool> FailsToRead{ false };
  std::atomic<bool> IsSaturated{ false };
  std::atomic<bool> Hangs{ false };
  std::atomic<int> Delay{ 0 }; ///< of each reading [ms]
  std::atomic<unsigned int> Buttons{ 0 };
  std::atomic<int> Major{ 3 };
  std::atomic<bool> IsOpen{ false };
};

#endif
