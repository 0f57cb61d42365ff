#ifndef Haptics_JudgedSoak_h
#define Haptics_JudgedSoak_h

#include "SoakOptions.h"
#include "SurfacePath.h"
#include "Trial.h"
#include "haptics/Contact/TouchedSurface.h"

#include <map>
#include <string>
#include <vector>

namespace haptics::testing
{
/// @brief Leads a god-object on SurfacePath's ways over surfaces, with a judge at its side, and
/// prints a table: a row for each scene, and below one for each kind of way.
class JudgedSoak
{
public:
  explicit JudgedSoak(const SoakOptions& options);

  void Run(const std::string& scene, const std::vector<TouchedSurface>& surfaces);
  /// Prints the sums. True where they are good.
  bool Finish();

  static void PrintHead(const char* first, unsigned seed);
  static void Print(const std::string& name, const TrialCount& count);
  /// No crossing, gap, phantom or motion away from the HIP, and at most 1 stuck in 10,000 that are
  /// pressed again (or one in fewer).
  static bool IsGood(const TrialCount& count);
  /// Has the first faults of each kind printed. `name`: of scene and kind of way.
  static void PrintFaults(Trial& trial, std::string name, const unsigned& episode, long most = 3);

private:
  void RunKind(const std::string& scene, const std::vector<TouchedSurface>& surfaces,
    const std::vector<Trial::Part>& parts, SurfacePath& path, SurfacePath::Kind kind,
    TrialCount& count);

  SoakOptions Options;
  TrialCount All;
  std::map<SurfacePath::Kind, TrialCount> OfKinds;
};
}

#endif
