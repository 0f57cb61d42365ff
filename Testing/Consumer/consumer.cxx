#include "vtkGodObjectFilter.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

int main()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputConnection(sphere->GetOutputPort());
  filter->Update();
  return filter->GetOutput()->GetNumberOfPolys() == 96 ? 0 : 1;
}
