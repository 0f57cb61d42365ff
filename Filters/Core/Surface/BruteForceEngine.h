#ifndef Haptics_BruteForceEngine_h
#define Haptics_BruteForceEngine_h

#include "haptics/Surface/CollisionEngine.h"

namespace haptics
{
/// Looks at the bounds of every triangle: the paper's collision detection.
std::unique_ptr<CollisionEngine> MakeBruteForceEngine(const EngineInput& input);
}

#endif
