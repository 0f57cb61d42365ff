#include "SoakOptions.h"

#include <cstdio>
#include <cstdlib>

namespace haptics::testing
{
namespace
{
[[noreturn]] void End(const char* program, long shortTicks, long longTicks, int status)
{
  std::fprintf(status ? stderr : stdout,
    "Usage: %s [--ticks N] [--seed N] [--scene NAME] [--kind NAME] [--episode N] [--press N]\n\n"
    "  --ticks N    for each scene and kind of way, at least 1; default %ld, the long form %ld\n"
    "  --seed N     of the random ways and motions; default 1. A failure prints it.\n"
    "  --scene NAME only this scene, as the table names it\n"
    "  --kind NAME  only this kind of way, as the table names it\n"
    "  --episode N  only this stroke, as a failure prints it, and every tick of it\n"
    "  --press N    one in so many ticks in contact is pressed again; 0: none; default 10\n",
    program, shortTicks, longTicks);
  std::exit(status);
}

/// False where it is not a whole number from `least` on, or goes on after it.
bool Read(const char* text, long least, long& number)
{
  char* end = nullptr;
  number = std::strtol(text, &end, 10);
  return end != text && *end == '\0' && number >= least;
}
}

SoakOptions SoakOptions::Parse(int argc, char* argv[], long shortTicks, long longTicks)
{
  SoakOptions options;
  options.Ticks = shortTicks;
  for (int i = 1; i < argc; ++i)
  {
    const std::string name = argv[i];
    if (name == "--help")
    {
      End(argv[0], shortTicks, longTicks, EXIT_SUCCESS);
    }
    const char* const value = i + 1 < argc ? argv[++i] : "";
    long seed = 1;
    long press = 10;
    const bool isGood = (name == "--ticks" && Read(value, 1, options.Ticks)) ||
      (name == "--seed" && Read(value, 0, seed)) || (name == "--scene" && *value) ||
      (name == "--kind" && *value) || (name == "--episode" && Read(value, 0, options.Episode)) ||
      (name == "--press" && Read(value, 0, press));
    if (!isGood)
    {
      std::fprintf(stderr, "wrong: %s %s\n\n", name.c_str(), value);
      End(argv[0], shortTicks, longTicks, EXIT_FAILURE);
    }
    if (name == "--seed")
    {
      options.Seed = static_cast<unsigned>(seed);
    }
    else if (name == "--scene")
    {
      options.Scene = value;
    }
    else if (name == "--kind")
    {
      options.Kind = value;
    }
    else if (name == "--press")
    {
      options.PressEvery = static_cast<int>(press);
    }
  }
  return options;
}
}
