#include "haptics/Scene/BackgroundWorker.h"

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

BackgroundWorker::~BackgroundWorker()
{
  if (!this->Owner.IsHere())
  {
    GiveUp(this->Thread);
    this->Changed.release(); // its end would wait for the thread that waits for it
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const std::shared_ptr<BackgroundTask>& task : this->Waiting)
    {
      task->Cancel();
    }
    this->Ending = true;
  }
  this->Changed->notify_all();
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
}

void BackgroundWorker::Start(std::shared_ptr<BackgroundTask> task)
{
  if (!this->Owner.IsHere())
  {
    task->Run();
    this->Finished.push_back(std::move(task));
    return;
  }
  if (!this->Thread.joinable())
  {
    try
    {
      this->Thread = std::thread([this] { this->Work(); });
    }
    catch (const std::system_error&) // the system has no thread to give: the caller waits
    {
      task->Run();
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Finished.push_back(std::move(task));
      return;
    }
  }
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Waiting.push_back(std::move(task));
  }
  this->Changed->notify_all();
}

void BackgroundWorker::Wait()
{
  if (!this->Owner.IsHere())
  {
    return;
  }
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->Changed->wait(lock, [this] { return this->Waiting.empty(); });
}

void BackgroundWorker::Collect()
{
  std::vector<std::shared_ptr<BackgroundTask>> finished;
  if (this->Owner.IsHere())
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    finished.swap(this->Finished);
  }
}

void BackgroundWorker::Work()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  while (true)
  {
    this->Changed->wait(lock, [this] { return this->Ending || !this->Waiting.empty(); });
    if (this->Waiting.empty())
    {
      return;
    }
    const std::shared_ptr<BackgroundTask>& task = this->Waiting.front(); // a deque keeps its place
    lock.unlock();
    task->Run();
    lock.lock();
    this->Finished.push_back(std::move(this->Waiting.front()));
    this->Waiting.pop_front();
    this->Changed->notify_all();
  }
}
}
