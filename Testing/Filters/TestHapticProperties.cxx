// From data arrays to the material of a surface: mappings, and what is done about bad data.
#include "FilterTesting.h"

#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticProperties.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace testing_surfaces;

namespace
{
constexpr int Stiff = vtkHapticProperties::STIFFNESS;
constexpr int AtPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int AtCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// A table of 0.1 m in z = 0 with the array "data" at points: 0 at the left, 1000 at the right.
struct Table
{
  vtkSmartPointer<vtkPolyData> Geometry;

  Table()
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-0.05, -0.05, 0.0);
    plane->SetPoint1(0.05, -0.05, 0.0);
    plane->SetPoint2(-0.05, 0.05, 0.0);
    plane->SetResolution(10, 10);
    plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    plane->Update();
    this->Geometry = plane->GetOutput();
    this->Add("data", [](const double x[3]) { return 500.0 + 1e4 * x[0]; });
  }

  template <class Function>
  vtkDoubleArray* Add(const char* name, const Function& value)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    for (vtkIdType i = 0; i < this->Geometry->GetNumberOfPoints(); ++i)
    {
      array->InsertNextValue(value(this->Geometry->GetPoint(i)));
    }
    this->Geometry->GetPointData()->AddArray(array);
    return array;
  }
};

/// The force of a press to z = -depth at (x, y), 1 mm a tick, through a trace.
double PressOn(vtkAlgorithm* surface, double x, double y, double depth)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (double z = 0.001; z > -depth; z -= 1e-4)
  {
    points->InsertNextPoint(x, y, z);
  }
  points->InsertNextPoint(x, y, -depth);
  vtkNew<vtkPolyData> path;
  path->SetPoints(points);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(path);
  trace->SetSurfaceConnection(surface->GetOutputPort());
  trace->Update();
  vtkDataArray* forces = trace->GetOutput()->GetPointData()->GetArray("Force");
  return forces->GetComponent(forces->GetNumberOfTuples() - 1, 2);
}

vtkSmartPointer<vtkGodObjectFilter> FilterOf(const Table& table)
{
  auto filter = vtkSmartPointer<vtkGodObjectFilter>::New();
  filter->SetInputData(table.Geometry);
  return filter;
}
}

TEST(HapticProperties, NoneIsPlain)
{
  const auto filter = FilterOf(Table());
  filter->Update();
  EXPECT_EQ(filter->GetSurfaceProperties(), nullptr);
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.004), 2.0, 1e-9);
}

TEST(HapticProperties, AConstantNeedsNoArray)
{
  const auto filter = FilterOf(Table());
  filter->GetProperties()->SetStiffness(250.0);
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.004), 1.0, 1e-9);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1);
  filter->GetProperties()->SetStiffness(300.0);
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.004), 1.2, 1e-9);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1) << "the surface is the same";
}

TEST(HapticProperties, AnArrayIsMappedByFunctionOrRangeOrNotAtAll)
{
  const Table table;
  const auto filter = FilterOf(table);
  vtkHapticProperties* properties = filter->GetProperties();
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtPoints, "data");
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), 810.0 * 0.004, 1e-6) << "as it is";
  properties->SetRange(Stiff, 700.0, 200.0);
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), (450.0 - 0.5 * 310.0) * 0.004, 1e-6);
  vtkNew<vtkPiecewiseFunction> function;
  function->AddPoint(0.0, 100.0);
  function->AddPoint(500.0, 200.0);
  function->AddPoint(1000.0, 900.0);
  vtkNew<vtkPiecewiseFunction> curve;
  curve->AddPoint(0.0, 0.0);
  curve->AddPoint(0.8, 0.2);
  curve->AddPoint(1.0, 1.0);
  properties->SetStiffnessCurve(curve);
  EXPECT_NEAR(PressOn(filter, 0.021, 0.007, 0.004), (700.0 - 500.0 * 0.25 * 0.71) * 0.004, 1e-5);
  properties->SetStiffnessFunction(function);
  // Values are mapped at the points, and interpolated between them.
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), (200.0 + 1.4 * 310.0) * 0.004, 1e-5);
  function->AddPoint(1000.0, 400.0);
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), (200.0 + 0.4 * 310.0) * 0.004, 1e-5)
    << "another function is taken in";
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtPoints, "");
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), 2.0, 1e-9) << "none is the trace's own";
}

TEST(HapticProperties, CellDataAreConstantOverACell)
{
  const Table table;
  vtkNew<vtkFloatArray> cells;
  cells->SetName("cells");
  for (vtkIdType i = 0; i < table.Geometry->GetNumberOfCells(); ++i)
  {
    cells->InsertNextValue(static_cast<float>(i % 10 < 5 ? 200.0 : 600.0));
  }
  table.Geometry->GetCellData()->AddArray(cells);
  const auto filter = FilterOf(table);
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtCells, "cells");
  EXPECT_NEAR(PressOn(filter, -0.001, 0.007, 0.002), 0.4, 1e-9);
  EXPECT_NEAR(PressOn(filter, 0.001, 0.007, 0.002), 1.2, 1e-9);
}

TEST(HapticProperties, BadValuesHaveTheConstantAndAreReportedOnce)
{
  Table table;
  vtkDoubleArray* data = table.Add("bad", [](const double[3]) { return 400.0; });
  for (vtkIdType i = 0; i < 121; ++i) // the left half
  {
    if (i % 11 < 5)
    {
      data->SetValue(i, i % 2 ? std::nan("") : -5.0);
    }
  }
  const auto filter = FilterOf(table);
  filter->GetProperties()->SetStiffness(100.0);
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtPoints, "bad");
  MessageCatcher messages(filter);
  EXPECT_NEAR(PressOn(filter, -0.03, 0.007, 0.004), 0.4, 1e-6) << "the constant";
  EXPECT_NEAR(PressOn(filter, 0.03, 0.007, 0.004), 1.6, 1e-6) << "the data";
  EXPECT_NEAR(PressOn(filter, -0.005, 0.007, 0.004), 0.5 * (0.4 + 1.6), 1e-6) << "between them";
  EXPECT_NE(messages.Errors().find("bad for the stiffness"), std::string::npos);
  EXPECT_NE(messages.Errors().find("55 of 121 places"), std::string::npos) << messages.Errors();
  EXPECT_EQ(messages.Errors().find("55 of 121"), messages.Errors().rfind("55 of 121"))
    << "said once";
}

TEST(HapticProperties, AnArrayThatVanishesLeavesTheConstantAndAnError)
{
  const Table table;
  const auto filter = FilterOf(table);
  filter->GetProperties()->SetStiffness(100.0);
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtPoints, "data");
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), 3.24, 1e-6);
  MessageCatcher messages(filter);
  table.Geometry->GetPointData()->RemoveArray("data");
  table.Geometry->Modified();
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), 0.4, 1e-9);
  EXPECT_NE(messages.Errors().find("no array data for the stiffness"), std::string::npos)
    << messages.Errors();
  EXPECT_NE(filter->GetSurface(), nullptr) << "it can still be touched";
}

TEST(HapticProperties, AnArrayOfAnotherSizeLeavesTheConstantAndAnError)
{
  const Table table;
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(table.Geometry->GetNumberOfPoints());
  vectors->Fill(1.0);
  table.Geometry->GetPointData()->AddArray(vectors);
  vtkNew<vtkDoubleArray> few;
  few->SetName("few");
  few->SetNumberOfValues(7);
  few->Fill(1.0);
  table.Geometry->GetPointData()->AddArray(few);
  const auto filter = FilterOf(table);
  filter->GetProperties()->SetStiffness(100.0);
  MessageCatcher messages(filter);
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtPoints, "vectors");
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), 0.4, 1e-9);
  EXPECT_NE(messages.Errors().find("3 components"), std::string::npos) << messages.Errors();
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtPoints, "few");
  EXPECT_NEAR(PressOn(filter, 0.031, 0.007, 0.004), 0.4, 1e-9);
  EXPECT_NE(messages.Errors().find("no array few"), std::string::npos) << messages.Errors();
}

TEST(HapticProperties, AnotherColourMakesNoNewProperties)
{
  Table table;
  const auto filter = FilterOf(table);
  filter->SetInputArrayToProcess(Stiff, 0, 0, AtPoints, "data");
  filter->GetProperties()->SetRange(Stiff, 200.0, 800.0);
  filter->GetProperties()->ForceShadingOn();
  filter->Update();
  const auto before = filter->GetSurfaceProperties();
  ASSERT_NE(before, nullptr);
  table.Add("colour", [](const double[3]) { return 1.0; });
  table.Geometry->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetSurfaceProperties(), before);
  table.Add("data", [](const double x[3]) { return x[1]; });
  table.Geometry->Modified();
  filter->Update();
  EXPECT_NE(filter->GetSurfaceProperties(), before);
}

TEST(HapticProperties, ValuesOutOfRangeAreErrorsAndChangeNothing)
{
  vtkNew<vtkHapticProperties> properties;
  MessageCatcher messages(properties);
  properties->SetStaticFriction(0.4);
  for (const double bad : { -0.1, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    properties->SetStaticFriction(bad);
    EXPECT_EQ(properties->GetStaticFriction(), 0.4);
  }
  EXPECT_NE(messages.Errors().find("static friction has to be from 0"), std::string::npos);
  properties->SetConstant(vtkHapticProperties::TEXTURE, 0.6);
  EXPECT_EQ(properties->GetConstant(vtkHapticProperties::TEXTURE), 0.0);
  properties->SetRange(Stiff, -1.0, 100.0);
  EXPECT_FALSE(properties->HasRange(Stiff));
  properties->SetConstant(17, 1.0);
  EXPECT_NE(messages.Errors().find("no haptic property 17"), std::string::npos);
}

TEST(HapticProperties, AFunctionWithAForceAtNoDepthIsLeftOut)
{
  const auto filter = FilterOf(Table());
  filter->GetProperties()->SetStiffness(100.0);
  vtkNew<vtkPiecewiseFunction> jump;
  jump->AddPoint(0.0, 1.0);
  jump->AddPoint(0.01, 2.0);
  filter->GetProperties()->SetForceProfile(jump);
  MessageCatcher messages(filter);
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.004), 0.4, 1e-9);
  EXPECT_NE(messages.Errors().find("force profile is left out"), std::string::npos);
}

TEST(HapticProperties, TheButtonClicks)
{
  const auto filter = FilterOf(Table());
  filter->GetProperties()->SetForceProfileToButton(600.0, 0.003, 0.3);
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.002), 1.2, 1e-6);
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.003), 1.8, 0.02) << "a node may lie next to it";
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.0033), 0.3 * 1.8, 0.03);
  EXPECT_NEAR(PressOn(filter, 0.011, 0.007, 0.005), 0.3 * 1.8 + 600.0 * 0.0017, 0.02);
}

TEST(HapticProperties, DynamicFrictionAloneIsCoulombs)
{
  Table table;
  table.Add("rough", [](const double x[3]) { return x[0] < 0.0 ? 0.2 : 0.6; });
  const auto filter = FilterOf(table);
  filter->GetProperties()->SetStaticFriction(0.3);
  filter->SetInputArrayToProcess(vtkHapticProperties::DYNAMIC_FRICTION, 0, 0, AtPoints, "rough");
  MessageCatcher messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Errors(), "");
  EXPECT_NE(filter->GetSurfaceProperties(), nullptr);
}

TEST(HapticProperties, APictureNeedsTextureCoordinates)
{
  const Table table; // vtkPlaneSource makes some
  const auto filter = FilterOf(table);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int i = 0; i < 4; ++i)
  {
    image->SetScalarComponentFromDouble(i % 2, i / 2, 0, 0, i % 2 ? 255 : 0);
  }
  filter->GetProperties()->SetTextureImage(image);
  filter->GetProperties()->SetTextureAmplitude(0.25);
  // The middles of the pixels lie at a quarter and three quarters of the table.
  EXPECT_NEAR(PressOn(filter, -0.025, 0.007, 0.004), 2.0 * 0.75, 1e-5);
  EXPECT_NEAR(PressOn(filter, 0.025, 0.007, 0.004), 2.0 * 1.25, 1e-5);
  MessageCatcher messages(filter);
  table.Geometry->GetPointData()->SetTCoords(nullptr);
  table.Geometry->Modified();
  EXPECT_NEAR(PressOn(filter, 0.025, 0.007, 0.004), 2.0, 1e-9);
  EXPECT_NE(messages.Errors().find("no texture coordinates"), std::string::npos);
}

// A trace prepares plain polydata itself, with properties of its own and arrays of port 1.
TEST(HapticProperties, ATraceMapsArraysOfItsSurface)
{
  const Table table;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i <= 40; ++i)
  {
    points->InsertNextPoint(0.031, 0.007, 0.001 - 1e-4 * i);
  }
  vtkNew<vtkPolyData> path;
  path->SetPoints(points);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(path);
  trace->SetSurfaceData(table.Geometry);
  trace->SetInputArrayToProcess(Stiff, 1, 0, AtPoints, "data");
  trace->Update();
  vtkPointData* data = trace->GetOutput()->GetPointData();
  EXPECT_NEAR(data->GetArray("Force")->GetComponent(40, 2), 810.0 * 0.003, 1e-6);
  EXPECT_NEAR(data->GetArray("Stiffness")->GetComponent(40, 0), 810.0, 1e-4);
  EXPECT_EQ(data->GetArray("Stiffness")->GetComponent(0, 0), 500.0) << "in free space";
  // What the hand has put in: the spring's energy, less what holding the force cost.
  const double stored = 0.5 * 810.0 * 0.003 * 0.003;
  EXPECT_NEAR(data->GetArray("Energy")->GetComponent(40, 0), stored, 0.05 * stored);
  EXPECT_NEAR(data->GetArray("EnergyTank")->GetComponent(40, 0), 0.0, 1e-12);
  trace->GetProperties()->SetRange(Stiff, 100.0, 100.0);
  trace->Update();
  data = trace->GetOutput()->GetPointData();
  EXPECT_NEAR(data->GetArray("Force")->GetComponent(40, 2), 100.0 * 0.003, 1e-6);
}
