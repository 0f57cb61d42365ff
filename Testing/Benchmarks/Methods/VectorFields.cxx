#include "VectorFields.h"

#include "MeshToPolyData.h"

namespace haptics::testing
{
NearestSurface::NearestSurface(const TriangleMesh& mesh)
  : Distance(vtkSmartPointer<vtkImplicitPolyDataDistance>::New())
{
  this->Distance->SetInput(ToPolyData(mesh));
}

Vec3 NearestSurface::Update(const Vec3& hip)
{
  Vec3 asked = hip;
  Vec3 nearest{};
  const double distance =
    this->Distance->EvaluateFunctionAndGetClosestPoint(asked.data(), nearest.data());
  return distance < 0.0 ? nearest : hip;
}

SumOfFields::SumOfFields(std::vector<MethodPointer> fields)
  : Fields(std::move(fields))
{
}

void SumOfFields::Place(const Vec3& position)
{
  for (const MethodPointer& field : this->Fields)
  {
    field->Place(position);
  }
}

Vec3 SumOfFields::Update(const Vec3& hip)
{
  Vec3 sum = hip;
  for (const MethodPointer& field : this->Fields)
  {
    const Vec3 held = field->Update(hip);
    for (int k = 0; k < 3; ++k)
    {
      sum[k] += held[k] - hip[k];
    }
  }
  return sum;
}
}
