#include "haptics/Scene/BackgroundWorker.h"

#include <iterator>
#include <list>
#include <system_error>
#include <utility>

namespace haptics
{
void BackgroundTask::Run()
{
  this->Work();
  this->Fraction.store(1.0, std::memory_order_relaxed);
  this->Done.store(true, std::memory_order_release);
}

bool BackgroundTask::Report(double fraction)
{
  this->Fraction.store(fraction, std::memory_order_relaxed);
  return !this->Cancelled.load(std::memory_order_relaxed);
}

/// The threads of workers that are gone while they were at work.
class BackgroundWorker::Retired
{
public:
  static Retired& All()
  {
    static Retired retired;
    return retired;
  }
  /// At the end of the program, when nothing else is left to wait.
  ~Retired()
  {
    for (Entry& entry : this->Entries)
    {
      Clear(entry);
    }
  }
  void Add(std::thread thread, std::shared_ptr<Shared> state)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Entries.push_back({ std::move(thread), std::move(state), ProcessOwner() });
  }
  void Collect()
  {
    std::list<Entry> over;
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
      {
        const auto next = std::next(entry);
        if (entry->State->IsOver.load(std::memory_order_acquire) || !entry->Owner.IsHere())
        {
          over.splice(over.end(), this->Entries, entry);
        }
        entry = next;
      }
    }
    for (Entry& entry : over)
    {
      Clear(entry);
    }
  }

private:
  struct Entry
  {
    std::thread Thread;
    std::shared_ptr<Shared> State;
    ProcessOwner Owner;
  };
  static void Clear(Entry& entry)
  {
    if (entry.Owner.IsHere())
    {
      entry.Thread.join();
    }
    else
    {
      GiveUp(entry.Thread);
      new std::shared_ptr<Shared>(entry.State);
    }
  }

  std::mutex Mutex;
  std::list<Entry> Entries;
};

BackgroundWorker::BackgroundWorker()
{
  Retired::All().Collect();
}

BackgroundWorker::~BackgroundWorker()
{
  if (!this->Owner.IsHere())
  {
    GiveUp(this->Thread);
    // Its condition variable's end would wait for the thread that waits for it.
    new std::shared_ptr<Shared>(std::move(this->State));
    return;
  }
  if (!this->Thread.joinable())
  {
    return;
  }
  bool isAtWork = false;
  {
    const std::lock_guard<std::mutex> lock(this->State->Mutex);
    isAtWork = !this->State->Waiting.empty();
    for (const std::shared_ptr<BackgroundTask>& task : this->State->Waiting)
    {
      task->Cancel();
    }
    this->State->Ending = true;
  }
  this->State->Changed->notify_all();
  if (isAtWork)
  {
    Retired::All().Add(std::move(this->Thread), this->State);
  }
  else
  {
    this->Thread.join();
  }
}

void BackgroundWorker::Start(std::shared_ptr<BackgroundTask> task)
{
  Shared& shared = *this->State;
  if (!this->Owner.IsHere())
  {
    task->Run();
    shared.Finished.push_back(std::move(task));
    return;
  }
  if (!this->Thread.joinable())
  {
    try
    {
      this->Thread = std::thread([state = this->State] { Work(*state); });
    }
    catch (const std::system_error&) // the system has no thread to give: the caller waits
    {
      task->Run();
      const std::lock_guard<std::mutex> lock(shared.Mutex);
      shared.Finished.push_back(std::move(task));
      return;
    }
  }
  {
    const std::lock_guard<std::mutex> lock(shared.Mutex);
    shared.Waiting.push_back(std::move(task));
  }
  shared.Changed->notify_all();
}

void BackgroundWorker::Wait()
{
  if (!this->Owner.IsHere())
  {
    return;
  }
  std::unique_lock<std::mutex> lock(this->State->Mutex);
  this->State->Changed->wait(lock, [this] { return this->State->Waiting.empty(); });
}

void BackgroundWorker::Collect()
{
  Retired::All().Collect();
  std::vector<std::shared_ptr<BackgroundTask>> finished;
  if (this->Owner.IsHere())
  {
    const std::lock_guard<std::mutex> lock(this->State->Mutex);
    finished.swap(this->State->Finished);
  }
}

void BackgroundWorker::Work(Shared& shared)
{
  std::unique_lock<std::mutex> lock(shared.Mutex);
  while (true)
  {
    shared.Changed->wait(lock, [&shared] { return shared.Ending || !shared.Waiting.empty(); });
    if (shared.Waiting.empty())
    {
      shared.IsOver.store(true, std::memory_order_release);
      return;
    }
    const std::shared_ptr<BackgroundTask>& task = shared.Waiting.front(); // a deque keeps its place
    lock.unlock();
    task->Run();
    lock.lock();
    shared.Finished.push_back(std::move(shared.Waiting.front()));
    shared.Waiting.pop_front();
    shared.Changed->notify_all();
  }
}
}
