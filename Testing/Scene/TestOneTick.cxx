// vtkGodObjectTrace and a scene report the same of the same path, array by array.
#include "SceneTestTools.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticProperties.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace
{
using Point = std::array<double, 3>;

struct TickScene
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Surface;
  std::function<void(vtkHapticProperties*)> SetProperties;
  std::vector<Point> Path;
};

/// From above into the surface, along x by three strokes of different depth, up again.
std::vector<Point> Strokes(double y, double depth)
{
  std::vector<Point> path;
  const auto goTo = [&path](const Point& to, int ticks)
  {
    const Point from = path.back();
    for (int i = 1; i <= ticks; ++i)
    {
      const double t = static_cast<double>(i) / ticks;
      path.push_back({ from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]),
        from[2] + t * (to[2] - from[2]) });
    }
  };
  path.push_back({ -0.05, y, 0.03 });
  goTo({ -0.05, y, -depth }, 60);
  goTo({ 0.05, y + 0.01, -0.5 * depth }, 300);
  goTo({ 0.02, y - 0.01, -1.3 * depth }, 200);
  goTo({ -0.04, y, -depth }, 200);
  goTo({ -0.04, y, 0.03 }, 60);
  return path;
}

/// Two slopes of 0.5 that meet in a crease along y at x = 0, a little out of the symmetry.
vtkSmartPointer<vtkPolyData> MakeValley()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const double y : { -0.1, 0.1 })
  {
    points->InsertNextPoint(-0.1, y, 0.05);
    points->InsertNextPoint(0.0, y, 0.0);
    points->InsertNextPoint(0.1, y, 0.06);
  }
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1, 4, 3 });
  cells->InsertNextCell({ 1, 2, 5, 4 });
  auto valley = vtkSmartPointer<vtkPolyData>::New();
  valley->SetPoints(points);
  valley->SetPolys(cells);
  return valley;
}

std::vector<TickScene> Scenes()
{
  const auto plain = [](vtkHapticProperties*) {};
  const auto rough = [](vtkHapticProperties* properties)
  {
    properties->SetStaticFriction(0.5);
    properties->SetDynamicFriction(0.3);
  };
  const auto material = [](vtkHapticProperties* properties)
  {
    properties->SetStiffness(320.0);
    properties->SetDamping(0.7);
    properties->SetTexture(0.1);
    properties->ForceShadingOn();
    properties->SetFeatureAngle(180.0);
  };
  const auto button = [](vtkHapticProperties* properties)
  { properties->SetForceProfileToButton(400.0, 0.003, 0.5); };
  std::vector<Point> along; // the crease, pressed against the right slope, then the left one
  for (int i = 0; i <= 400; ++i)
  {
    along.push_back(
      { 0.003 * std::sin(0.05 * i), -0.05 + 2e-4 * i, 0.02 - 1e-4 * std::min(i, 250) });
  }
  return { { "plain", MakeTable(0.0), plain, Strokes(0.02, 0.003) },
    { "valley", MakeValley(), plain, along }, { "rough valley", MakeValley(), rough, along },
    { "valley with material", MakeValley(), material, along },
    { "friction", MakeTable(0.0), rough, Strokes(0.02, 0.003) },
    { "properties", MakeTable(0.0), material, Strokes(0.02, 0.003) },
    { "profile", MakeTable(0.0), button, Strokes(0.02, 0.004) } };
}

/// A height field of steep facets, where a coarse step can end in another valley than a fine one.
vtkSmartPointer<vtkPolyData> MakeRoughTable()
{
  constexpr int size = 40;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> height(-0.004, 0.004);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i <= size; ++i)
  {
    for (int j = 0; j <= size; ++j)
    {
      points->InsertNextPoint(0.2 * i / size - 0.1, 0.2 * j / size - 0.1, height(random));
      const vtkIdType at = points->GetNumberOfPoints() - 1;
      if (i > 0 && j > 0)
      {
        cells->InsertNextCell({ at - size - 2, at - 1, at });
        cells->InsertNextCell({ at - size - 2, at, at - size - 1 });
      }
    }
  }
  auto table = vtkSmartPointer<vtkPolyData>::New();
  table->SetPoints(points);
  table->SetPolys(cells);
  return table;
}

/// Strokes side by side over it.
std::vector<Point> RoughStrokes()
{
  std::vector<Point> path;
  for (const double y : { -0.06, -0.03, 0.0, 0.03, 0.06 })
  {
    const std::vector<Point> strokes = Strokes(y, 0.01);
    path.insert(path.end(), strokes.begin(), strokes.end());
  }
  return path;
}

/// The same path by the filter.
vtkSmartPointer<vtkPolyData> TraceOf(const TickScene& scene, double scale, int substeps = 1)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& p : scene.Path)
  {
    points->InsertNextPoint(p.data());
  }
  vtkNew<vtkPolyData> path;
  path->SetPoints(points);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(path);
  trace->SetSurfaceData(scene.Surface);
  trace->PassSurfaceArraysOff(); // what a scene has none of unless it is asked
  trace->SetWorldToDeviceScale(1.0 / scale);
  trace->SetSubstepLimit(substeps);
  scene.SetProperties(trace->GetProperties());
  trace->Update();
  return trace->GetOutput();
}

/// And by a servo, whose device's own scale is `scale` world units a metre.
vtkSmartPointer<vtkPolyData> RecordOf(
  const TickScene& scene, double scale, bool isGuarded, int substeps = 1)
{
  LedHand hand;
  hand.Scene->GetServo()->SetSubstepLimit(substeps);
  hand.Device->SetDamping(0.0); // nothing limits the stiffness that it does not know
  if (isGuarded)
  {
    hand.Scene->GetServo()->GetSafety()->SetSoftStartTime(0.1);
    hand.Scene->GetServo()->GetSafety()->SetSlewLimit(50.0);
  }
  vtkNew<vtkMatrix4x4> deviceToWorld;
  for (int i = 0; i < 3; ++i)
  {
    deviceToWorld->SetElement(i, i, scale);
  }
  hand.Scene->SetWorkspaceTransform(deviceToWorld);
  const int id = hand.Scene->AddSurface(scene.Surface);
  scene.SetProperties(hand.Scene->GetSurfaceProperties(id));
  hand.Scene->StartRecording();
  for (const Point& p : scene.Path)
  {
    hand.Device->SetPosition(p[0] / scale, p[1] / scale, p[2] / scale);
    hand.Scene->Step(1);
  }
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(hand.Scene->GetTrace());
  return copy;
}

/// The largest difference of an array between two traces.
double Difference(vtkPolyData* a, vtkPolyData* b, const char* name)
{
  vtkDataArray* const x = a->GetPointData()->GetArray(name);
  vtkDataArray* const y = b->GetPointData()->GetArray(name);
  if (!x || !y || x->GetNumberOfTuples() != y->GetNumberOfTuples() ||
    x->GetNumberOfComponents() != y->GetNumberOfComponents() ||
    x->GetDataType() != y->GetDataType())
  {
    return HUGE_VAL;
  }
  double largest = 0.0;
  for (vtkIdType i = 0; i < x->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < x->GetNumberOfComponents(); ++k)
    {
      largest = std::max(largest, std::abs(x->GetComponent(i, k) - y->GetComponent(i, k)));
    }
  }
  return largest;
}

int LargestNumberOfConstraints(vtkPolyData* trace)
{
  double range[2];
  trace->GetPointData()->GetArray("ActiveConstraints")->GetRange(range);
  return static_cast<int>(range[1]);
}

/// What no guard changes.
const char* const OfTheContact[] = { "HapticInterfacePoint", "ActiveConstraints", "Surface",
  "OriginalCellId", "Penetration" };
}

TEST(OneTick, FilterAndSceneWriteTheSameArrays)
{
  for (const TickScene& scene : Scenes())
  {
    const auto filter = TraceOf(scene, 1.0);
    const auto servo = RecordOf(scene, 1.0, false);
    ASSERT_EQ(filter->GetNumberOfPoints(), servo->GetNumberOfPoints());
    const int arrays = servo->GetPointData()->GetNumberOfArrays();
    EXPECT_EQ(filter->GetPointData()->GetNumberOfArrays(), arrays) << scene.Name;
    EXPECT_GE(arrays, 10);
    for (int i = 0; i < arrays; ++i)
    {
      const char* const name = servo->GetPointData()->GetArrayName(i);
      // A servo's periods are differences of times, which damping and shading see the last bits of.
      const bool isOfTheContact = std::find(std::begin(OfTheContact), std::end(OfTheContact),
                                    std::string(name)) != std::end(OfTheContact);
      EXPECT_LE(Difference(filter, servo, name), isOfTheContact ? 0.0 : 1e-12)
        << scene.Name << ": " << name;
    }
    for (vtkIdType i = 0; i < servo->GetNumberOfPoints(); ++i)
    {
      double a[3];
      double b[3];
      filter->GetPoint(i, a);
      servo->GetPoint(i, b);
      ASSERT_EQ(vtkMath::Distance2BetweenPoints(a, b), 0.0) << scene.Name << ", tick " << i;
    }
    EXPECT_EQ(LargestNumberOfConstraints(servo), scene.Surface->GetNumberOfCells()) << scene.Name;
  }
}

TEST(OneTick, AndFollowTheWayWithinATickInAsManySteps)
{
  const TickScene scene{ "rough", MakeRoughTable(), [](vtkHapticProperties*) {}, RoughStrokes() };
  const auto inOne = TraceOf(scene, 1.0);
  const auto inSixteen = TraceOf(scene, 1.0, 16);
  EXPECT_GT(Difference(inOne, inSixteen, "Penetration"), 1e-4);
  for (const int limit : { 1, 16, 1000 }) // clamped to 16
  {
    const auto filter = limit == 1 ? inOne : inSixteen;
    const auto servo = RecordOf(scene, 1.0, false, limit);
    for (const char* name : OfTheContact)
    {
      EXPECT_EQ(Difference(filter, servo, name), 0.0) << name << ", " << limit;
    }
  }
}

// The setting is the scene's: it acts on the next tick, and on surfaces that come later.
TEST(OneTick, TheSubstepLimitOutlivesASurfaceAndChangesWhileRunning)
{
  LedHand hand;
  EXPECT_EQ(hand.Scene->GetServo()->GetSubstepLimit(), 1);
  hand.Scene->GetServo()->SetSubstepLimit(16);
  const auto stroke = [&](int substeps)
  {
    const int id = hand.Scene->AddSurface(MakeRoughTable());
    hand.Scene->StartRecording();
    for (const Point& p : RoughStrokes())
    {
      hand.Device->SetPosition(p[0], p[1], p[2]);
      hand.Scene->GetServo()->SetSubstepLimit(substeps);
      hand.Scene->Step(1);
    }
    vtkNew<vtkPolyData> copy;
    copy->DeepCopy(hand.Scene->GetTrace());
    hand.Scene->RemoveSurface(id);
    return vtkSmartPointer<vtkPolyData>(copy.Get());
  };
  const auto first = stroke(16);
  const auto inOne = stroke(1);
  const auto again = stroke(16);
  EXPECT_LT(Difference(first, again, "Penetration"), 1e-12);
  EXPECT_GT(Difference(first, inOne, "Penetration"), 1e-4);
  hand.Scene->GetServo()->SetSubstepLimit(-3);
  EXPECT_EQ(hand.Scene->GetServo()->GetSubstepLimit(), 1);
}

TEST(OneTick, AScaledWorldChangesRoundingsOnly)
{
  for (TickScene scene : Scenes())
  {
    const double scale = 40.0;
    vtkNew<vtkPolyData> large;
    large->DeepCopy(scene.Surface);
    for (vtkIdType i = 0; i < large->GetNumberOfPoints(); ++i)
    {
      double p[3];
      large->GetPoint(i, p);
      large->GetPoints()->SetPoint(i, scale * p[0], scale * p[1], scale * p[2]);
    }
    scene.Surface = large;
    for (Point& p : scene.Path)
    {
      p = { scale * p[0], scale * p[1], scale * p[2] };
    }
    const auto filter = TraceOf(scene, scale);
    const auto servo = RecordOf(scene, scale, false);
    for (const char* name : { "Force", "Stiffness", "Energy", "EnergyTank", "Penetration" })
    {
      EXPECT_LT(Difference(filter, servo, name), 1e-9) << scene.Name << ": " << name;
    }
  }
}

TEST(OneTick, AForceGuardChangesTheForceAndWhatItDoesAndNothingElse)
{
  for (const TickScene& scene : Scenes())
  {
    const auto filter = TraceOf(scene, 1.0);
    const auto servo = RecordOf(scene, 1.0, true);
    for (const char* name : OfTheContact)
    {
      EXPECT_EQ(Difference(filter, servo, name), 0.0) << scene.Name << ": " << name;
    }
    EXPECT_GT(Difference(filter, servo, "Force"), 0.01) << scene.Name << ": the guard limits";
    // Energy is that of the forces in the trace, whoever made them.
    for (vtkPolyData* trace : { filter.Get(), servo.Get() })
    {
      vtkDataArray* const force = trace->GetPointData()->GetArray("Force");
      vtkDataArray* const hip = trace->GetPointData()->GetArray("HapticInterfacePoint");
      vtkDataArray* const energy = trace->GetPointData()->GetArray("Energy");
      double work = 0.0;
      for (vtkIdType i = 0; i < trace->GetNumberOfPoints(); ++i)
      {
        for (int k = 0; i > 0 && k < 3; ++k)
        {
          work -=
            force->GetComponent(i - 1, k) * (hip->GetComponent(i, k) - hip->GetComponent(i - 1, k));
        }
        ASSERT_NEAR(energy->GetComponent(i, 0), work, 1e-12) << scene.Name << ", tick " << i;
      }
    }
  }
}

TEST(OneTick, TheCellThatPushesMostComesFirst)
{
  const TickScene scene = Scenes()[1];
  const auto servo = RecordOf(scene, 1.0, false);
  vtkDataArray* const cell = servo->GetPointData()->GetArray("OriginalCellId");
  vtkDataArray* const constraints = servo->GetPointData()->GetArray("ActiveConstraints");
  vtkDataArray* const force = servo->GetPointData()->GetArray("Force");
  const Point normals[2] = { { 0.5, 0.0, 1.0 }, { -0.6, 0.0, 1.0 } };
  int ticks = 0;
  for (vtkIdType i = 0; i < servo->GetNumberOfPoints(); ++i)
  {
    if (constraints->GetComponent(i, 0) != 2.0)
    {
      continue;
    }
    ++ticks;
    double push[2];
    for (int k = 0; k < 2; ++k)
    {
      push[k] = (normals[k][0] * force->GetComponent(i, 0) + force->GetComponent(i, 2)) /
        std::hypot(normals[k][0], 1.0);
    }
    if (std::abs(push[0] - push[1]) > 1e-9)
    {
      ASSERT_EQ(cell->GetComponent(i, 0), push[0] > push[1] ? 0 : 1) << "tick " << i;
    }
  }
  EXPECT_GT(ticks, 50);
}
