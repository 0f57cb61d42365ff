#include "MeshToPolyData.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"

namespace haptics::testing
{
vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.Points.size()));
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.Points[i].data());
  }
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(mesh.Triangles.size()),
    3 * static_cast<vtkIdType>(mesh.Triangles.size()));
  for (const auto& [a, b, c] : mesh.Triangles)
  {
    cells->InsertNextCell({ a, b, c });
  }
  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  polyData->SetPoints(points);
  polyData->SetPolys(cells);
  return polyData;
}

TriangleMesh ToMesh(vtkPolyData* polyData)
{
  TriangleMesh mesh;
  mesh.Points.resize(polyData->GetNumberOfPoints());
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    polyData->GetPoint(static_cast<vtkIdType>(i), mesh.Points[i].data());
  }
  vtkCellArray* const cells = polyData->GetPolys();
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCellAtId(i, count, corners);
    if (count == 3)
    {
      mesh.Triangles.push_back({ static_cast<std::int32_t>(corners[0]),
        static_cast<std::int32_t>(corners[1]), static_cast<std::int32_t>(corners[2]) });
    }
  }
  return mesh;
}
}
