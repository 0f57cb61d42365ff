#ifndef Haptics_SoakOptions_h
#define Haptics_SoakOptions_h

#include <string>

namespace haptics::testing
{
/// @brief The command line that soaks share.
struct SoakOptions
{
  long Ticks = 0;      ///< for each scene and kind of way, >= 1
  unsigned Seed = 1;   ///< of what is random
  std::string Scene;   ///< only this one; empty: all
  std::string Kind;    ///< only this kind of way; empty: all
  long Episode = -1;   ///< only this one of a judged soak, every tick printed; < 0: all
  int PressEvery = 10; ///< of so many contact ticks of a judged soak one is pressed again; 0: none

  bool Chooses(const char* scene) const { return this->Scene.empty() || this->Scene == scene; }

  /// Of a program's arguments; by default the short form. After `--help`, or where an option is
  /// wrong, prints what there is and ends the program.
  static SoakOptions Parse(int argc, char* argv[], long shortTicks, long longTicks);
};
}

#endif
