// What the trace of a scene says about what was touched: which surface, where on it, and its data.
#include "../TemporaryFolder.h"
#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHapticSurfaces.h"
#include "vtkHapticTraceRecorder.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>

namespace
{
/// Heat = x + 2 y + offset at the points; Part is that of the cells.
vtkSmartPointer<vtkPolyData> TableWithData(double height, double offset, int part)
{
  auto table = MakeTable(height);
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("Heat");
  for (vtkIdType i = 0; i < table->GetNumberOfPoints(); ++i)
  {
    double p[3];
    table->GetPoint(i, p);
    heat->InsertNextValue(p[0] + 2.0 * p[1] + offset);
  }
  vtkNew<vtkIntArray> parts;
  parts->SetName("Part");
  parts->InsertNextValue(part);
  table->GetPointData()->AddArray(heat);
  table->GetCellData()->AddArray(parts);
  return table;
}

double Value(vtkPolyData* trace, const char* name, vtkIdType tick, int component = 0)
{
  vtkDataArray* const array = trace->GetPointData()->GetArray(name);
  return array ? array->GetComponent(tick, component) : -12345.0;
}
}

TEST(SceneTrace, HasTheChosenArraysOfEachSurfaceAndSaysWhich)
{
  LedHand hand;
  const int low = hand.Scene->AddSurface(TableWithData(0.0, 5.0, 7));
  auto highTable = TableWithData(0.05, -5.0, 8);
  const int high = hand.Scene->AddSurface(highTable);
  hand.Scene->GetSurfaces()->SetName(high, "table, high");
  vtkHapticTraceRecorder* const recorder = hand.Scene->GetTraceRecorder();
  recorder->AddSurfaceArray("Heat");
  recorder->AddSurfaceArray("Part");
  hand.MoveTo(0.01);
  recorder->Start();
  hand.MoveTo(0.01);
  hand.MoveTo(-0.002);
  hand.Device->SetPosition(0.5, 0.0, 0.02); // around the edge
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.5, 0.0, 0.06);
  hand.Scene->Step(1);
  hand.MoveTo(0.06);
  hand.MoveTo(0.049);
  recorder->Stop();
  vtkPolyData* const trace = recorder->GetTrace();
  ASSERT_EQ(trace->GetNumberOfPoints(), 6);
  EXPECT_TRUE(std::isnan(Value(trace, "Heat", 0))) << "free";
  EXPECT_EQ(Value(trace, "PointIds", 0), -1.0);
  EXPECT_EQ(Value(trace, "Surface", 1), low);
  EXPECT_NEAR(Value(trace, "Heat", 1), 5.05, 1e-9);
  EXPECT_EQ(Value(trace, "Part", 1), 7.0);
  EXPECT_EQ(Value(trace, "Surface", 5), high);
  EXPECT_NEAR(Value(trace, "Heat", 5), -4.95, 1e-9);
  EXPECT_EQ(Value(trace, "Part", 5), 8.0);
  EXPECT_NEAR(Value(trace, "Normal", 5, 2), 1.0, 1e-12);
  // Weights and points lead to the place, by the surface as it was given.
  double place[3] = { 0.0, 0.0, 0.0 };
  for (int corner = 0; corner < 3; ++corner)
  {
    double p[3];
    highTable->GetPoint(static_cast<vtkIdType>(Value(trace, "PointIds", 5, corner)), p);
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] += Value(trace, "BarycentricWeights", 5, corner) * p[axis];
    }
  }
  EXPECT_NEAR(place[0], 0.01, 1e-9);
  EXPECT_NEAR(place[1], 0.02, 1e-9);
  auto* const names =
    vtkStringArray::SafeDownCast(trace->GetFieldData()->GetAbstractArray("SurfaceName"));
  auto* const ids = trace->GetFieldData()->GetArray("SurfaceId");
  ASSERT_TRUE(names && ids && names->GetNumberOfValues() == 2);
  EXPECT_EQ(ids->GetTuple1(0), low);
  EXPECT_EQ(names->GetValue(0), "surface " + std::to_string(low));
  EXPECT_EQ(ids->GetTuple1(1), high);
  EXPECT_EQ(names->GetValue(1), "table, high");
}

TEST(SceneTrace, WeightsAndPointsAreRightOnAMirroredActor)
{
  LedHand hand;
  auto table = TableWithData(0.0, 0.0, 1);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(table);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(-1.0, 1.0, 1.0);
  hand.Scene->AddSurface(actor);
  hand.Scene->GetTraceRecorder()->AddSurfaceArray("Heat");
  hand.MoveTo(0.01);
  hand.Scene->StartRecording();
  hand.MoveTo(-0.002);
  vtkPolyData* const trace = hand.Scene->GetTrace();
  EXPECT_NEAR(Value(trace, "Heat", 0), 0.03, 1e-9) << "x is -0.01 there";
  double x = 0.0;
  for (int corner = 0; corner < 3; ++corner)
  {
    double p[3];
    table->GetPoint(static_cast<vtkIdType>(Value(trace, "PointIds", 0, corner)), p);
    x += Value(trace, "BarycentricWeights", 0, corner) * p[0];
  }
  EXPECT_NEAR(x, -0.01, 1e-9);
}

TEST(SceneTrace, HasTheArraysOfASurfaceThatDeformsAtEveryUpdate)
{
  LedHand hand;
  auto table = TableWithData(0.0, 5.0, 7);
  hand.Scene->AddSurface(table);
  vtkHapticTraceRecorder* const recorder = hand.Scene->GetTraceRecorder();
  recorder->AddSurfaceArray("Heat");
  hand.MoveTo(0.01);
  recorder->Start();
  for (int i = 0; i < 20; ++i)
  {
    for (vtkIdType k = 0; k < 4; ++k)
    {
      double p[3];
      table->GetPoint(k, p);
      table->GetPoints()->SetPoint(k, p[0], p[1], 1e-4 * i);
    }
    table->GetPoints()->Modified();
    table->Modified();
    hand.Device->SetPosition(0.01, 0.02, -0.003);
    hand.Scene->Step(8);
  }
  vtkPolyData* const trace = recorder->GetTrace();
  ASSERT_EQ(trace->GetNumberOfPoints(), 160);
  for (vtkIdType tick = 0; tick < 160; ++tick)
  {
    ASSERT_NEAR(Value(trace, "Heat", tick), 5.05, 1e-6) << tick;
  }
}

TEST(SceneTrace, BadArraysAreReportedOnceAndNothingElseChanges)
{
  struct Way
  {
    const char* What;
    std::function<void(vtkPolyData*)> Spoil;
    double Heat; // NaN: none
  };
  const auto replace = [](vtkPolyData* table, vtkDataArray* array)
  {
    array->SetName("Heat");
    table->GetPointData()->RemoveArray("Heat");
    table->GetPointData()->AddArray(array);
    table->Modified();
  };
  const Way ways[] = {
    { "vanishes",
      [](vtkPolyData* table)
      {
        table->GetPointData()->RemoveArray("Heat");
        table->Modified();
      },
      std::nan("") },
    { "is too short",
      [&](vtkPolyData* table)
      {
        vtkNew<vtkDoubleArray> array;
        array->InsertNextValue(1.0);
        replace(table, array);
      },
      std::nan("") },
    { "has NaN",
      [&](vtkPolyData* table)
      {
        vtkNew<vtkFloatArray> array;
        for (int i = 0; i < 4; ++i)
        {
          array->InsertNextValue(std::nanf(""));
        }
        replace(table, array);
      },
      std::nan("") },
    { "has other components",
      [&](vtkPolyData* table)
      {
        vtkNew<vtkDoubleArray> array;
        array->SetNumberOfComponents(3);
        for (int i = 0; i < 4; ++i)
        {
          array->InsertNextTuple3(1.5, 2.5, 3.5);
        }
        replace(table, array);
      },
      1.5 },
  };
  for (const Way& way : ways)
  {
    LedHand hand;
    auto table = TableWithData(0.0, 5.0, 7);
    hand.Scene->AddSurface(table);
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    vtkHapticTraceRecorder* const recorder = hand.Scene->GetTraceRecorder();
    recorder->AddSurfaceArray("Heat");
    hand.MoveTo(0.01);
    recorder->Start();
    hand.MoveTo(-0.003);
    way.Spoil(table);
    hand.MoveTo(-0.003);
    hand.MoveTo(-0.003);
    recorder->Stop();
    vtkPolyData* const trace = recorder->GetTrace();
    ASSERT_EQ(trace->GetNumberOfPoints(), 3) << way.What;
    EXPECT_NEAR(Value(trace, "Heat", 0), 5.05, 1e-9) << way.What;
    const double now = Value(trace, "Heat", 2);
    EXPECT_TRUE(std::isnan(way.Heat) ? std::isnan(now) : now == way.Heat) << way.What << now;
    EXPECT_EQ(Value(trace, "Force", 2, 2), Value(trace, "Force", 0, 2)) << way.What;
    EXPECT_EQ(errors.Count, 0) << way.What;
  }
}

TEST(SceneTrace, ANameThatNoSurfaceHasIsReportedAndTheOneThatItHasHelps)
{
  LedHand hand;
  hand.Scene->AddSurface(TableWithData(0.0, 5.0, 7));
  EventCounter warnings(hand.Scene, vtkCommand::WarningEvent);
  vtkHapticTraceRecorder* const recorder = hand.Scene->GetTraceRecorder();
  for (const bool isRight : { false, true })
  {
    recorder->ClearSurfaceArrays();
    recorder->AddSurfaceArray(isRight ? "Heat" : "Heta");
    hand.MoveTo(0.01);
    recorder->Start();
    hand.MoveTo(-0.002);
    recorder->Stop();
    EXPECT_EQ(warnings.Count, 1) << isRight;
    EXPECT_EQ(recorder->GetTrace()->GetPointData()->HasArray("Heat"), isRight);
    EXPECT_FALSE(recorder->GetTrace()->GetPointData()->HasArray("Heta"));
  }
}

TEST(SceneTrace, IsWrittenAsATableWithTheUnitOfItsLengths)
{
  LedHand hand;
  hand.Scene->AddSurface(TableWithData(0.0, 5.0, 7));
  hand.Scene->GetWorkspace()->SetUnitLength(1.0);
  vtkHapticTraceRecorder* const recorder = hand.Scene->GetTraceRecorder();
  recorder->AddSurfaceArray("Heat");
  hand.MoveTo(0.01);
  recorder->Start();
  hand.MoveTo(-0.002);
  vtkDataArray* const depth = recorder->GetTrace()->GetPointData()->GetArray("Penetration");
  ASSERT_TRUE(depth->GetInformation()->Has(vtkDataArray::UNITS_LABEL()));
  EXPECT_STREQ(depth->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "m");
  const TemporaryFolder folder;
  const std::string file = folder.File("trace.csv");
  ASSERT_TRUE(recorder->WriteCSV(file.c_str()));
  std::ifstream stream(file);
  std::string names;
  std::string values;
  std::getline(stream, names);
  std::getline(stream, values);
  EXPECT_EQ(names.substr(names.rfind(',')), ",Heat");
  EXPECT_NEAR(std::stod(values.substr(values.rfind(',') + 1)), 5.05, 1e-9);

  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  EXPECT_FALSE(recorder->WriteCSV(folder.File("none/trace.csv").c_str()));
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(
    std::string(hand.Scene->GetErrorMessage()).find("Make its folder first"), std::string::npos)
    << hand.Scene->GetErrorMessage();
}
