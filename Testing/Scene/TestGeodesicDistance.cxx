// Ways along a prism, whose shortest way is known: unfolded it is a straight line.
//
//     +--+--+--+--+          z
//     | /| /| /| /|   ...    |   arc: along the perimeter, from the first edge
//     +--+--+--+--+          +-- arc
#include "SceneTestTools.h"

#include "vtkCellArray.h"
#include "vtkHapticLandmarks.h"
#include "vtkMath.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
constexpr int Facets = 24;
constexpr int Rings = 12;
constexpr double Height = 2.0;
const double Step = 2.0 * vtkMath::Pi() / Facets; // of a facet, radius 1

vtkSmartPointer<vtkPolyData> MakePrism()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (int ring = 0; ring <= Rings; ++ring)
  {
    for (int i = 0; i < Facets; ++i)
    {
      points->InsertNextPoint(std::cos(i * Step), std::sin(i * Step), ring * Height / Rings);
    }
  }
  for (int ring = 0; ring < Rings; ++ring)
  {
    for (int i = 0; i < Facets; ++i)
    {
      const vtkIdType a = ring * Facets + i;
      const vtkIdType b = ring * Facets + (i + 1) % Facets;
      const vtkIdType triangles[2][3] = { { a, b, b + Facets }, { a, b + Facets, a + Facets } };
      cells->InsertNextCell(3, triangles[0]);
      cells->InsertNextCell(3, triangles[1]);
    }
  }
  auto prism = vtkSmartPointer<vtkPolyData>::New();
  prism->SetPoints(points);
  prism->SetPolys(cells);
  return prism;
}

double Arc(const double point[3])
{
  double angle = std::atan2(point[1], point[0]);
  angle += angle < 0.0 ? 2.0 * vtkMath::Pi() : 0.0;
  const double facet = std::floor(angle / Step);
  // From the facet's middle, where its distance from the axis is cos(Step / 2).
  const double fromMiddle = std::cos(0.5 * Step) * std::tan(angle - (facet + 0.5) * Step);
  return 2.0 * std::sin(0.5 * Step) * (facet + 0.5) + fromMiddle;
}
}

TEST(HapticLandmarks, TheWayAroundAPrismIsWithin0Point4PercentOfTheShortest)
{
  LedHand hand;
  hand.Scene->AddSurface(MakePrism());
  vtkHapticLandmarks* marks = hand.Scene->GetLandmarks();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angles(0.0, 2.0 * vtkMath::Pi());
  std::uniform_real_distribution<double> heights(0.05, Height - 0.05);
  constexpr int Marks = 12;
  for (int i = 0; i < Marks; ++i)
  {
    const double angle = angles(random);
    const double z = heights(random);
    // Over the rim, as a hand that goes through the prism would be held by its far side.
    hand.Device->SetPosition(0.0, 0.0, 3.0);
    hand.Scene->Step(1);
    hand.Device->SetPosition(1.5 * std::cos(angle), 1.5 * std::sin(angle), 3.0);
    hand.Scene->Step(1);
    for (const double reach : { 1.5, 0.98 })
    {
      hand.Device->SetPosition(reach * std::cos(angle), reach * std::sin(angle), z);
      hand.Scene->Step(1);
    }
    ASSERT_EQ(hand.Scene->DropLandmark(), i);
  }
  const double perimeter = 2.0 * Facets * std::sin(0.5 * Step);
  double worst = 0.0;
  for (int i = 0; i < Marks; ++i)
  {
    for (int j = i + 1; j < Marks; ++j)
    {
      double a[3];
      double b[3];
      marks->GetPosition(i, a);
      marks->GetPosition(j, b);
      const double around = std::abs(Arc(a) - Arc(b));
      const double shortest = std::hypot(std::min(around, perimeter - around), a[2] - b[2]);
      const double length = marks->GetGeodesicDistance(i, j);
      EXPECT_GT(length, shortest * (1.0 - 1e-9)) << "no way is shorter";
      worst = std::max(worst, length / shortest - 1.0);
    }
  }
  RecordProperty("WorstExcess", std::to_string(worst));
  EXPECT_LT(worst, 0.004) << "as vtkHapticLandmarks::GetGeodesicDistance() says";
}
