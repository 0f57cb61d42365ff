#ifndef Haptics_EmbreeEngine_h
#define Haptics_EmbreeEngine_h

#include "haptics/Surface/CollisionEngine.h"

namespace haptics
{
/// Intel Embree's bounding volume hierarchy over padded triangle bounds.
std::unique_ptr<CollisionEngine> MakeEmbreeEngine(const EngineInput& input);
}

#endif
