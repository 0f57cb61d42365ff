#include "../TemporaryFolder.h"
#include "FilterTesting.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

using namespace testing_surfaces;

namespace
{
/// Two triangles from (-1,-1,0) to (1,1,0), seen from above; cell 0 has x > y.
vtkSmartPointer<vtkPolyData> Plane()
{
  return MakePolyData({ { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 } }, {}, {}, {} });
}

/// From one position to another in steps, both included.
void AddLine(std::vector<Point>& path, const Point& from, const Point& to, int steps)
{
  for (int i = 0; i <= steps; ++i)
  {
    const double t = static_cast<double>(i) / steps;
    path.push_back({ from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]),
      from[2] + t * (to[2] - from[2]) });
  }
}

vtkSmartPointer<vtkPolyData> Path(const std::vector<Point>& positions)
{
  return MakePolyData({ positions, {}, {}, {}, {} });
}

Point Tuple(vtkPolyData* trace, const char* name, vtkIdType tick)
{
  Point value{};
  trace->GetPointData()->GetArray(name)->GetTuple(tick, value.data());
  return value;
}

double Value(vtkPolyData* trace, const char* name, vtkIdType tick)
{
  return trace->GetPointData()->GetArray(name)->GetTuple1(tick);
}

double Distance(const Point& a, const Point& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// The god-object floats in front of a facet by the surface's clearance, about 1e-6 of its size.
constexpr double Clearance = 1e-5;
}

TEST(GodObjectTrace, StaysAboveTheHipOnAPlane)
{
  //   \          ______
  // ---o--------o------   god-object
  //     \______/          HIP
  std::vector<Point> positions;
  AddLine(positions, { 0.5, -0.5, 0.1 }, { 0.5, -0.5, -0.002 }, 100);
  const auto deepest = static_cast<vtkIdType>(positions.size()) - 1;
  AddLine(positions, { 0.5, -0.5, -0.002 }, { 0.5, 0.7, -0.002 }, 200);
  const auto slid = static_cast<vtkIdType>(positions.size()) - 1;
  AddLine(positions, { 0.5, 0.7, -0.002 }, { 0.5, 0.7, 0.1 }, 100);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path(positions));
  trace->SetSurfaceData(Plane());
  trace->Update();
  vtkPolyData* output = trace->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), static_cast<vtkIdType>(positions.size()));
  EXPECT_EQ(output->GetNumberOfLines(), 1);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const Point& hip = positions[i];
    const Point expected{ hip[0], hip[1], std::max(hip[2], 0.0) };
    Point god;
    output->GetPoint(i, god.data());
    EXPECT_LT(Distance(god, expected), Clearance) << "tick " << i;
    EXPECT_EQ(Tuple(output, "HapticInterfacePoint", i), hip);
    EXPECT_NEAR(Value(output, "Penetration", i), std::max(-hip[2], 0.0), Clearance);
  }
  EXPECT_EQ(Value(output, "ActiveConstraints", 0), 0);
  EXPECT_EQ(Value(output, "OriginalCellId", 0), -1);
  EXPECT_EQ(Tuple(output, "Force", 0), (Point{ 0, 0, 0 }));
  EXPECT_EQ(Value(output, "ActiveConstraints", deepest), 1);
  EXPECT_EQ(Value(output, "OriginalCellId", deepest), 0) << "x > y";
  EXPECT_EQ(Value(output, "OriginalCellId", slid), 1) << "x < y";
  // 500 N/m at 2 mm; the clearance adds 500 N/m * 1e-5 m at most.
  EXPECT_LT(Distance(Tuple(output, "Force", deepest), { 0, 0, 1.0 }), 0.005);
  EXPECT_EQ(Value(output, "ActiveConstraints", output->GetNumberOfPoints() - 1), 0);
}

TEST(GodObjectTrace, FollowsTheFootPointOnASphere)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(256);
  sphere->SetPhiResolution(256);
  std::vector<Point> positions;
  AddLine(positions, { 1.2, 0, 0.3 }, { 0.95, 0, 0.3 }, 50);
  for (int i = 0; i <= 500; ++i)
  {
    const double angle = 0.004 * i;
    positions.push_back({ 0.95 * std::cos(angle), 0.95 * std::sin(angle), 0.3 });
  }
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path(positions));
  trace->SetSurfaceConnection(sphere->GetOutputPort());
  trace->SetStiffness(100.0);
  trace->SetMaximumForce(1000.0);
  trace->Update();
  vtkPolyData* output = trace->GetOutput();
  const double depth = 1.0 - std::hypot(0.95, 0.3);
  for (vtkIdType i = 60; i < output->GetNumberOfPoints(); ++i)
  {
    const Point& hip = positions[i];
    const double radius = std::hypot(hip[0], hip[1], hip[2]);
    const Point foot{ hip[0] / radius, hip[1] / radius, hip[2] / radius };
    Point god;
    output->GetPoint(i, god.data());
    // Facets of 0.025: they lie up to 1.5e-4 below the sphere, and are tilted against it by up to
    // 0.018, which shifts the foot point by that times the depth.
    EXPECT_LT(Distance(god, foot), 1.5e-4 + 0.018 * depth) << "tick " << i;
    const Point force = Tuple(output, "Force", i);
    EXPECT_NEAR(std::hypot(force[0], force[1], force[2]), 100.0 * depth, 100.0 * 2e-4);
  }
}

TEST(GodObjectTrace, ScalesTheForceFromWorldToDevice)
{
  std::vector<Point> positions;
  AddLine(positions, { 0.5, 0, 0.1 }, { 0.5, 0, -0.1 }, 20);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path(positions));
  trace->SetSurfaceData(Plane());
  trace->SetWorldToDeviceScale(0.01); // 0.1 world units are 1 mm
  trace->SetStiffness(1000.0);
  trace->Update();
  EXPECT_NEAR(Tuple(trace->GetOutput(), "Force", 20)[2], 1.0, 1e-4) << "clearance 1e-5 * 10 N";
  trace->SetMaximumForce(0.25);
  trace->Update();
  EXPECT_NEAR(Tuple(trace->GetOutput(), "Force", 20)[2], 0.25, 1e-12);
}

/// A plane of 200 mm, pressed by 2 mm.
class PlaneInMillimetres : public ::testing::Test
{
protected:
  PlaneInMillimetres()
  {
    auto plane = Plane();
    for (vtkIdType i = 0; i < 4; ++i)
    {
      double p[3];
      plane->GetPoint(i, p);
      plane->GetPoints()->SetPoint(i, 100.0 * p[0], 100.0 * p[1], p[2]);
    }
    this->Trace->SetInputData(Path({ { 10, 0, 1 }, { 10, 0, -2 } }));
    this->Trace->SetSurfaceData(plane);
  }
  double Force()
  {
    this->Trace->Update();
    return Tuple(this->Trace->GetOutput(), "Force", 1)[2];
  }
  std::string UnitOf(vtkDataArray* array)
  {
    const char* const unit = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    return unit ? unit : "";
  }
  std::string UnitOf(const char* name)
  {
    return this->UnitOf(this->Trace->GetOutput()->GetPointData()->GetArray(name));
  }
  const double Clearance = 500.0 * 2e-5; // [N], of 20 um

  vtkNew<vtkGodObjectTrace> Trace;
};

TEST_F(PlaneInMillimetres, IsReportedOnceWithARemedyThatHelps)
{
  MessageCatcher messages(this->Trace);
  EXPECT_NEAR(this->Force(), 3.3, 1e-12) << "2 m deep: the largest force";
  const std::string warning = messages.Warnings();
  EXPECT_NE(warning.find("200 world units across"), std::string::npos) << warning;
  EXPECT_NE(warning.find("SetUnitLength(0.001)"), std::string::npos) << warning;
  EXPECT_NE(warning.find("SetWorldToDeviceScale(0.0005)"), std::string::npos) << warning;
  this->Trace->SetStiffness(400.0);
  this->Force();
  EXPECT_EQ(messages.Warnings(), warning) << "once";

  for (const bool byUnit : { true, false }) // both remedies
  {
    MessageCatcher after(this->Trace);
    this->Trace->SetStiffness(500.0);
    this->Trace->SetUnitLength(byUnit ? 0.001 : 0.0);
    this->Trace->SetWorldToDeviceScale(byUnit ? 0.0 : 0.0005);
    EXPECT_NEAR(this->Force(), byUnit ? 1.0 : 0.5, this->Clearance);
    EXPECT_EQ(after.Warnings() + after.Errors(), "");
  }
  this->Trace->SetWorldToDeviceScale(0.0); // again, after it was right
  this->Force();
  EXPECT_EQ(messages.Warnings(), warning + warning);
}

TEST_F(PlaneInMillimetres, IsReportedAsTooSmallInMicrometres)
{
  MessageCatcher messages(this->Trace);
  this->Trace->SetUnitLength(1e-6);
  this->Force();
  EXPECT_NE(messages.Warnings().find("0.0002 m in the hand"), std::string::npos)
    << messages.Warnings();
  EXPECT_EQ(messages.Warnings().find("SetUnitLength"), std::string::npos) << "it is known";
  EXPECT_NE(messages.Warnings().find("SetWorldToDeviceScale(0.0005)"), std::string::npos);
  this->Trace->SetWorldToDeviceScale(0.0005);
  MessageCatcher after(this->Trace);
  EXPECT_NEAR(this->Force(), 0.5, this->Clearance);
  EXPECT_EQ(after.Warnings(), "");
}

TEST_F(PlaneInMillimetres, LengthsHaveTheirUnit)
{
  this->Trace->SetWorldToDeviceScale(0.001);
  const std::pair<double, const char*> units[] = { { 0.0, "" }, { 0.001, "mm" }, { 1.0, "m" },
    { 1e-6, "um" }, { 0.0254, "in" }, { 0.5, "0.5 m" } };
  for (const auto& unit : units)
  {
    this->Trace->SetUnitLength(unit.first);
    EXPECT_NEAR(this->Force(), 1.0, this->Clearance) << "in the hand it is as large as ever";
    EXPECT_EQ(this->UnitOf("HapticInterfacePoint"), unit.second);
    EXPECT_EQ(this->UnitOf("Penetration"), unit.second);
    EXPECT_EQ(this->UnitOf(this->Trace->GetOutput()->GetPoints()->GetData()), unit.second);
    EXPECT_EQ(this->UnitOf("Force"), "N");
    EXPECT_EQ(this->UnitOf("Normal"), "") << "it has none";
  }
}

TEST_F(PlaneInMillimetres, UnitsThatAreNoneAreErrorsAndChangeNothing)
{
  this->Trace->SetUnitLength(0.001);
  const double before = this->Force();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { -1.0, std::nan(""), infinity, -infinity, 1e-300, 1e300 })
  {
    MessageCatcher messages(this->Trace);
    this->Trace->SetUnitLength(bad);
    EXPECT_NE(messages.Errors().find("UnitLength has to be a length"), std::string::npos) << bad;
    this->Trace->SetWorldToDeviceScale(bad);
    EXPECT_NE(messages.Errors().find("WorldToDeviceScale has to be a length"), std::string::npos)
      << bad;
    EXPECT_EQ(this->Trace->GetUnitLength(), 0.001);
    EXPECT_EQ(this->Trace->GetWorldToDeviceScale(), 0.0);
    EXPECT_EQ(this->Force(), before);
  }
}

TEST_F(PlaneInMillimetres, IsWrittenAsATable)
{
  this->Trace->SetUnitLength(0.001);
  MessageCatcher messages(this->Trace);
  const TemporaryFolder folder;
  const std::string file = folder.File("trace.csv");
  EXPECT_FALSE(this->Trace->WriteCSV(file.c_str())) << "there is none yet";
  EXPECT_NE(messages.Errors().find("Update()"), std::string::npos) << messages.Errors();
  this->Force(); // the remedy
  ASSERT_TRUE(this->Trace->WriteCSV(file.c_str()));
  std::ifstream stream(file);
  std::string names;
  std::string free;
  std::string pressed;
  std::string more;
  std::getline(stream, names);
  std::getline(stream, free);
  std::getline(stream, pressed);
  EXPECT_FALSE(std::getline(stream, more)) << "a line a tick";
  EXPECT_EQ(names.rfind("Time,GodObject_X,GodObject_Y,GodObject_Z,HapticInterfacePoint_X,", 0), 0u)
    << names;
  EXPECT_EQ(free.rfind("0,10,0,1,10,0,1,0,0,0,", 0), 0u) << free;
  EXPECT_EQ(pressed.rfind("0.001,10,0,", 0), 0u) << pressed;
  const auto fields = [](const std::string& line)
  { return std::count(line.begin(), line.end(), ','); };
  EXPECT_EQ(fields(names), fields(pressed));

  EXPECT_FALSE(this->Trace->WriteCSV(folder.File("no folder/trace.csv").c_str()));
  EXPECT_NE(messages.Errors().find("Make its folder first"), std::string::npos);
  EXPECT_FALSE(this->Trace->WriteCSV(nullptr));
  EXPECT_FALSE(this->Trace->WriteCSV(""));
}

TEST(GodObjectTrace, TextsOfATableAreQuoted)
{
  auto path = Path({ { 0, 0, 1 }, { 0, 0, 2 } });
  vtkNew<vtkStringArray> notes;
  notes->SetName("Note, or \"remark\"");
  notes->InsertNextValue("a,b");
  notes->InsertNextValue("plain");
  path->GetPointData()->AddArray(notes);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(path);
  trace->SetSurfaceData(Plane());
  trace->Update();
  const TemporaryFolder folder;
  const std::string file = folder.File("texts.csv");
  ASSERT_TRUE(trace->WriteCSV(file.c_str()));
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  for (const char* const field : { "\"Note, or \"\"remark\"\"\"", "\"a,b\"\n", ",plain\n" })
  {
    EXPECT_NE(text.str().find(field), std::string::npos) << text.str();
  }
}

TEST(GodObjectTrace, PassesThePointDataOfThePath)
{
  auto path = Path({ { 0, 0, 1 }, { 0, 0, 2 } });
  vtkNew<vtkDoubleArray> time;
  time->SetName("Time");
  time->InsertNextValue(0.25);
  time->InsertNextValue(0.5);
  path->GetPointData()->AddArray(time);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(path);
  trace->SetSurfaceData(Plane());
  trace->Update();
  EXPECT_EQ(Value(trace->GetOutput(), "Time", 1), 0.5);
}

TEST(GodObjectTrace, GivesTheSameBitsTwice)
{
  std::vector<Point> positions;
  AddLine(positions, { 1.2, 0.1, 0.3 }, { -0.3, -0.2, 0.1 }, 400);
  AddLine(positions, { -0.3, -0.2, 0.1 }, { 0.2, 1.1, 0.0 }, 400);
  vtkNew<vtkSphereSource> sphere;
  std::array<vtkNew<vtkGodObjectTrace>, 2> traces;
  for (auto& trace : traces)
  {
    trace->SetInputData(Path(positions));
    trace->SetSurfaceConnection(sphere->GetOutputPort());
    trace->Update();
  }
  bool touched = false;
  for (vtkIdType i = 0; i < traces[0]->GetOutput()->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(Tuple(traces[0]->GetOutput(), "Force", i), Tuple(traces[1]->GetOutput(), "Force", i));
    touched = touched || Value(traces[0]->GetOutput(), "ActiveConstraints", i) > 0;
  }
  EXPECT_TRUE(touched);
}

TEST(GodObjectTrace, UsesTheSurfaceOfAGodObjectFilterAsItIs)
{
  // From below, so that only Both holds.
  std::vector<Point> positions;
  AddLine(positions, { 0.5, 0, -0.1 }, { 0.5, 0, 0.1 }, 20);
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(Plane());
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path(positions));
  trace->SetSurfaceConnection(filter->GetOutputPort());
  filter->SetSideToFront();
  trace->Update();
  EXPECT_EQ(Value(trace->GetOutput(), "ActiveConstraints", 20), 0);
  filter->SetSideToBoth();
  trace->Update();
  EXPECT_EQ(Value(trace->GetOutput(), "ActiveConstraints", 20), 1);
  EXPECT_LT(Tuple(trace->GetOutput(), "Force", 20)[2], 0.0);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
}

TEST(GodObjectTrace, FollowsEachBlockOfAGodObjectFilterByItself)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const double x : { 0.0, 1.0 })
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetRadius(0.2);
    ball->SetCenter(x, 0.0, 0.0);
    ball->SetThetaResolution(x == 0.0 ? 8 : 40); // other numbers of triangles
    ball->Update();
    blocks->SetBlock(x == 0.0 ? 0 : 1, ball->GetOutput());
  }
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputDataObject(blocks);
  std::vector<Point> positions;
  AddLine(positions, { 0.0, 0.0, 0.3 }, { 0.0, 0.0, 0.1 }, 10); // into the first
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path(positions));
  trace->SetSurfaceConnection(filter->GetOutputPort());
  trace->Update();
  auto* traces = vtkMultiBlockDataSet::SafeDownCast(trace->GetOutputDataObject(0));
  ASSERT_NE(traces, nullptr);
  vtkPolyData* first = vtkPolyData::SafeDownCast(traces->GetBlock(0));
  vtkPolyData* second = vtkPolyData::SafeDownCast(traces->GetBlock(1));
  ASSERT_NE(first, nullptr);
  ASSERT_NE(second, nullptr);
  EXPECT_GE(Value(first, "ActiveConstraints", 10), 1.0);
  EXPECT_EQ(Value(second, "ActiveConstraints", 10), 0.0);
  const double cells = vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetNumberOfCells();
  EXPECT_LT(Value(first, "OriginalCellId", 10), cells);
  EXPECT_GE(Value(first, "OriginalCellId", 10), 0.0);
}

TEST(GodObjectTrace, NamesTheCellsOfItsOwnInput)
{
  // Through a filter whose output was copied, hence prepared anew: ids are those of port 1.
  Parts cube = Cube();
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path({ { 0.4, 0.3, 1.5 }, { 0.4, 0.3, 0.9 } }));
  trace->SetSurfaceData(MakePolyData(cube));
  trace->Update();
  EXPECT_EQ(Value(trace->GetOutput(), "OriginalCellId", 1), 1) << "the top";
}

TEST(GodObjectTrace, ASinglePointBecomesAVertex)
{
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path({ { 0, 0, 1 } }));
  trace->SetSurfaceData(Plane());
  trace->Update();
  EXPECT_EQ(trace->GetOutput()->GetNumberOfVerts(), 1);
}

namespace
{
void ExpectRefused(vtkPolyData* path, vtkPolyData* surface, const std::string& word)
{
  vtkNew<vtkGodObjectTrace> trace;
  MessageCatcher messages(trace);
  if (path)
  {
    trace->SetInputData(path);
  }
  if (surface)
  {
    trace->SetSurfaceData(surface);
  }
  trace->Update();
  EXPECT_NE(messages.Errors().find(word), std::string::npos) << messages.Errors();
  EXPECT_EQ(trace->GetOutput()->GetNumberOfPoints(), 0);
}
}

TEST(GodObjectTrace, RefusesASettingThatIsNoNumber)
{
  vtkNew<vtkGodObjectTrace> trace;
  MessageCatcher messages(trace);
  trace->SetStiffness(200.0);
  trace->SetStiffness(std::nan(""));
  EXPECT_EQ(trace->GetStiffness(), 200.0);
  EXPECT_NE(messages.Errors().find("Stiffness has to be a number"), std::string::npos);
  trace->SetStiffness(-1.0);
  EXPECT_EQ(trace->GetStiffness(), 0.0);

  vtkNew<vtkGodObjectFilter> filter;
  MessageCatcher filterMessages(filter);
  filter->SetMergeTolerance(std::nan(""));
  EXPECT_EQ(filter->GetMergeTolerance(), 0.0);
  EXPECT_NE(filterMessages.Errors().find("MergeTolerance"), std::string::npos);
}

TEST(GodObjectTrace, RefusesAMissingOrEmptyPath)
{
  ExpectRefused(nullptr, Plane(), "no path");
  ExpectRefused(Path({}), Plane(), "no path");
}

TEST(GodObjectTrace, RefusesAPathThatIsNotFinite)
{
  ExpectRefused(Path({ { 0, 0, 1 }, { 0, std::nan(""), 0 } }), Plane(), "Point 1 of the path");
}

TEST(GodObjectTrace, RefusesAMissingSurface)
{
  ExpectRefused(Path({ { 0, 0, 1 } }), nullptr, "no surface");
}

TEST(GodObjectTrace, RefusesASurfaceThatCannotBeTouched)
{
  const auto noSurface = Path({ { 0, 0, 0 } });
  ExpectRefused(Path({ { 0, 0, 1 } }), noSurface, "surface at port 1 cannot be touched");
  ExpectRefused(Path({ { 0, 0, 1 } }), noSurface, "no polygon");
}

/// Nothing is there: the whole path is in free space, whichever filter has said so.
TEST(GodObjectTrace, AnEmptySurfaceIsFreeSpace)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(empty);
  for (const bool isPrepared : { false, true })
  {
    vtkNew<vtkGodObjectTrace> trace;
    MessageCatcher messages(trace);
    trace->SetInputData(Path({ { 0, 0, 1 }, { 0, 0, -1 }, { 2, 0, 0 } }));
    trace->AddSurfaceArray("Heat");
    isPrepared ? trace->SetSurfaceConnection(filter->GetOutputPort())
               : trace->SetSurfaceData(empty);
    trace->Update();
    vtkPolyData* const output = trace->GetOutput();
    ASSERT_EQ(output->GetNumberOfPoints(), 3);
    for (vtkIdType tick = 0; tick < 3; ++tick)
    {
      EXPECT_EQ(Tuple(output, "Force", tick), (Point{ 0, 0, 0 }));
      EXPECT_EQ(Value(output, "Surface", tick), -1.0);
      EXPECT_EQ(Value(output, "Penetration", tick), 0.0);
      Point p;
      output->GetPoint(tick, p.data());
      EXPECT_EQ(p, Tuple(output, "HapticInterfacePoint", tick));
    }
    EXPECT_EQ(messages.Errors() + messages.Warnings(), "");

    trace->SetSurfaceData(Plane()); // and back
    trace->ClearSurfaceArrays();
    trace->Update();
    EXPECT_GT(Value(trace->GetOutput(), "Penetration", 1), 0.9);
    EXPECT_EQ(messages.Errors(), "");
  }
}

/// What a filter before it has refused is no empty surface.
TEST(GodObjectTrace, RefusesWhatThePreparationBeforeItRefuses)
{
  vtkNew<vtkGodObjectFilter> filter;
  MessageCatcher first(filter);
  filter->SetInputData(Path({ { 0, 0, 0 } }));
  vtkNew<vtkGodObjectTrace> trace;
  MessageCatcher messages(trace);
  trace->SetInputData(Path({ { 0, 0, 1 }, { 0, 0, -1 } }));
  trace->SetSurfaceConnection(filter->GetOutputPort());
  trace->Update();
  EXPECT_NE(first.Errors().find("no polygon"), std::string::npos) << first.Errors();
  EXPECT_NE(messages.Errors().find("before it has made none"), std::string::npos)
    << messages.Errors();
  EXPECT_EQ(trace->GetOutput()->GetNumberOfPoints(), 0);

  filter->SetInputData(Plane()); // the remedy
  trace->Update();
  EXPECT_EQ(trace->GetOutput()->GetNumberOfPoints(), 2);
}

TEST(GodObjectTrace, HasTheArraysOfWhatIsTouched)
{
  auto plane = Plane();
  vtkNew<vtkDoubleArray> heat; // 1 + x + 2 y, which is linear: interpolated exactly
  heat->SetName("Heat");
  vtkNew<vtkIntArray> part;
  part->SetName("Part");
  vtkNew<vtkDoubleArray> force; // a name that the trace has itself
  force->SetName("Force");
  for (vtkIdType i = 0; i < 4; ++i)
  {
    double p[3];
    plane->GetPoint(i, p);
    heat->InsertNextValue(1.0 + p[0] + 2.0 * p[1]);
    force->InsertNextValue(7.0);
  }
  part->InsertNextValue(10);
  part->InsertNextValue(20);
  plane->GetPointData()->AddArray(heat);
  plane->GetPointData()->AddArray(force);
  plane->GetCellData()->AddArray(part);
  std::vector<Point> positions{ { 0.5, -0.5, 0.1 } };
  AddLine(positions, { 0.5, -0.5, -0.002 }, { -0.3, 0.7, -0.002 }, 50);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path(positions));
  trace->SetSurfaceData(plane);
  trace->Update();
  vtkPolyData* output = trace->GetOutput();
  EXPECT_TRUE(std::isnan(Value(output, "Heat", 0))) << "in free space";
  EXPECT_EQ(Value(output, "Part", 0), 0);
  EXPECT_EQ(Tuple(output, "BarycentricWeights", 0), (Point{ 0, 0, 0 }));
  EXPECT_EQ(Tuple(output, "Normal", 0), (Point{ 0, 0, 0 }));
  for (vtkIdType i = 1; i < output->GetNumberOfPoints(); ++i)
  {
    Point god;
    output->GetPoint(i, god.data());
    EXPECT_NEAR(Value(output, "Heat", i), 1.0 + god[0] + 2.0 * god[1], 1e-6) << i;
    EXPECT_EQ(Value(output, "Part", i), 10 + 10 * Value(output, "OriginalCellId", i)) << i;
    EXPECT_NEAR(Value(output, "SurfaceForce", i), 7.0, 1e-12);
    EXPECT_EQ(Tuple(output, "Normal", i), (Point{ 0, 0, 1 }));
    const Point weights = Tuple(output, "BarycentricWeights", i);
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1.0, 1e-12);
  }
  vtkPointData* data = output->GetPointData();
  EXPECT_EQ(data->GetArray("Force")->GetNumberOfComponents(), 3);
  const auto unit = [data](const char* name)
  {
    const char* text = data->GetArray(name)->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    return std::string(text ? text : "");
  };
  EXPECT_EQ(unit("Force"), "N");
  EXPECT_EQ(unit("Stiffness"), "N/m");
  EXPECT_EQ(unit("Energy"), "J");
  EXPECT_EQ(unit("Time"), "s");

  trace->AddSurfaceArray("Part");
  trace->Update();
  EXPECT_FALSE(trace->GetOutput()->GetPointData()->HasArray("Heat"));
  EXPECT_TRUE(trace->GetOutput()->GetPointData()->HasArray("Part"));
  trace->AddSurfaceArray("Pressure");
  MessageCatcher messages(trace);
  trace->Update();
  EXPECT_NE(messages.Warnings().find("Pressure"), std::string::npos) << messages.Warnings();
  trace->PassSurfaceArraysOff();
  trace->Update();
  EXPECT_FALSE(trace->GetOutput()->GetPointData()->HasArray("Part"));
}
