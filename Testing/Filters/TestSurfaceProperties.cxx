#include "FilterTesting.h"

#include "vtkGodObjectFilter.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace testing_surfaces;

namespace
{
Parts Open()
{
  Parts parts = Cube();
  parts.Polys.pop_back();
  return parts;
}

Parts InsideOut()
{
  Parts parts = Cube();
  for (auto& face : parts.Polys)
  {
    std::reverse(face.begin(), face.end());
  }
  return parts;
}

int AutomaticSide(const Parts& parts)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(parts));
  filter->Update();
  return filter->GetTouchedSide();
}
}

TEST(SurfaceProperties, AutomaticSideIsFrontOnlyWhereThereIsAnOutside)
{
  EXPECT_EQ(AutomaticSide(Cube()), vtkGodObjectFilter::FRONT);
  EXPECT_EQ(AutomaticSide(Open()), vtkGodObjectFilter::BOTH);
  EXPECT_EQ(AutomaticSide(InsideOut()), vtkGodObjectFilter::BOTH);
}

TEST(SurfaceProperties, AChosenSideStays)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(Open()));
  filter->SetSideToFront();
  filter->Update();
  EXPECT_STREQ(filter->GetTouchedSideAsString(), "Front");
  filter->SetSideToBoth();
  filter->Update();
  EXPECT_STREQ(filter->GetTouchedSideAsString(), "Both");
}

TEST(SurfaceProperties, AChosenEngineIsUsed)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(Cube()));
  filter->SetEngineToEmbree();
  filter->Update();
  EXPECT_STREQ(filter->GetEngineInUseAsString(), "Embree");
  filter->SetEngineToBruteForce();
  filter->Update();
  EXPECT_STREQ(filter->GetEngineInUseAsString(), "BruteForce");
}

TEST(SurfaceProperties, CrackWidthFollowsThePrecisionOfThePoints)
{
  Parts parts = Cube();
  for (Point& point : parts.Points)
  {
    point[0] -= 1000.0; // the largest coordinate is 1000
  }
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(parts, VTK_FLOAT));
  filter->Update();
  EXPECT_DOUBLE_EQ(filter->GetCrackWidthInUse(), 8.0 * 1000.0 * std::ldexp(1.0, -24));
  filter->SetInputData(MakePolyData(parts, VTK_DOUBLE));
  filter->Update();
  EXPECT_EQ(filter->GetCrackWidthInUse(), 0.0);
  filter->SetCrackWidth(0.25);
  filter->AutomaticCrackWidthOff();
  filter->Update();
  EXPECT_EQ(filter->GetCrackWidthInUse(), 0.25);
}

TEST(SurfaceProperties, ValuesOutOfRangeAreClamped)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetSide(99);
  filter->SetEngine(-1);
  filter->SetMergeTolerance(-1.0);
  EXPECT_EQ(filter->GetSide(), vtkGodObjectFilter::AUTOMATIC_SIDE);
  EXPECT_EQ(filter->GetEngine(), vtkGodObjectFilter::AUTOMATIC_ENGINE);
  EXPECT_EQ(filter->GetMergeTolerance(), 0.0);
}

TEST(SurfaceProperties, PrintShowsWhatWasBuilt)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(Cube()));
  filter->Update();
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("Surface: 12 triangles"), std::string::npos);
  EXPECT_NE(text.str().find("Closed: Yes"), std::string::npos);
}
