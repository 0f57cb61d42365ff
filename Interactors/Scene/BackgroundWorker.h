#ifndef Haptics_BackgroundWorker_h
#define Haptics_BackgroundWorker_h

#include "haptics/Devices/ProcessOwner.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace haptics
{
/// @brief Work that may be done on another thread, once; its owner reads the outcome when it is
/// done, and may ask for its end before.
class BackgroundTask
{
public:
  virtual ~BackgroundTask() = default;

  /// Does the work on the calling thread.
  void Run();
  /// Asks for the end, which comes some time later. Any thread.
  void Cancel() { this->Cancelled.store(true, std::memory_order_relaxed); }
  /// Whether all of the work's outcome may be read. Any thread.
  bool IsDone() const { return this->Done.load(std::memory_order_acquire); }
  /// 0 to 1. Any thread.
  double Progress() const { return this->Fraction.load(std::memory_order_relaxed); }

protected:
  virtual void Work() = 0;
  /// Reports the progress of the work; false where its end was asked for.
  bool Report(double fraction);

private:
  std::atomic<bool> Cancelled{ false };
  std::atomic<bool> Done{ false };
  std::atomic<double> Fraction{ 0.0 };
};

/// @brief One thread that does tasks in the order in which they came. Its methods are for the
/// thread that made it.
///
/// A task is never destroyed on the worker thread: it may hold the last reference to a vtkObject
/// whose observers expect the GUI thread. The thread starts with the first task and sleeps between
/// tasks. In a child of fork() it has none: what was in work stays undone, and what comes is done
/// by Start().
class BackgroundWorker
{
public:
  BackgroundWorker();
  /// Asks for the end of all tasks, and waits for none: a thread that is still at work ends by
  /// itself, and what it leaves is cleared up by another worker, or when the program ends.
  ~BackgroundWorker();
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;

  /// Where there is no thread to be had the task is done before this returns.
  void Start(std::shared_ptr<BackgroundTask> task);
  /// Waits until all tasks are done.
  void Wait();
  /// Lets go of the tasks that are done.
  void Collect();

private:
  /// What the worker and its thread share; the last of both frees it.
  struct Shared
  {
    std::mutex Mutex;
    std::unique_ptr<std::condition_variable> Changed = std::make_unique<std::condition_variable>();
    std::deque<std::shared_ptr<BackgroundTask>> Waiting; // the first one is in work
    std::vector<std::shared_ptr<BackgroundTask>> Finished;
    bool Ending = false;
    std::atomic<bool> IsOver{ false }; // the thread does nothing any more
  };
  class Retired;

  static void Work(Shared& shared);

  std::thread Thread;
  std::shared_ptr<Shared> State = std::make_shared<Shared>();
  const ProcessOwner Owner;
};
}

#endif
