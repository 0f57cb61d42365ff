// Runs tests of drivers, which take a force away after 20 ms of silence and give up a device that
// is silent for 0.2 s; they exchange a packet each millisecond, between several threads. A busy
// machine may leave those that stand for hardware or servo waiting for so long: then the driver
// does what it has to, and a test that goes on with the device cannot pass. So threads besides
// measure how late the machine wakes them. A test that fails while that was more than 5 ms runs
// again, five times at most; one that fails otherwise has failed.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

namespace
{
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds LongestDelay{ 5 };
constexpr int NumberOfMeters = 4; // a busy machine is not late for each thread
constexpr int MostAttempts = 5;
constexpr const char* AttemptVariable = "HAPTICS_TEST_ATTEMPT";

/// By how much the machine has woken a thread too late. Never ends: a test's child process, which
/// has no such threads, ends by std::exit().
class DelayMeter
{
public:
  DelayMeter()
  {
    for (int i = 0; i < NumberOfMeters; ++i)
    {
      std::thread([this] { this->Measure(); }).detach();
    }
  }
  void Restart() { this->Longest = steady_clock::duration::zero(); }
  milliseconds GetLongest() const
  {
    return std::chrono::duration_cast<milliseconds>(this->Longest.load());
  }

private:
  [[noreturn]] void Measure()
  {
    while (true)
    {
      const auto due = steady_clock::now() + milliseconds(2);
      std::this_thread::sleep_until(due);
      const steady_clock::duration delay = steady_clock::now() - due;
      steady_clock::duration longest = this->Longest.load();
      while (delay > longest && !this->Longest.compare_exchange_weak(longest, delay))
      {
      }
    }
  }

  std::atomic<steady_clock::duration> Longest{ steady_clock::duration::zero() };
};

/// Collects the tests that failed, and whether the machine was too busy in all of them.
class Failures : public testing::EmptyTestEventListener
{
public:
  void OnTestStart(const testing::TestInfo&) override { this->Meter->Restart(); }
  void OnTestEnd(const testing::TestInfo& test) override
  {
    if (test.result()->Failed())
    {
      const auto delay = static_cast<long long>(this->Meter->GetLongest().count());
      std::printf("The machine woke a thread %lld ms too late during this test.\n", delay);
      this->Names +=
        (this->Names.empty() ? "" : ":") + std::string(test.test_suite_name()) + "." + test.name();
      this->WasBusy = this->WasBusy && this->Meter->GetLongest() > LongestDelay;
    }
  }

  std::string Names;
  bool WasBusy = true;

private:
  DelayMeter* const Meter = new DelayMeter;
};
}

int main(int argc, char** argv)
{
  const std::vector<char*> arguments(argv, argv + argc);
  testing::InitGoogleTest(&argc, argv);
  auto* const failures = new Failures; // GoogleTest's from here on
  testing::UnitTest::GetInstance()->listeners().Append(failures);
  const int status = RUN_ALL_TESTS();
  const char* const before = std::getenv(AttemptVariable);
  const int attempt = before ? std::atoi(before) : 1;
  if (status == 0 || failures->Names.empty() || !failures->WasBusy || attempt == MostAttempts)
  {
    return status;
  }
  std::printf("Attempt %d of %d: %s\n", attempt + 1, MostAttempts, failures->Names.c_str());
  std::fflush(nullptr);
  setenv(AttemptVariable, std::to_string(attempt + 1).c_str(), 1);
  std::string filter = "--gtest_filter=" + failures->Names;
  std::vector<char*> again{ arguments[0], filter.data(), nullptr };
  execv("/proc/self/exe", again.data());
  return status;
}
