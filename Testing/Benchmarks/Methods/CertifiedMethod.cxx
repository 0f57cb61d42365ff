#include "GodObjectMethod.h"

namespace haptics::testing
{
MethodPointer MakeCertified(const SurfaceList& surfaces)
{
  return std::make_unique<GodObjectMethod<GodObject>>(surfaces);
}
}
