#ifndef Haptics_VectorFields_h
#define Haptics_VectorFields_h

#include "ContactMethod.h"
#include "haptics/Surface/TriangleSurface.h"

#include "vtkImplicitPolyDataDistance.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace haptics::testing
{
/// @brief The vector field of the paper's Fig. 2b: "assume that the user entered from the closest
/// edge". A HIP inside a closed surface is pushed to the nearest point of it.
///
/// Has no history. Nearest point and side by vtkImplicitPolyDataDistance.
class NearestSurface : public ContactMethod
{
public:
  explicit NearestSurface(const TriangleMesh& mesh);
  void Place(const Vec3&) override {}
  Vec3 Update(const Vec3& hip) override;

private:
  vtkSmartPointer<vtkImplicitPolyDataDistance> Distance;
};

/// The paper's Fig. 3: the forces of overlapping objects, each with its own field, added.
class SumOfFields : public ContactMethod
{
public:
  explicit SumOfFields(std::vector<MethodPointer> fields);
  void Place(const Vec3& position) override;
  Vec3 Update(const Vec3& hip) override;

private:
  std::vector<MethodPointer> Fields;
};
}

#endif
