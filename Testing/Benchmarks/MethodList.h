#ifndef Haptics_MethodList_h
#define Haptics_MethodList_h

#include "CertifiedMethod.h"
#include "ContactMethod.h"
#include "haptics/Surface/TriangleSurface.h"

#include <functional>
#include <string>
#include <vector>

namespace haptics::testing
{
/// One of the methods that are compared.
struct ListedMethod
{
  std::string Name;
  std::string Family; ///< "field", "paper", "VTK" or "this": what the charts colour by
  /// Makes it over a surface; where several are given they are separate objects.
  std::function<MethodPointer(const TriangleMesh&)> Make;
  /// More triangles would take all day: minutes to build, or milliseconds in every tick.
  double MostTriangles;
};

std::vector<ListedMethod> AllMethods();
/// This project's with one engine.
MethodPointer MakeWithEngine(const TriangleMesh& mesh, EngineKind engine);
}

#endif
