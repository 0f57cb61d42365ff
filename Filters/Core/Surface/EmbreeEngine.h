#ifndef EmbreeEngine_h
#define EmbreeEngine_h

#include "CollisionEngine.h"

namespace haptics
{
/// Intel Embree's bounding volume hierarchy over padded triangle bounds.
std::unique_ptr<CollisionEngine> MakeEmbreeEngine(const EngineInput& input);
}

#endif
