#ifndef Haptics_LocatorMethod_h
#define Haptics_LocatorMethod_h

#include "ContactMethod.h"
#include "haptics/Contact/ActivePlanes.h"
#include "haptics/Surface/TriangleSurface.h"

#include "vtkAbstractCellLocator.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace haptics::testing
{
/// @brief A god-object over one of VTK's own locators: what one would build from VTK alone.
///
/// The best of the paper's variants: the first facet on the way, iteration, and this project's own
/// solver with its sign check, a clearance of 1e-7 m in front of each plane, the position kept in
/// double precision. What is compared is thus the locator's IntersectWithLine and the missing
/// certificate. Locators see both sides; a facet met from behind is stepped through.
class LocatorMethod : public ContactMethod
{
public:
  /// `locator` is new and has no input yet; `tolerance` is IntersectWithLine's [m].
  LocatorMethod(const TriangleMesh& mesh, vtkAbstractCellLocator* locator, double tolerance);

  void Place(const Vec3& position) override;
  Vec3 Update(const Vec3& hip) override;

private:
  std::int32_t FirstFront(const Vector& from, const Vector& to);

  vtkSmartPointer<vtkAbstractCellLocator> Locator;
  double Tolerance;
  std::vector<Vector> Normals;
  std::vector<Vector> Anchors;
  ActivePlanes Active;
  Vector Position{ 0 };
};
}

#endif
