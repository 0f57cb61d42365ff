#ifndef Haptics_StubHd_h
#define Haptics_StubHd_h

#include <atomic>

/// What the stub of libHD.so does and what its device got. In memory that a test may share with
/// another process.
struct StubHdState
{
  std::atomic<double> Position[3]{}; ///< [mm]
  std::atomic<double> Force[3]{};    ///< sent by the last frame [N]
  std::atomic<unsigned int> InitError{ 0 };
  std::atomic<unsigned int> Calibration{ 0x5000 };
  std::atomic<int> Style{ 4 }; ///< inkwell
  std::atomic<unsigned int> UpdatedWith{ 0 };
  std::atomic<unsigned int> FrameError{ 0 }; ///< pushed once by the next frame
  std::atomic<bool> IsStalled{ false };      ///< the scheduler calls nobody
  std::atomic<int> Delay{ 0 };               ///< of each frame [ms]
  std::atomic<int> Buttons{ 0 };
  std::atomic<int> Frames{ 0 };
  std::atomic<bool> IsForceEnabled{ false };
  std::atomic<bool> IsOpen{ false };
  std::atomic<bool> KnowsLimits{ true };
  char Name[64] = {}; ///< asked for last
};

#endif
