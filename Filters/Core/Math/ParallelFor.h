#ifndef Haptics_ParallelFor_h
#define Haptics_ParallelFor_h

#include "haptics/Math/ProgressCall.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace haptics
{
/// Calls `work(first, last)` for pieces of [0, count) of `piece` each, the last one of what
/// remains, on as many threads as the machine has cores, the calling one among them. Pieces are the
/// same on every machine; which thread does which is not, so each writes only where no other one
/// does. What a piece throws is thrown on, once no thread is at work any more. `progress`, which
/// may be empty, is called between the calling thread's pieces, and every few milliseconds while it
/// waits for the others'; false where it has stopped the work: then pieces were left out. Not for
/// the servo thread.
template <class Work>
bool ParallelFor(
  std::size_t count, std::size_t piece, const Work& work, const ProgressCall& progress = {})
{
  const std::size_t pieces = (count + piece - 1) / piece;
  const std::size_t threads =
    std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), pieces);
  std::atomic<std::size_t> next{ 0 };
  std::atomic<std::size_t> done{ 0 };
  std::atomic<bool> isStopped{ false };
  const auto takePiece = [&]
  {
    const std::size_t i = next++;
    if (i >= pieces || isStopped)
    {
      return false;
    }
    try
    {
      work(i * piece, std::min(count, (i + 1) * piece));
    }
    catch (...)
    {
      isStopped = true;
      throw;
    }
    ++done;
    return true;
  };
  const auto report = [&]
  {
    if (progress && !isStopped &&
      !progress(static_cast<double>(done) / static_cast<double>(pieces)))
    {
      isStopped = true;
    }
  };
  std::vector<std::future<void>> helpers; // which their destructors wait for
  try
  {
    for (std::size_t i = 1; i < threads; ++i)
    {
      helpers.push_back(std::async(std::launch::async,
        [&]
        {
          while (takePiece())
          {
          }
        }));
    }
  }
  catch (const std::system_error&)
  {
    // No more threads are to be had: the others do it.
  }
  while (takePiece())
  {
    report();
  }
  for (std::future<void>& helper : helpers)
  {
    while (helper.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready)
    {
      report();
    }
    helper.get();
  }
  return !isStopped;
}
}

#endif
