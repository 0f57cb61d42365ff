// Compiled once for each HAPTICS_LARGEST_NUMBER_OF_PASSES, which GodObject.cxx takes instead of its
// own; GodObject is then a macro for a name of its own, so that all fit into one program.
#include "GodObject.cxx"
#include "GodObjectMethod.h"

namespace haptics::testing
{
template <>
MethodPointer MakeCertifiedOfFewPasses<HAPTICS_LARGEST_NUMBER_OF_PASSES>(
  const SurfaceList& surfaces)
{
  return std::make_unique<GodObjectMethod<GodObject>>(surfaces);
}
}
