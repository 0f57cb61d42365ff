#ifndef Haptics_EmbreeEngine_h
#define Haptics_EmbreeEngine_h

#include "haptics/Surface/CollisionEngine.h"

namespace haptics
{
/// A WideBvh whose order Intel Embree's builder chooses (surface area heuristic, in parallel).
std::unique_ptr<CollisionEngine> MakeEmbreeEngine(const EngineInput& input);
}

#endif
