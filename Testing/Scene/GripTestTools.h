#ifndef Haptics_GripTestTools_h
#define Haptics_GripTestTools_h

#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkCubeSource.h"
#include "vtkHapticGrip.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"

#include <array>
#include <cmath>

using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}
inline double Length(const Point& a)
{
  return vtkMath::Norm(a.data());
}

/// A cube of 0.04 about the origin, shown by an actor.
inline vtkSmartPointer<vtkActor> MakeCube()
{
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(0.04);
  cube->SetYLength(0.04);
  cube->SetZLength(0.04);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(cube->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// A cube that can be carried, a wall that stands, and a hand above the cube's middle.
///
///        o hand at z = 0.03       |
///     .-----.                     | wall at x = 0.1, faces it
///     |     | part                |
///     `-----'                     |
struct Workbench : LedHand
{
  vtkSmartPointer<vtkActor> Part = MakeCube();
  vtkSmartPointer<vtkPolyData> Wall = MakeTable(0.0);
  int PartId;
  int WallId;

  explicit Workbench(bool loosened = true)
  {
    if (!loosened)
    {
      this->Scene->GetServo()->GetSafety()->Reset();
    }
    for (vtkIdType i = 0; i < this->Wall->GetNumberOfPoints(); ++i)
    {
      double p[3];
      this->Wall->GetPoint(i, p);
      this->Wall->GetPoints()->SetPoint(i, 0.1, p[1], p[0]);
    }
    this->PartId = this->Scene->AddSurface(this->Part);
    this->WallId = this->Scene->AddSurface(this->Wall);
    this->Go(0.003, 0.005, 0.03);
  }
  /// Moves the hand and lets ticks go by.
  void Go(double x, double y, double z, int ticks = 1)
  {
    this->Device->SetPosition(x, y, z);
    this->Scene->Step(ticks);
  }
  /// Presses the part's top by 2 mm and grips it.
  bool PressAndGrip()
  {
    this->Go(0.003, 0.005, 0.018);
    return this->Scene->GetGrip()->Take();
  }
  Point GodObject()
  {
    Point p;
    this->Scene->GetGodObject(p.data());
    return p;
  }
  Point Place(vtkActor* actor)
  {
    Point p;
    actor->GetPosition(p.data());
    return p;
  }
  double Force() { return vtkMath::Norm(this->Scene->GetForce()); }
  /// Whether the god-object is in the part, which was not turned.
  bool IsInside()
  {
    const Point p = this->GodObject() - this->Place(this->Part);
    return std::abs(p[0]) < 0.02 && std::abs(p[1]) < 0.02 && std::abs(p[2]) < 0.02;
  }
};

#endif
