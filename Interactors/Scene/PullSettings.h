#ifndef Haptics_PullSettings_h
#define Haptics_PullSettings_h

#include "haptics/Scene/PatchPlanner.h"

#include <algorithm>
#include <optional>
#include <string>

namespace haptics
{
class BackgroundWorker;

/// How long a surface may be on its way between two updates [s]. What would take longer is put in
/// its new place at once and pushes nothing.
constexpr double LongestMotion = 0.1;

/// How the surfaces of a scene take in what has changed.
struct PullSettings
{
  /// Builds in the background; null: each Pull() builds what it needs.
  BackgroundWorker* Worker = nullptr;
  /// Whether a servo ticks; where not, what moves is in its new place at once.
  bool IsLive = false;
  /// Whether it does so in real time, and not only while somebody steps it.
  bool IsRunning = false;
  /// Whether it has what was published last; else a snapshot that it has not seen must not be
  /// deformed.
  bool IsTaken = false;
  double Now = 0.0;      ///< the servo's time [s]
  double Interval = 0.0; ///< since the Pull() before [s]
  double Scale = 1.0;    ///< of the workspace [world unit / m in the hand]
  /// World frame; none while no servo has ticked.
  std::optional<HandState> Hand = std::nullopt;

  /// Of a surface that pushes a hand, in the hand [m/s].
  static constexpr double LargestSpeed = 5.0;
  /// How long a motion takes: while one comes with each update, or with every other one, the time
  /// from one to the next. A surface whose next update comes later than LongestMotion has rested
  /// before it.
  double DurationSince(double last) const
  {
    const double since = this->Now - last;
    const double duration = since > 0.0 && since <= LongestMotion ? since : this->Interval;
    return std::clamp(duration, 0.0, LongestMotion);
  }
};

/// What a surface has to say after a Pull(): what was refused, and what its user should know
/// besides.
struct PullReport
{
  std::string Error;
  std::string Notice; ///< whole sentences

  void Fail(const std::string& text) { Append(this->Error, text); }
  void Note(const std::string& text) { Append(this->Notice, text); }

private:
  static void Append(std::string& all, const std::string& text)
  {
    all += (all.empty() || text.empty() ? "" : " ") + text;
  }
};
}

#endif
