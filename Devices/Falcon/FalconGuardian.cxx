#include "haptics/Devices/Falcon/FalconGuardian.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <system_error>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace haptics
{
namespace
{
/// What the guardian's start needs, given back at the end.
class SpawnSettings
{
public:
  explicit SpawnSettings(int socket)
  {
    posix_spawn_file_actions_init(&this->Actions);
    posix_spawn_file_actions_adddup2(&this->Actions, socket, STDIN_FILENO);
    // No pipe of the program's is to stay open by it.
    for (const int output : { STDOUT_FILENO, STDERR_FILENO })
    {
      posix_spawn_file_actions_addopen(&this->Actions, output, "/dev/null", O_WRONLY, 0);
    }
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
    posix_spawn_file_actions_addclosefrom_np(&this->Actions, STDERR_FILENO + 1);
#endif
    posix_spawnattr_init(&this->Attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&this->Attributes, &signals);
    // What a terminal sends to this process is not for the guardian.
    posix_spawnattr_setflags(&this->Attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSID);
  }
  ~SpawnSettings()
  {
    posix_spawn_file_actions_destroy(&this->Actions);
    posix_spawnattr_destroy(&this->Attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t Actions{};
  posix_spawnattr_t Attributes{};
};
}

std::string FalconGuardian::Find()
{
  namespace fs = std::filesystem;
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&FalconGuardian::Find), &library) == 0 ||
    !library.dli_fname)
  {
    return {};
  }
  std::error_code none;
  const fs::path from = fs::absolute(library.dli_fname, none);
  constexpr int highest = 6; // PREFIX/lib/ARCHITECTURE/... of any package
  fs::path folder = from.parent_path();
  for (int i = 0; i < highest && folder != folder.parent_path(); ++i, folder = folder.parent_path())
  {
    const fs::path program = folder / HAPTICS_GUARDIAN;
    if (access(program.c_str(), X_OK) == 0)
    {
      return program.string();
    }
  }
  return {};
}

bool FalconGuardian::Start(const std::string& program, const std::string& deviceFile)
{
  this->Stop();
  std::array<int, 2> ends{};
  if (program.empty() || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
  {
    return false;
  }
  const SpawnSettings settings(ends[1]);
  std::string file = deviceFile;
  std::string name = program;
  std::string parent = std::to_string(getpid());
  std::array<char*, 4> arguments{ name.data(), file.data(), parent.data(), nullptr };
  pid_t process = 0;
  const int failure = posix_spawn(
    &process, program.c_str(), &settings.Actions, &settings.Attributes, arguments.data(), environ);
  close(ends[1]);
  if (failure != 0)
  {
    close(ends[0]);
    return false;
  }
  this->Socket = ends[0];
  this->Process = process;
  this->Pushes = false;
  return true;
}

void FalconGuardian::Stop()
{
  if (this->Socket < 0)
  {
    return;
  }
  this->Send('q');
  close(this->Socket);
  this->Socket = -1;
  constexpr int patience = 100; // [ms]
  const timespec pause{ 0, 1000000 };
  for (int i = 0; waitpid(static_cast<pid_t>(this->Process), nullptr, WNOHANG) == 0; ++i)
  {
    if (i == patience)
    {
      kill(static_cast<pid_t>(this->Process), SIGKILL);
    }
    nanosleep(&pause, nullptr);
  }
}

void FalconGuardian::Send(char sign) noexcept
{
  // Where it has gone nothing is lost but the guard.
  while (send(this->Socket, &sign, 1, MSG_DONTWAIT | MSG_NOSIGNAL) < 0 && errno == EINTR)
  {
  }
}

void FalconGuardian::SetPushes(bool pushes) noexcept
{
  if (this->Socket >= 0 && this->Pushes != pushes)
  {
    this->Pushes = pushes;
    this->Send(pushes ? '1' : '0');
  }
}
}
