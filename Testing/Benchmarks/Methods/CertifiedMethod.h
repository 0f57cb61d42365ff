#ifndef Haptics_CertifiedMethod_h
#define Haptics_CertifiedMethod_h

#include "ContactMethod.h"
#include "haptics/Surface/TriangleSurface.h"

#include <memory>
#include <vector>

namespace haptics::testing
{
using SurfaceList = std::vector<std::shared_ptr<const TriangleSurface>>;

/// This project's god-object, as it is shipped.
MethodPointer MakeCertified(const SurfaceList& surfaces);

/// The same source compiled to make at most `Passes` passes an update: 1, 2 or 4. One pass is the
/// paper's two-step transition over convex edges (Fig. 5), spread over two ticks.
template <int Passes>
MethodPointer MakeCertifiedOfFewPasses(const SurfaceList& surfaces);
template <>
MethodPointer MakeCertifiedOfFewPasses<1>(const SurfaceList& surfaces);
template <>
MethodPointer MakeCertifiedOfFewPasses<2>(const SurfaceList& surfaces);
template <>
MethodPointer MakeCertifiedOfFewPasses<4>(const SurfaceList& surfaces);
}

#endif
