// Leads balls on ways that seek what is hard on a surface, with a judge at their side.
#include "JudgedBallSoak.h"
#include "SoakScenes.h"

using namespace haptics::testing;

int main(int argc, char* argv[])
{
  const SoakOptions options = SoakOptions::Parse(argc, argv, 20, 2000);
  JudgedBallSoak soak(options);
  for (const SoakScene& scene : AllSoakScenes())
  {
    if (options.Chooses(scene.Name.c_str()))
    {
      soak.Run(scene.Name, scene.Make());
    }
  }
  return soak.Finish() ? 0 : 1;
}
