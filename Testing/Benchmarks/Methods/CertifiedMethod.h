#ifndef Haptics_CertifiedMethod_h
#define Haptics_CertifiedMethod_h

#include "ContactMethod.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/TriangleSurface.h"

#include <memory>
#include <vector>

namespace haptics::testing
{
using SurfaceList = std::vector<std::shared_ptr<const TriangleSurface>>;

/// This project's god-object. `passes`: GodObject::SetPassLimit(); one pass is the paper's two-step
/// transition over convex edges (Fig. 5), spread over two ticks. `tip`: radius of a ball [m].
MethodPointer MakeCertified(
  const SurfaceList& surfaces, int passes = GodObject::LargestNumberOfPasses, double tip = 0.0);
}

#endif
