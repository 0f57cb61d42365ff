#ifndef Haptics_HipPath_h
#define Haptics_HipPath_h

#include "haptics/Math/Vec3.h"

#include <random>
#include <string>

namespace haptics::testing
{
/// @brief Ways of a HIP around a surface at the origin: metres, one place a tick of 1 ms.
class HipPath
{
public:
  enum Kind
  {
    Smooth,     ///< a wandering direction at a breathing depth, rounded as encoders do
    Jitter,     ///< trembles about places anywhere
    Jump,       ///< anywhere in every tick
    AlongLines, ///< sweeps exactly along the lines of a mesh of 8 cells across
    Plunge,     ///< straight through everything at 5 m/s
    NumberOfKinds
  };
  static const char* NameOf(Kind kind);
  /// The name without spaces.
  static std::string IdentifierOf(Kind kind);

  /// `reach` is about the size of the surface [m].
  HipPath(Kind kind, double reach, unsigned seed);
  Vec3 Next();

private:
  double Normal();
  Vec3 Normals();
  Vec3 Anywhere();
  Vec3 NextSmooth();
  Vec3 NextAlongLines();

  Kind Way;
  double Reach;
  std::mt19937 Random;
  long Tick = 0;
  Vec3 Direction{};
  Vec3 Spin{};
  Vec3 Base{};
};
}

#endif
