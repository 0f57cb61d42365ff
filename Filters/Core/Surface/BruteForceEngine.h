#ifndef BruteForceEngine_h
#define BruteForceEngine_h

#include "CollisionEngine.h"

namespace haptics
{
/// Looks at the bounds of every triangle: the paper's collision detection.
std::unique_ptr<CollisionEngine> MakeBruteForceEngine(const EngineInput& input);
}

#endif
