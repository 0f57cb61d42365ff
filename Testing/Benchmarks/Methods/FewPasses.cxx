// Compiled once for each HAPTICS_LARGEST_NUMBER_OF_PASSES, which the god-object takes instead of
// its own; GodObject is then a macro for a name of its own, so that all fit into one program.
#include "GodObjectMethod.h"
#include "haptics/Contact/GodObject.cxx"
#include "haptics/Contact/GodObjectMaterial.cxx"
#include "haptics/Contact/GodObjectMotion.cxx"
#include "haptics/Contact/GodObjectRelease.cxx"

namespace haptics::testing
{
template <>
MethodPointer MakeCertifiedOfFewPasses<HAPTICS_LARGEST_NUMBER_OF_PASSES>(
  const SurfaceList& surfaces)
{
  return std::make_unique<GodObjectMethod<GodObject>>(surfaces);
}
}
