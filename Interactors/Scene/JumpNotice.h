#ifndef Haptics_JumpNotice_h
#define Haptics_JumpNotice_h

#include "haptics/Scene/PullSettings.h"

namespace haptics
{
/// @brief Says that something was moved too fast to push a hand: once, until a motion is no jump.
class JumpNotice
{
public:
  /// `what` was moved by `way` [world unit]; 0: it was no jump.
  void Look(const char* what, double way, const PullSettings& settings, PullReport& report);

private:
  bool WasGiven = false;
};
}

#endif
