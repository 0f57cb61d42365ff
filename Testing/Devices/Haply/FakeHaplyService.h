#ifndef Haptics_FakeHaplyService_h
#define Haptics_FakeHaplyService_h

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

/// One Inverse3 that the fake service has.
struct FakeInverse3
{
  std::string Id = "049D";
  std::string Permutation = "XYZ";
  bool IsCalibrated = true;
  bool IsPowered = true;
  bool IsStarted = true;
  bool HasPosition = true;
  std::array<double, 3> Position{ { 0.0, -0.12, 0.15 } }; ///< the service's axes [m]
  std::array<double, 3> Force{};                          ///< it got last [N]
};

/// @brief Speaks the Inverse Service's protocol on a port of the loopback: GET /version and the
/// simulation channel, one state for each message. Any thread; injects faults.
class FakeHaplyService
{
public:
  /// Takes a port, a free one where it is 0; answers from Start() on.
  explicit FakeHaplyService(std::string version = "3.5.0.0", int port = 0);
  ~FakeHaplyService();
  FakeHaplyService(const FakeHaplyService&) = delete;
  FakeHaplyService& operator=(const FakeHaplyService&) = delete;

  void Start();
  /// Ends all connections, as a service that is stopped or crashes.
  void Stop();
  int GetPort() const { return this->Port; }

  /// Calls `change` with the devices, of which it may add and remove.
  template <typename Function>
  void With(Function change)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    change(this->Devices);
  }
  std::array<double, 3> GetForce(std::size_t device = 0);

  std::string Version;               ///< what GET /version says; empty: 404
  std::string Greeting;              ///< instead of the inventory, where not empty
  std::atomic<bool> IsMute{ false }; ///< answers nothing any more
  std::atomic<int> Swallowed{ 0 };   ///< answers that are still to be left out
  std::atomic<int> Damaged{ 0 };     ///< answers that are still to be damaged
  std::atomic<int> Delay{ 0 };       ///< of each answer [ms]
  std::vector<int> Delays;           ///< of the next ones instead [ms]; in With()
  std::atomic<bool> Counts{ false }; ///< how many came: the first coordinate, in MessageStep
  static constexpr double MessageStep = 1e-6; ///< [m]
  std::atomic<bool> HasGrip{ true };
  std::atomic<unsigned int> Buttons{ 0 };
  std::atomic<int> Messages{ 0 }; ///< that came
  std::atomic<int> Forces{ 0 };   ///< that were understood
  std::atomic<bool> HasProfile{ false };
  std::atomic<int> Clients{ 0 };

private:
  struct Connections;

  void Accept();
  void Talk(std::size_t number);
  int NextDelay();
  std::string State(bool isFull, int session);
  void Take(const std::string& text, int session);

  int Port = 0;
  std::mutex Mutex;
  std::vector<FakeInverse3> Devices{ FakeInverse3() };
  int Owner = 0; ///< the session that sends forces
  std::atomic<bool> IsStopping{ false };
  std::unique_ptr<Connections> Self;
  std::thread Thread;
};

#endif
