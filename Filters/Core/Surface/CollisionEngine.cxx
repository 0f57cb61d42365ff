#include "haptics/Surface/CollisionEngine.h"

#include "haptics/Surface/BruteForceEngine.h"
#include "haptics/Surface/EmbreeEngine.h"

#include <atomic>

namespace haptics
{
namespace
{
std::atomic<EngineFactory> ExactEngineFactory{ nullptr };
}

void SetExactEngineFactory(EngineFactory factory)
{
  ExactEngineFactory = factory;
}

std::unique_ptr<CollisionEngine> MakeEngine(EngineKind kind, const EngineInput& input)
{
  // Where a scan of all bounds and a descent of the tree take the same time.
  constexpr std::size_t crossover = 64;
  switch (kind)
  {
    case EngineKind::Automatic:
      return input.Triangles.size() <= crossover ? MakeBruteForceEngine(input)
                                                 : MakeEmbreeEngine(input);
    case EngineKind::BruteForce:
      return MakeBruteForceEngine(input);
    case EngineKind::Embree:
      return MakeEmbreeEngine(input);
    case EngineKind::Exact:
      if (const EngineFactory make = ExactEngineFactory)
      {
        return make(input);
      }
      break;
  }
  return nullptr;
}
}
