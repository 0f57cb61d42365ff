// The material of a scene's surfaces, from their data arrays to the force in the hand.
#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkHapticProperties.h"
#include "vtkHapticReadings.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace
{
constexpr int AtPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;

/// A table in z = 0 with "stiff" at its points: 200 at the left, 600 at the right.
vtkSmartPointer<vtkPolyData> MakeStiffTable()
{
  vtkSmartPointer<vtkPolyData> table = MakeTable(0.0);
  vtkNew<vtkDoubleArray> stiff;
  stiff->SetName("stiff");
  for (vtkIdType i = 0; i < table->GetNumberOfPoints(); ++i)
  {
    stiff->InsertNextValue(400.0 + 2000.0 * table->GetPoint(i)[0]);
  }
  table->GetPointData()->AddArray(stiff);
  return table;
}

void PressAt(LedHand& hand, double x, double y, double height)
{
  hand.Device->SetPosition(x, y, height);
  hand.Scene->Step(1);
}
}

TEST(SceneProperties, StiffnessComesFromAnArray)
{
  LedHand hand;
  const int table = hand.Scene->AddSurface(MakeStiffTable());
  EXPECT_FALSE(hand.Scene->SetSurfacePropertyArray(77, 0, AtPoints, "stiff"));
  EXPECT_EQ(hand.Scene->GetSurfaceProperties(77), nullptr);
  EXPECT_TRUE(
    hand.Scene->SetSurfacePropertyArray(table, vtkHapticProperties::STIFFNESS, AtPoints, "stiff"));
  for (const double x : { -0.05, 0.0, 0.05 })
  {
    PressAt(hand, x, 0.02, 0.001);
    PressAt(hand, x, 0.02, -0.002);
    EXPECT_NEAR(hand.Scene->GetForce()[2], (400.0 + 2000.0 * x) * 0.002, 1e-3) << x;
    EXPECT_NEAR(hand.Scene->GetServo()->GetReadings()->GetStiffness(), 400.0 + 2000.0 * x, 1e-2);
  }
}

TEST(SceneProperties, StiffnessIsNotMoreThanTheDeviceCanHold)
{
  LedHand hand;
  const int table = hand.Scene->AddSurface(MakeTable(0.0));
  hand.Scene->GetSurfaceProperties(table)->SetStiffness(1e5);
  hand.Scene->SetStiffness(1e5);
  const double most = hand.Scene->GetServo()->GetEffectiveStiffness();
  ASSERT_LT(most, 1e4);
  hand.MoveTo(0.001);
  hand.MoveTo(-0.001);
  EXPECT_NEAR(hand.Scene->GetForce()[2], most * 0.001, most * Clearance);
  EXPECT_NE(hand.Scene->GetServo()->GetReadings()->DescribeForceLimits().find("stiffness limit"),
    std::string::npos);
  // What a surface damps is missing for its stiffness; it may take half of the device's own.
  hand.Scene->GetSurfaceProperties(table)->SetDamping(1e3);
  hand.MoveTo(0.001);
  hand.MoveTo(-0.001);
  EXPECT_NEAR(hand.Scene->GetServo()->GetReadings()->GetStiffness(), 0.5 * most, 0.01 * most);
}

TEST(SceneProperties, AnActorMayBeMirroredAndScaled)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeStiffTable());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(-2.0, 2.0, 2.0);
  LedHand hand;
  const int table = hand.Scene->AddSurface(actor);
  hand.Scene->SetSurfacePropertyArray(table, vtkHapticProperties::STIFFNESS, AtPoints, "stiff");
  hand.Scene->GetSurfaceProperties(table)->ForceShadingOn();
  for (const double x : { -0.1, 0.0, 0.1 })
  {
    PressAt(hand, x, 0.02, 0.001);
    PressAt(hand, x, 0.02, -0.002);
    EXPECT_NEAR(hand.Scene->GetForce()[2], (400.0 - 1000.0 * x) * 0.002, 2e-3) << x;
    // Towards where it is softer: d^2 / 2 of its 1000 N/m over a metre.
    EXPECT_NEAR(hand.Scene->GetForce()[0], 0.5 * 0.002 * 0.002 * 1000.0, 1e-6);
  }
}

TEST(SceneProperties, FrictionDragsAndIsInTheTrace)
{
  LedHand hand;
  const int table = hand.Scene->AddSurface(MakeTable(0.0));
  hand.Scene->SetStiffness(400.0);
  hand.Scene->GetSurfaceProperties(table)->SetStaticFriction(0.5);
  hand.Scene->GetSurfaceProperties(table)->SetDynamicFriction(0.3);
  PressAt(hand, 0.01, 0.02, 0.001);
  hand.Scene->StartRecording();
  for (int tick = 0; tick <= 50; ++tick)
  {
    PressAt(hand, 0.01, 0.02, 0.001 - 1e-4 * tick);
  }
  for (int tick = 0; tick < 300; ++tick)
  {
    PressAt(hand, 0.01 + 1e-4 * tick, 0.02, -0.004);
  }
  const double* force = hand.Scene->GetForce();
  EXPECT_NEAR(force[2], 1.6, 1e-3);
  EXPECT_NEAR(force[0], -0.3 * 1.6, 1e-3);
  vtkPointData* data = hand.Scene->GetTrace()->GetPointData();
  vtkDataArray* energy = data->GetArray("Energy");
  const vtkIdType last = energy->GetNumberOfTuples() - 1;
  // 0.48 N over 28 mm, and the spring's 3.2 mJ with what drags it: all the hand's.
  const double least = 0.48 * 0.028 + 0.5 * 400.0 * (0.004 * 0.004 * (1.0 + 0.09));
  EXPECT_NEAR(energy->GetComponent(last, 0), least, 0.05 * least);
  // The observer counts what the device's own damping has taken, too.
  EXPECT_GT(
    hand.Scene->GetServo()->GetReadings()->GetObservedEnergy(), energy->GetComponent(last, 0));
  EXPECT_EQ(data->GetArray("EnergyTank")->GetComponent(last, 0), 0.0)
    << "no place is stiffer: there is nothing to save for";
  EXPECT_EQ(data->GetArray("EnergyTank")->GetComponent(last, 0),
    hand.Scene->GetServo()->GetReadings()->GetEnergyTank());
  EXPECT_NEAR(data->GetArray("Stiffness")->GetComponent(last, 0), 400.0, 1e-9);
}

// Softer within a tick would be like a surface that has gone.
TEST(SceneProperties, WhatSoftensUnderTheHandFallsOverTheSoftStartsTime)
{
  using Change = std::function<void(vtkHapticScene*, int, vtkPolyData*)>;
  const struct
  {
    const char* Name;
    Change Soften;
  } changes[] = { { "array away, softer constant",
                    [](vtkHapticScene* scene, int id, vtkPolyData*) {
                      scene->SetSurfacePropertyArray(
                        id, vtkHapticProperties::STIFFNESS, AtPoints, "");
                    } },
    { "softer values",
      [](vtkHapticScene*, int, vtkPolyData* table)
      {
        table->GetPointData()->GetArray("stiff")->Fill(200.0);
        table->GetPointData()->GetArray("stiff")->Modified();
        table->Modified();
      } },
    { "softer constant",
      [](vtkHapticScene* scene, int id, vtkPolyData*)
      {
        scene->SetSurfacePropertyArray(id, vtkHapticProperties::STIFFNESS, AtPoints, "");
        scene->GetSurfaceProperties(id)->SetStiffness(200.0);
      } } };
  for (const auto& change : changes)
  {
    SCOPED_TRACE(change.Name);
    vtkNew<vtkSimulatedHapticDevice> device;
    vtkNew<vtkHapticScene> scene;
    scene->SetDevice(device);
    scene->SetStiffness(200.0);
    const vtkSmartPointer<vtkPolyData> table = MakeStiffTable();
    table->GetPointData()->GetArray("stiff")->Fill(600.0);
    const int id = scene->AddSurface(table);
    scene->SetSurfacePropertyArray(id, vtkHapticProperties::STIFFNESS, AtPoints, "stiff");
    for (int tick = 0; tick < 600; ++tick)
    {
      device->SetPosition(0.01, 0.02, std::max(0.005 - 1e-4 * tick, -0.003));
      scene->Step(1);
    }
    double force[3];
    scene->GetForce(force);
    ASSERT_NEAR(force[2], 1.8, 1e-4); // the clearance
    scene->StartRecording();
    change.Soften(scene, id, table);
    double last = force[2];
    for (int tick = 0; tick < 105; ++tick)
    {
      scene->Step(1);
      scene->GetForce(force);
      ASSERT_LE(last - force[2], 1.2 / 100.0 + 1e-4) << "1.2 N in 0.1 s, tick " << tick;
      last = force[2];
    }
    EXPECT_NEAR(force[2], 0.6, 1e-4);
    vtkPointData* const trace = scene->GetTrace()->GetPointData();
    const vtkIdType rows = trace->GetArray("Force")->GetNumberOfTuples();
    for (vtkIdType row = 0; row < rows; ++row)
    {
      EXPECT_NEAR(trace->GetArray("Stiffness")->GetComponent(row, 0) * 0.003,
        trace->GetArray("Force")->GetComponent(row, 2), 1e-4)
        << "what is in effect is what is reported";
    }
    // Outside nothing is left of it.
    device->SetPosition(0.01, 0.02, 0.001);
    scene->Step(1);
    scene->GetForce(force);
    EXPECT_EQ(force[2], 0.0);
  }
}

// With the safety as it comes, in the middle of a stroke: it is said what is wrong with the array,
// the constant counts, and when the array is good again it counts and nothing is wrong.
TEST(SceneProperties, NothingJumpsWhereAnArrayGoesBad)
{
  const auto make = [](int components, vtkIdType values, double value)
  {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName("stiff");
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(values);
    array->Fill(value);
    return array;
  };
  const struct
  {
    const char* Words;
    vtkSmartPointer<vtkDoubleArray> Array;
  } faults[] = { { "no array stiff", nullptr }, { "has 3 components", make(3, 4, 400.0) },
    { "no array stiff", make(1, 3, 400.0) }, { "no array stiff", make(1, 0, 400.0) },
    { "4 of 4 places", make(1, 4, std::nan("")) },
    { "4 of 4 places", make(1, 4, std::numeric_limits<double>::infinity()) },
    { "4 of 4 places", make(1, 4, -1.0) } };
  for (const auto& fault : faults)
  {
    SCOPED_TRACE(std::to_string(&fault - faults) + ": " + fault.Words);
    vtkNew<vtkSimulatedHapticDevice> device;
    vtkNew<vtkHapticScene> scene;
    scene->SetDevice(device);
    vtkSmartPointer<vtkPolyData> table = MakeStiffTable();
    const vtkSmartPointer<vtkDataArray> good = table->GetPointData()->GetArray("stiff");
    const int id = scene->AddSurface(table);
    scene->SetSurfacePropertyArray(id, vtkHapticProperties::STIFFNESS, AtPoints, "stiff");
    scene->GetSurfaceProperties(id)->SetStaticFriction(0.6);
    scene->GetSurfaceProperties(id)->SetDynamicFriction(0.5);
    scene->GetSurfaceProperties(id)->SetStiffness(600.0);
    EventCounter errors(scene, vtkHapticScene::SurfaceErrorEvent);
    EventCounter quiet(scene, vtkCommand::ErrorEvent);
    double last[3] = { 0.0, 0.0, 0.0 };
    for (int tick = 0; tick < 1500; ++tick)
    {
      if (tick == 500 || tick == 1000)
      {
        table->GetPointData()->RemoveArray("stiff");
        vtkDataArray* const now = tick == 500 ? fault.Array.Get() : good.Get();
        if (now)
        {
          table->GetPointData()->AddArray(now);
        }
        table->Modified();
      }
      device->SetPosition(-0.05 + 1e-5 * tick, 0.02, std::max(0.005 - 1e-4 * tick, -0.004));
      scene->Step(1);
      double now[3];
      scene->GetForce(now);
      const double step = std::hypot(now[0] - last[0], now[1] - last[1], now[2] - last[2]);
      // Pressing at 0.1 m/s makes 0.06 N a tick, a slip of friction 0.12 N; then it only slides.
      ASSERT_LE(step, tick < 450 ? 0.2 : 0.05) << "tick " << tick;
      std::copy_n(now, 3, last);
      if (tick == 999)
      {
        EXPECT_EQ(errors.Count, 1);
        EXPECT_NE(std::string(scene->GetErrorMessage()).find(fault.Words), std::string::npos)
          << scene->GetErrorMessage();
        // Friction has paid for the rise to the constant by now.
        EXPECT_NEAR(last[2], 0.004 * 600.0, 0.02);
      }
    }
    EXPECT_EQ(errors.Count, 1);
    EXPECT_STREQ(scene->GetErrorMessage(), "") << "it is mended";
    EXPECT_NEAR(last[2], 0.004 * (400.0 + 2000.0 * -0.035), 0.02);
  }
}
