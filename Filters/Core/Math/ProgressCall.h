#ifndef Haptics_ProgressCall_h
#define Haptics_ProgressCall_h

#include <functional>

namespace haptics
{
/// Called with the progress of some work, from 0 to 1, on the thread that asked for it; false stops
/// the work. An empty one is never called.
using ProgressCall = std::function<bool(double)>;

/// Whether the work goes on.
inline bool ReportProgress(const ProgressCall& progress, double fraction)
{
  return !progress || progress(fraction);
}

/// The call for a part of the work, which is the whole's from one fraction to another. The whole's
/// call has to outlive it.
inline ProgressCall PartOf(const ProgressCall& whole, double from, double to)
{
  return whole ? [&whole, from, to](double fraction)
  { return whole(from + fraction * (to - from)); }
               : ProgressCall();
}
}

#endif
