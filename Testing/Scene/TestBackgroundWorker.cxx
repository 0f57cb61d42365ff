#include "haptics/Scene/BackgroundWorker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

using haptics::BackgroundTask;
using haptics::BackgroundWorker;

namespace
{
/// What the test and a task that it has let go of both know.
struct Signs
{
  std::atomic<bool> HasBegun{ false };
  std::atomic<bool> MayEnd{ false };
  std::atomic<bool> HasEnded{ false };
  std::atomic<bool> WasCancelled{ false };
  std::atomic<int> Destroyed{ 0 };
  std::atomic<std::thread::id> DestroyedOn{};
};

/// Works until it may end, however often its end is asked for.
class StubbornTask : public BackgroundTask
{
public:
  explicit StubbornTask(std::shared_ptr<Signs> signs)
    : Known(std::move(signs))
  {
  }
  ~StubbornTask() override
  {
    this->Known->DestroyedOn = std::this_thread::get_id();
    ++this->Known->Destroyed;
  }

protected:
  void Work() override
  {
    this->Known->HasBegun = true;
    while (!this->Known->MayEnd)
    {
      std::this_thread::yield();
    }
    this->Known->WasCancelled = !this->Report(0.5);
    this->Known->HasEnded = true;
  }

private:
  const std::shared_ptr<Signs> Known;
};

void Await(const std::atomic<bool>& sign)
{
  while (!sign)
  {
    std::this_thread::yield();
  }
}

TEST(BackgroundWorker, GoesWithoutWaitingForTheTaskInWork)
{
  const auto signs = std::make_shared<Signs>();
  const auto next = std::make_shared<Signs>(); // never begun before the worker is gone
  next->MayEnd = true;
  {
    BackgroundWorker worker;
    worker.Start(std::make_shared<StubbornTask>(signs));
    worker.Start(std::make_shared<StubbornTask>(next));
    Await(signs->HasBegun);
  } // would wait for ever
  EXPECT_FALSE(signs->HasEnded);
  signs->MayEnd = true;
  Await(next->HasEnded);
  EXPECT_TRUE(signs->WasCancelled);
  // What it has left goes with the next worker that looks, on the thread of that.
  BackgroundWorker other;
  while (signs->Destroyed + next->Destroyed < 2)
  {
    other.Collect();
  }
  EXPECT_EQ(signs->DestroyedOn.load(), std::this_thread::get_id());
  EXPECT_EQ(next->DestroyedOn.load(), std::this_thread::get_id());
}

TEST(BackgroundWorker, DoesTasksInOrderAndKeepsThemUntilTheyAreCollected)
{
  const auto signs = std::make_shared<Signs>();
  signs->MayEnd = true;
  BackgroundWorker worker;
  worker.Start(std::make_shared<StubbornTask>(signs));
  worker.Wait();
  EXPECT_TRUE(signs->HasEnded);
  EXPECT_FALSE(signs->WasCancelled);
  EXPECT_EQ(signs->Destroyed, 0);
  worker.Collect();
  EXPECT_EQ(signs->Destroyed, 1);
  EXPECT_EQ(signs->DestroyedOn.load(), std::this_thread::get_id());
}
}
