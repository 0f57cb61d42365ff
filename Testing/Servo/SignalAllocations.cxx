// Ends with 1 where the signal handlers of the servo's library allocate: in the middle of an
// allocation of their own thread they would wait for it for ever. As Python and ParaView do it, the
// library is loaded while the program runs, and the signal comes to a thread new to it.
//
// usage: HapticsSignalAllocations LIBRARY
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <thread>

#include <dlfcn.h>
#include <malloc.h>

int main(int argc, char* argv[])
{
  void* const library = argc > 1 ? dlopen(argv[1], RTLD_NOW) : nullptr;
  void* const install =
    library ? dlsym(library, "_ZN7haptics13EmergencyStop7InstallEv") : nullptr; // Install()
  if (!install)
  {
    std::fprintf(stderr, "%s\n", argc > 1 ? dlerror() : "usage: HapticsSignalAllocations LIBRARY");
    return 2;
  }
  std::signal(SIGTERM, [](int) {}); // called by the handler that takes its place
  reinterpret_cast<void (*)()>(install)();
  std::size_t allocated = 0;
  std::thread(
    [&]
    {
      const std::size_t before = mallinfo2().uordblks;
      raise(SIGTERM);
      allocated = mallinfo2().uordblks - before;
    })
    .join();
  std::printf("%zu bytes\n", allocated);
  return allocated == 0 ? 0 : 1;
}
