#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkTriangle.h"

#include <cmath>

namespace testing_surfaces
{
namespace
{
vtkSmartPointer<vtkCellArray> MakeCells(const Cells& cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const std::vector<vtkIdType>& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

template <typename Visitor>
double SumOverTriangles(vtkPolyData* triangles, Visitor&& visit)
{
  double sum = 0.0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i)
  {
    triangles->GetCellPoints(i, corners);
    double p[3][3];
    for (int corner = 0; corner < 3; ++corner)
    {
      triangles->GetPoint(corners->GetId(corner), p[corner]);
    }
    sum += visit(p[0], p[1], p[2]);
  }
  return sum;
}
}

vtkSmartPointer<vtkPolyData> MakePolyData(const Parts& parts, int dataType)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(dataType);
  for (const Point& point : parts.Points)
  {
    points->InsertNextPoint(point.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(MakeCells(parts.Verts));
  data->SetLines(MakeCells(parts.Lines));
  data->SetPolys(MakeCells(parts.Polys));
  data->SetStrips(MakeCells(parts.Strips));
  return data;
}

Parts Cube()
{
  Parts cube;
  for (int i = 0; i < 8; ++i)
  {
    cube.Points.push_back({ double(i & 1), double(i >> 1 & 1), double(i >> 2) });
  }
  cube.Polys = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 },
    { 1, 3, 7, 5 } };
  return cube;
}

double Area(vtkPolyData* triangles)
{
  return SumOverTriangles(triangles,
    [](const double* a, const double* b, const double* c)
    { return vtkTriangle::TriangleArea(a, b, c); });
}

double Volume(vtkPolyData* triangles)
{
  return SumOverTriangles(triangles,
    [](const double* a, const double* b, const double* c)
    {
      return (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6.0;
    });
}

class MessageCatcher::Observer : public vtkCommand
{
public:
  static Observer* New() { return new Observer; }

  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings) +=
      static_cast<const char*>(data);
  }

  std::string Errors;
  std::string Warnings;
};

MessageCatcher::MessageCatcher(vtkObject* object)
  : Watched(object)
  , Listener(vtkSmartPointer<Observer>::New())
{
  object->AddObserver(vtkCommand::ErrorEvent, this->Listener);
  object->AddObserver(vtkCommand::WarningEvent, this->Listener);
}

MessageCatcher::~MessageCatcher()
{
  this->Watched->RemoveObserver(this->Listener);
}

std::string MessageCatcher::Errors() const
{
  return this->Listener->Errors;
}

std::string MessageCatcher::Warnings() const
{
  return this->Listener->Warnings;
}
}
