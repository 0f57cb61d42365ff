#include "haptics/Scene/JumpNotice.h"

#include <sstream>
#include <utility>

namespace haptics
{
void JumpNotice::Look(
  const char* what, double way, const PullSettings& settings, PullReport& report)
{
  const bool isJump = way > 0.0;
  if (std::exchange(this->WasGiven, isJump) || !isJump)
  {
    return;
  }
  std::ostringstream text;
  text.precision(3);
  text << what << " was moved by " << way / settings.Scale
       << " m in the hand from one update to the next, where a hand can be pushed by "
       << PullSettings::LargestSpeed * LongestMotion << " m at most (" << PullSettings::LargestSpeed
       << " m/s for " << LongestMotion
       << " s). It was put in its new place at once and has pushed nothing. "
       << "Move it in smaller steps, or let the device reach farther (ScaleWorkspace).";
  report.Note(text.str());
}
}
