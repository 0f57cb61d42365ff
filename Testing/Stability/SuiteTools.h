#ifndef Haptics_SuiteTools_h
#define Haptics_SuiteTools_h

#include "AnalyticSurfaces.h"
#include "Scenes.h"

#include <algorithm>
#include <cmath>

namespace haptics::testing
{
/// The scene of that name; the suite's own scenes are all there.
inline const Scene& SceneOf(const std::string& name)
{
  const auto& all = AllScenes();
  return *std::find_if(
    all.begin(), all.end(), [&name](const Scene& scene) { return scene.Name == name; });
}

/// A body that presses on a table, with a point or a ball. `damping`: b [N s/m]; `period`: T [s].
inline PressedScene OnPlane(double damping = 0.35, double period = 1e-3, double tip = 0.0)
{
  PressedScene scene;
  scene.Make = [tip]
  { return tip > 0.0 ? CertifiedBall(Square(0.5), tip) : Certified(Square(0.5)); };
  scene.Start = { 0, 0.001, tip + 1e-4 };
  scene.Direction = { 0, 0, -1 };
  scene.Nudge = { 0, 0, -1 };
  scene.Damping = damping;
  scene.Periods = { period };
  return scene;
}

/// The largest change of the force from one tick to the next [N].
inline double LargestStep(const Trace& trace)
{
  double largest = 0.0;
  for (std::size_t i = 1; i < trace.size(); ++i)
  {
    largest = std::max(largest, Length(trace[i].Force - trace[i - 1].Force));
  }
  return largest;
}

/// From the lowest to the highest place of the HIP along z over the last `ticks` [m].
inline double Swing(const Trace& trace, std::size_t ticks)
{
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (std::size_t i = trace.size() - ticks; i < trace.size(); ++i)
  {
    low = std::min(low, trace[i].Hip[2]);
    high = std::max(high, trace[i].Hip[2]);
  }
  return high - low;
}
}

#endif
