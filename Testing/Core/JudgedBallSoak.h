#ifndef Haptics_JudgedBallSoak_h
#define Haptics_JudgedBallSoak_h

#include "BallTrial.h"
#include "SoakOptions.h"
#include "SurfacePath.h"
#include "haptics/Contact/TouchedSurface.h"

#include <string>
#include <vector>

namespace haptics::testing
{
/// @brief JudgedSoak for balls of three sizes, with BallTrial at their side.
class JudgedBallSoak
{
public:
  explicit JudgedBallSoak(const SoakOptions& options);

  void Run(const std::string& scene, const std::vector<TouchedSurface>& surfaces);
  /// Prints the sums. True where they are good.
  bool Finish();

private:
  BallCount RunKind(const std::string& scene, const std::vector<TouchedSurface>& surfaces,
    SurfacePath& path, SurfacePath::Kind kind, double share);

  SoakOptions Options;
  BallCount All;
  std::vector<BallCount> OfKinds;
};
}

#endif
