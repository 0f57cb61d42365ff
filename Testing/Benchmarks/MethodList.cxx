#include "MethodList.h"

#include "AnalyticSurfaces.h"
#include "LocatorMethod.h"
#include "PaperMethod.h"
#include "VectorFields.h"

#include "vtkModifiedBSPTree.h"
#include "vtkOBBTree.h"
#include "vtkStaticCellLocator.h"
#include "vtkVersionMacros.h"

namespace haptics::testing
{
namespace
{
template <class Locator>
std::function<MethodPointer(const TriangleMesh&)> Over(double tolerance)
{
  return [tolerance](const TriangleMesh& mesh) {
    return std::make_unique<LocatorMethod>(mesh, vtkSmartPointer<Locator>::New().Get(), tolerance);
  };
}

template <class Real>
std::function<MethodPointer(const TriangleMesh&)> Printed(bool iterates, double grown = 0.0)
{
  return [iterates, grown](const TriangleMesh& mesh)
  {
    PaperOptions options;
    options.Iterates = iterates;
    options.Grown = grown;
    return std::make_unique<PaperMethod<Real>>(mesh, options);
  };
}

std::function<MethodPointer(const TriangleMesh&)> Ours(EngineKind engine)
{
  return [engine](const TriangleMesh& mesh) { return MakeWithEngine(mesh, engine); };
}

template <int Passes>
std::function<MethodPointer(const TriangleMesh&)> OursOf()
{
  return [](const TriangleMesh& mesh)
  { return MakeCertified({ MakeSurface(mesh, Side::Front) }, Passes); };
}
}

MethodPointer MakeWithEngine(const TriangleMesh& mesh, EngineKind engine)
{
  return MakeCertified({ MakeSurface(mesh, Side::Front, engine) });
}

std::vector<ListedMethod> AllMethods()
{
  return
  {
    { "nearest surface", "field",
      [](const TriangleMesh& mesh) { return std::make_unique<NearestSurface>(mesh); }, 1.1e5 },
      { "paper, float", "paper", Printed<float>(false), 1.1e5 },
      { "paper", "paper", Printed<double>(false), 1.1e5 },
      { "paper, iterated, float", "paper", Printed<float>(true), 1.1e5 },
      { "paper, iterated", "paper", Printed<double>(true), 1.1e5 },
      { "paper, iterated, grown", "paper", Printed<double>(true, 1e-6), 1.1e5 },
      { "vtkStaticCellLocator, tol 0", "VTK", Over<vtkStaticCellLocator>(0.0), 1.1e7 },
      { "vtkStaticCellLocator, tol 1e-6", "VTK", Over<vtkStaticCellLocator>(1e-6), 1.1e7 },
// That of VTK 9.2, as in ParaView 5.11, crashes in its second IntersectWithLine.
#if VTK_MAJOR_VERSION != 9 || VTK_MINOR_VERSION != 2
      { "vtkModifiedBSPTree, tol 1e-6", "VTK", Over<vtkModifiedBSPTree>(1e-6), 1.1e6 },
#endif
      { "vtkOBBTree, tol 1e-6", "VTK", Over<vtkOBBTree>(1e-6), 6e3 },
      { "this project, one pass", "this", OursOf<1>(), 1.1e7 },
      { "this project, two passes", "this", OursOf<2>(), 1.1e7 },
      { "this project, four passes", "this", OursOf<4>(), 1.1e7 },
      { "this project, BruteForce", "this", Ours(EngineKind::BruteForce), 1.1e5 },
      { "this project, Exact", "this", Ours(EngineKind::Exact), 1.1e6 },
      { "this project, Embree", "this", Ours(EngineKind::Embree), 1.1e7 },
  };
}
}
