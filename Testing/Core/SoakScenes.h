#ifndef Haptics_SoakScenes_h
#define Haptics_SoakScenes_h

#include "haptics/Contact/TouchedSurface.h"

#include <functional>
#include <string>
#include <vector>

namespace haptics::testing
{
/// @brief Surfaces that soaks move over: those that break methods.
struct SoakScene
{
  std::string Name;
  std::function<std::vector<TouchedSurface>()> Make;
  /// HipPath's ways go as far as this from the origin [m]; 0: they are not made here.
  double Reach = 0.0;
};

const std::vector<SoakScene>& AllSoakScenes();
}

#endif
