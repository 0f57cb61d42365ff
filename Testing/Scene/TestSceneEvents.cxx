#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticProbe.h"
#include "vtkHapticReadings.h"
#include "vtkHapticSurfaces.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
/// Writes down every event of a scene, in order.
class Diary
{
public:
  explicit Diary(vtkHapticScene* scene)
    : Scene(scene)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long event, void* self, void* data)
      { static_cast<Diary*>(self)->Note(event, data); });
    for (unsigned long event = vtkHapticScene::ContactBeginEvent;
         event <= vtkHapticScene::LandmarkEvent; ++event)
    {
      scene->AddObserver(event, this->Command);
    }
    scene->AddObserver(vtkHapticScene::SqueezeEvent, this->Command);
  }
  ~Diary() { this->Scene->RemoveObserver(this->Command); }

  std::string Events;
  std::vector<vtkSmartPointer<vtkHapticProbe>> Probes;

private:
  void Note(unsigned long event, void* data)
  {
    switch (event)
    {
      case vtkHapticScene::ContactBeginEvent:
      case vtkHapticScene::ContactEndEvent:
      case vtkHapticScene::ContactSlideEvent:
        this->Probes.push_back(static_cast<vtkHapticProbe*>(data));
        this->Events += event == vtkHapticScene::ContactBeginEvent ? " begin"
          : event == vtkHapticScene::ContactEndEvent               ? " end"
                                                                   : " slide";
        break;
      case vtkHapticScene::SqueezeEvent:
        this->Probes.push_back(static_cast<vtkHapticProbe*>(data));
        this->Events += " squeeze";
        break;
      case vtkHapticScene::ButtonPressEvent:
        this->Events += " press" + std::to_string(*static_cast<int*>(data));
        break;
      case vtkHapticScene::ButtonReleaseEvent:
        this->Events += " release" + std::to_string(*static_cast<int*>(data));
        break;
      case vtkHapticScene::DeviceStateEvent:
        this->Events += " device" + std::to_string(*static_cast<int*>(data));
        break;
      case vtkHapticScene::LandmarkEvent:
        this->Events += " landmark" + std::to_string(*static_cast<int*>(data));
        break;
      default:
        this->Events += data ? " data!" : " other";
    }
  }

  vtkHapticScene* Scene;
  vtkNew<vtkCallbackCommand> Command;
};

/// The table with a value at each corner that rises with x, and one of its cell.
vtkSmartPointer<vtkPolyData> MakeValuedTable()
{
  vtkSmartPointer<vtkPolyData> table = MakeTable(0.0);
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("Heat");
  for (vtkIdType i = 0; i < table->GetNumberOfPoints(); ++i)
  {
    heat->InsertNextValue(10.0 * table->GetPoint(i)[0]);
  }
  table->GetPointData()->AddArray(heat);
  vtkNew<vtkStringArray> name;
  name->SetName("Part");
  name->InsertNextValue("lid, upper");
  table->GetCellData()->AddArray(name);
  return table;
}
}

TEST(SceneEvents, ComeInTheOrderOfTheTicksWithWhatWasTouchedThen)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  Diary diary(hand.Scene);
  hand.MoveTo(0.01);
  EXPECT_EQ(diary.Events, " device2") << "it was opened: Ready";
  diary.Events.clear();
  hand.Device->SetButtons(4);
  hand.MoveTo(-0.001);
  EXPECT_EQ(diary.Events, " press2 begin");
  ASSERT_EQ(diary.Probes.size(), 1U);
  EXPECT_TRUE(diary.Probes[0]->GetTouching());
  EXPECT_EQ(diary.Probes[0]->GetHapticInterfacePoint()[2], -0.001);
  hand.MoveTo(-0.002); // straight down: the god-object stays
  hand.Device->SetPosition(0.03, 0.02, -0.002);
  hand.Scene->Step(1);
  hand.Device->SetButtons(0);
  hand.MoveTo(0.01);
  EXPECT_EQ(diary.Events, " press2 begin slide release2 end");
  EXPECT_EQ(diary.Probes[0]->GetHapticInterfacePoint()[2], -0.001) << "a probe can be kept";
  EXPECT_FALSE(diary.Probes.back()->GetTouching());
}

TEST(SceneEvents, AContactBetweenTwoUpdatesIsNotLost)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  vtkNew<vtkPolyData> path;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.01, 0.02, 0.01);
  points->InsertNextPoint(0.01, 0.02, -0.001);
  points->InsertNextPoint(0.01, 0.02, 0.01);
  path->SetPoints(points);
  hand.Device->SetPath(path);
  hand.Device->SetSpeed(1.0);
  hand.Device->SetMotionToPolyline();
  Diary diary(hand.Scene);
  hand.Scene->Step(100);
  EXPECT_EQ(diary.Events, " device2 begin end");
}

TEST(SceneEvents, ObserversMayUpdateReleaseAndRemoveAndNobodyIsCalledTwice)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  vtkNew<vtkCallbackCommand> meddler;
  meddler->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* scene = static_cast<vtkHapticScene*>(caller);
      scene->RemoveAllSurfaces();
      scene->Step(1);
    });
  hand.Scene->AddObserver(vtkHapticScene::ContactBeginEvent, meddler);
  Diary diary(hand.Scene);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  EXPECT_FALSE(hand.Scene->GetTouching()) << "the observer has taken the table away";
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0) << "no stale force";
  EXPECT_EQ(diary.Events, " device2 begin end");
}

TEST(HapticProbe, HasIdsWeightsAndValuesInTheCellAsItWasGiven)
{
  LedHand hand;
  const int id = hand.Scene->AddSurface(MakeValuedTable());
  hand.MoveTo(0.01);
  EXPECT_FALSE(hand.Scene->GetProbe()->GetTouching());
  EXPECT_EQ(hand.Scene->GetProbe()->GetText(), "");
  hand.MoveTo(-0.005);
  vtkHapticProbe* probe = hand.Scene->GetProbe();
  ASSERT_TRUE(probe->GetTouching());
  EXPECT_EQ(probe->GetSurface(), id);
  EXPECT_EQ(probe->GetCell(), 0);
  EXPECT_NEAR(probe->GetValue("Heat"), 10.0 * 0.01, 1e-9);
  EXPECT_EQ(
    probe->GetCellValues()->GetAbstractArray("Part")->GetVariantValue(0).ToString(), "lid, upper");
  EXPECT_TRUE(std::isnan(probe->GetValue("Nothing")));
  // The weights put the corners' own places together to the position, exactly on the table.
  vtkSmartPointer<vtkPolyData> table = MakeTable(0.0);
  double place[3] = { 0.0, 0.0, 0.0 };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_GE(probe->GetWeight(i), 0.0);
    for (int j = 0; j < 3; ++j)
    {
      place[j] += probe->GetWeight(i) * table->GetPoint(probe->GetPointId(i))[j];
    }
  }
  EXPECT_NEAR(place[0], 0.01, 1e-9);
  EXPECT_NEAR(place[1], 0.02, 1e-9);
  EXPECT_EQ(probe->GetPosition()[2], 0.0) << "on the table, not at the god-object's clearance";
  EXPECT_NE(probe->GetText().find("Heat"), std::string::npos);
  EXPECT_NE(probe->GetText().find("lid, upper"), std::string::npos);
}

TEST(HapticProbe, FollowsAMirroredActorAndNewColours)
{
  LedHand hand;
  vtkSmartPointer<vtkPolyData> table = MakeValuedTable();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(table);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(-1.0, 1.0, 1.0);
  hand.Scene->AddSurface(actor);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.005);
  EXPECT_NEAR(hand.Scene->GetProbe()->GetValue("Heat"), -0.1, 1e-9);
  vtkNew<vtkDoubleArray> cold;
  cold->SetName("Cold");
  cold->SetNumberOfTuples(table->GetNumberOfPoints());
  cold->Fill(-3.0);
  table->GetPointData()->AddArray(cold);
  hand.MoveTo(-0.004);
  hand.MoveTo(-0.005);
  EXPECT_NEAR(hand.Scene->GetProbe()->GetValue("Cold"), -3.0, 1e-12);
}

TEST(SceneEvents, AButtonDropsALandmarkThoughTheSurfacesChangeBeforeTheSceneLooks)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.Device->SetPosition(0.01, 0.02, -0.002);
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.01, 0.02, 0.002);
  ASSERT_TRUE(hand.EngagePatiently()) << hand.Scene->GetErrorMessage();
  hand.AwaitTicks();
  hand.Device->SetPosition(0.01, 0.02, -0.002);
  hand.AwaitTicks();
  hand.Scene->Update();
  ASSERT_TRUE(hand.Scene->GetTouching());
  hand.Device->SetButtons(1);
  hand.AwaitTicks();
  hand.Scene->SetClutched(true); // nothing is touched from now on
  hand.AwaitTicks();
  hand.Scene->Update();
  EXPECT_EQ(hand.Scene->GetLandmarks()->GetNumberOfLandmarks(), 1);
}

/// The read-out of places on a surface far from the origin, and near it.
TEST(HapticProbe, CoordinatesHaveTheDigitsThatDistinguishPlacesOnTheSurface)
{
  for (const double far : { 0.0, 5094171.25 })
  {
    LedHand hand;
    auto table = MakeTable(0.0);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (vtkIdType i = 0; i < 4; ++i)
    {
      double p[3];
      table->GetPoint(i, p);
      points->InsertNextPoint(p[0] + far, p[1], p[2]);
    }
    table->SetPoints(points);
    hand.Scene->AddSurface(table);
    vtkNew<vtkMatrix4x4> workspace;
    workspace->SetElement(0, 3, far);
    hand.Scene->SetWorkspaceTransform(workspace);
    std::set<std::string> places;
    for (int i = 0; i < 10; ++i)
    {
      const double x = -0.005 + 0.001 * i; // a two-hundredth of the table
      hand.Device->SetPosition(x, 0.02, 0.01);
      hand.Scene->Step(1);
      hand.Device->SetPosition(x, 0.02, -0.001);
      hand.Scene->Step(1);
      const std::string text = hand.Scene->GetProbe()->GetText();
      const std::string place = text.substr(text.find('\n') + 1);
      places.insert(place);
      EXPECT_NEAR(std::stod(place) - far, x, 1e-4) << text;
    }
    EXPECT_EQ(places.size(), 10U) << *places.begin();
  }
}

TEST(HapticProbe, WritesZeroForWhatRoundingHasLeftOfItAndAsManyDecimalsEverywhere)
{
  LedHand hand;
  vtkSmartPointer<vtkPolyData> table = MakeTable(6.9388939039072284e-18);
  vtkNew<vtkDoubleArray> across; // zero in the middle, but for rounding
  across->SetName("Across");
  for (vtkIdType i = 0; i < table->GetNumberOfPoints(); ++i)
  {
    across->InsertNextValue(0.1 * (table->GetPoint(i)[0] + table->GetPoint(i)[1]));
  }
  table->GetPointData()->AddArray(across);
  hand.Scene->AddSurface(table);
  hand.MoveTo(0.01);
  std::set<std::size_t> lengths;
  for (int i = 0; i < 20; ++i)
  {
    const double x = 0.001 * i;
    hand.Device->SetPosition(x, -x, 0.01);
    hand.Scene->Step(1);
    hand.Device->SetPosition(x, -x, -0.001);
    hand.Scene->Step(1);
    const std::string text = hand.Scene->GetProbe()->GetText();
    ASSERT_NE(text, "") << x;
    EXPECT_EQ(text.find("e-"), std::string::npos) << text;
    EXPECT_EQ(text.find("-0.00000"), std::string::npos) << text;
    EXPECT_EQ(hand.Scene->GetProbe()->GetValue("Across"), 0.0) << text;
    const std::size_t begin = text.find('\n') + 1;
    const std::string place = text.substr(begin, text.find('\n', begin) - begin);
    lengths.insert(place.size() - (x > 0.0 ? 1 : 0)); // without the sign
  }
  EXPECT_EQ(lengths.size(), 1U);
}

TEST(HapticLandmarks, DropListUndoAndExport)
{
  LedHand hand;
  vtkSmartPointer<vtkPolyData> table = MakeValuedTable();
  vtkNew<vtkDoubleArray> northing; // more than six digits count
  northing->SetName("Northing");
  northing->SetNumberOfValues(table->GetNumberOfPoints());
  northing->FillValue(4812345.681);
  table->GetPointData()->AddArray(northing);
  hand.Scene->AddSurface(table);
  hand.MoveTo(0.01);
  vtkHapticLandmarks* marks = hand.Scene->GetLandmarks();
  {
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    EXPECT_EQ(hand.Scene->DropLandmark(), -1) << "in free space";
    EXPECT_EQ(errors.Count, 1);
  }
  hand.MoveTo(-0.005);
  EXPECT_EQ(hand.Scene->DropLandmark(), 0);
  hand.Device->SetPosition(0.04, -0.02, -0.005);
  hand.Scene->Step(1);
  hand.Device->SetButtons(1); // the landmark button
  hand.Scene->Step(1);
  hand.Device->SetButtons(0);
  hand.Scene->Step(1);
  ASSERT_EQ(marks->GetNumberOfLandmarks(), 2);
  EXPECT_EQ(marks->GetLabel(1), "2");
  EXPECT_NEAR(marks->GetStraightDistance(0, 1), std::hypot(0.03, 0.04), 1e-9);
  EXPECT_NEAR(marks->GetGeodesicDistance(0, 1), std::hypot(0.03, 0.04), 1e-9) << "it is flat";

  vtkPolyData* output = marks->GetOutput();
  EXPECT_EQ(output->GetNumberOfVerts(), 2);
  EXPECT_NEAR(output->GetPoint(1)[0], 0.04, 1e-9);
  EXPECT_NE(output->GetPointData()->GetAbstractArray("Label"), nullptr);
  ASSERT_TRUE(marks->WriteCSV("landmarks.csv"));
  std::ifstream file("landmarks.csv");
  std::stringstream text;
  text << file.rdbuf();
  file.close();
  std::remove("landmarks.csv");
  EXPECT_EQ(text.str().find("label,x,y,z,surface,cell"), 0U);
  EXPECT_NE(text.str().find(",Heat,Northing,Part\r\n"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("\"lid, upper\""), std::string::npos) << text.str();
  EXPECT_NE(text.str().find(",4812345.6"), std::string::npos) << text.str();

  EXPECT_TRUE(marks->Undo());
  EXPECT_EQ(marks->GetNumberOfLandmarks(), 1);
  EXPECT_EQ(marks->GetOutput()->GetNumberOfVerts(), 1);
  EXPECT_TRUE(marks->Undo());
  EXPECT_FALSE(marks->Undo());
  EventCounter errors(marks, vtkCommand::ErrorEvent);
  EXPECT_TRUE(std::isnan(marks->GetStraightDistance(0, 1)));
  EXPECT_FALSE(marks->WriteCSV("no/such/folder/landmarks.csv"));
  EXPECT_EQ(errors.Count, 2);
}

TEST(SceneEvents, ATableOfLandmarksHoldsNoFormulas)
{
  LedHand hand;
  const auto table = MakeTable(0.0);
  vtkNew<vtkDoubleArray> values;
  values->SetName("=HYPERLINK(A1)");
  values->SetNumberOfValues(table->GetNumberOfPoints());
  values->FillValue(-1.5);
  table->GetPointData()->AddArray(values);
  vtkNew<vtkStringArray> parts;
  parts->SetName("+part");
  parts->InsertNextValue("-1+1");
  table->GetCellData()->AddArray(parts);
  hand.Scene->AddSurface(table);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.005);
  vtkHapticLandmarks* marks = hand.Scene->GetLandmarks();
  ASSERT_EQ(hand.Scene->DropLandmark(), 0);
  marks->SetLabel(0, "@SUM(1)");
  ASSERT_TRUE(marks->WriteCSV("formulas.csv"));
  std::ifstream file("formulas.csv");
  std::stringstream text;
  text << file.rdbuf();
  std::remove("formulas.csv");
  EXPECT_NE(text.str().find(",'=HYPERLINK(A1),'+part\r\n'@SUM(1),"), std::string::npos)
    << text.str();
  EXPECT_NE(text.str().find(",-1.5,'-1+1\r\n"), std::string::npos)
    << "numbers stay: " << text.str();
}

TEST(HapticLandmarks, TheWayAlongASphereIsTheGreatCircle)
{
  LedHand hand;
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(64);
  hand.Scene->AddSurface(sphere->GetOutputPort());
  const auto drop = [&](double longitude, double latitude)
  {
    const double place[3] = { std::cos(latitude) * std::cos(longitude),
      std::cos(latitude) * std::sin(longitude), std::sin(latitude) };
    for (const double height : { 1.5, 0.999 })
    {
      hand.Device->SetPosition(height * place[0], height * place[1], height * place[2]);
      hand.Scene->Step(1);
    }
    return hand.Scene->DropLandmark();
  };
  // Each time from far out: a hand that goes through the ball would stay on its near side.
  const int first = drop(0.2, -0.3);
  hand.Device->SetPosition(0.0, 0.0, 3.0);
  hand.Scene->Step(1);

  const int second = drop(1.7, 0.9);
  ASSERT_EQ(second, first + 1);
  double a[3];
  double b[3];
  hand.Scene->GetLandmarks()->GetPosition(first, a);
  hand.Scene->GetLandmarks()->GetPosition(second, b);
  const double angle = std::acos((a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) /
    std::sqrt(
      (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2])));
  vtkNew<vtkPolyData> way;
  const double length = hand.Scene->GetLandmarks()->GetGeodesicDistance(first, second, way);
  // The facets lie up to 0.2 % inside the sphere. Along the edges alone it would be 10 % longer.
  EXPECT_NEAR(length, angle, 0.004 * angle);
  EXPECT_GT(way->GetNumberOfPoints(), 20);
  EXPECT_GT(length, hand.Scene->GetLandmarks()->GetStraightDistance(first, second));
}

/// On a sheet that is folded: straight through the air, or along it.
TEST(HapticLandmarks, TheChosenDistanceIsWrittenNextToThem)
{
  LedHand hand;
  auto sheet = MakeTable(0.0);
  hand.Scene->AddSurface(sheet);
  vtkHapticLandmarks* const marks = hand.Scene->GetLandmarks();
  for (const double x : { -0.03, 0.0, 0.05 })
  {
    hand.Device->SetPosition(x, 0.01, 0.01);
    hand.Scene->Step(1);
    hand.Device->SetPosition(x, 0.01, -0.001);
    hand.Scene->Step(1);
    ASSERT_GE(hand.Scene->DropLandmark(), 0);
  }
  EventCounter errors(marks, vtkCommand::ErrorEvent);
  const auto text = [&](int i)
  {
    return vtkStringArray::SafeDownCast(
      marks->GetOutput()->GetPointData()->GetAbstractArray("Text"))
      ->GetValue(i);
  };
  const auto ways = [&]
  { return marks->GetOutput()->GetPointData()->GetArray("DistanceAlongSurface"); };
  EXPECT_EQ(text(0), "1");
  EXPECT_EQ(text(1), "2: 0.03") << "of an unknown unit";
  marks->SetUnitLength(0.001);
  EXPECT_EQ(text(2), "3: 0.05 mm");
  EXPECT_EQ(ways(), nullptr);
  marks->SetDistance(vtkHapticLandmarks::NO_DISTANCE);
  EXPECT_EQ(text(1), "2");
  marks->SetDistance(vtkHapticLandmarks::ALONG_SURFACE);
  ASSERT_NE(ways(), nullptr);
  EXPECT_TRUE(std::isnan(ways()->GetComponent(0, 0)));
  EXPECT_NEAR(ways()->GetComponent(1, 0), 0.03, 1e-9) << "it is flat";

  // Steeper by and by: 3 along, 4 up, 5 along it.
  hand.Device->SetPosition(0.0, 0.0, 1.0);
  const double highest = 4.0 / 3.0;
  for (int step = 1; step <= 4; ++step)
  {
    for (vtkIdType k = 0; k < 4; ++k)
    {
      double q[3];
      sheet->GetPoint(k, q);
      sheet->GetPoints()->SetPoint(k, q[0], q[1], 0.25 * step * highest * q[0]);
    }
    sheet->GetPoints()->Modified();
    sheet->Modified();
    hand.Scene->Step(1);
  }
  hand.Scene->Step(300);
  EXPECT_EQ(text(1), "2: 0.05 mm");
  EXPECT_NEAR(ways()->GetComponent(1, 0), 0.05, 1e-6);
  EXPECT_NEAR(marks->GetDistanceToPrevious(2), 0.05 * 5.0 / 3.0, 1e-6);
  ASSERT_TRUE(marks->Remove(1));
  EXPECT_EQ(text(1), "3: 0.13333 mm") << "the one before is another one now";
  hand.Scene->RemoveAllSurfaces();
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  ASSERT_EQ(hand.Scene->DropLandmark(), 2);
  EXPECT_EQ(text(2), "4") << "there is no way to another surface";
  EXPECT_EQ(errors.Count, 0);
  EXPECT_TRUE(std::isnan(marks->GetDistanceToPrevious(7)));
  EXPECT_EQ(marks->GetText(7), "");
  EXPECT_EQ(errors.Count, 2);
}

TEST(HapticLandmarks, BetweenTwoSurfacesThereIsNoWay)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.MoveTo(-0.005);
  hand.Scene->DropLandmark();
  hand.MoveTo(0.01);
  hand.Scene->RemoveAllSurfaces();
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.02);
  hand.MoveTo(-0.005);
  hand.Scene->DropLandmark();
  EventCounter errors(hand.Scene->GetLandmarks(), vtkCommand::ErrorEvent);
  EXPECT_TRUE(std::isnan(hand.Scene->GetLandmarks()->GetGeodesicDistance(0, 1)));
  EXPECT_EQ(errors.Count, 1);
}

TEST(HapticSceneHand, TheClutchLetsGoAndGoesOnFromThere)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.MoveTo(-0.005);
  ASSERT_TRUE(hand.Scene->GetTouching());
  hand.Device->SetButtons(2); // the clutch button
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.0, 0.0, -0.05); // through the table, and nothing holds
  hand.Scene->Step(1);
  EXPECT_TRUE(hand.Scene->GetClutched());
  EXPECT_FALSE(hand.Scene->GetTouching());
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.0, Clearance) << "the hand in the picture stays";
  hand.Device->SetButtons(0);
  hand.Scene->Step(1);
  EXPECT_FALSE(hand.Scene->GetClutched());
  hand.Scene->Step(1);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.0, Clearance);
  EXPECT_NEAR(hand.Scene->GetForce()[2], 0.0, 1e-9);
  EXPECT_NEAR(hand.Scene->GetGodObject()[0], 0.01, 1e-9);
  hand.Device->SetPosition(0.0, 0.0, -0.06);
  hand.Scene->Step(1);
  EXPECT_TRUE(hand.Scene->GetTouching()) << "from above, as before";
}

TEST(HapticSceneHand, ScalesAboutTheHandAndRefusesAScaleOfZero)
{
  LedHand hand;
  hand.MoveTo(0.01);
  ASSERT_TRUE(hand.Scene->ScaleWorkspace(2.0));
  hand.Scene->Step(1);
  EXPECT_NEAR(hand.Scene->GetHapticInterfacePoint()[2], 0.01, 1e-12);
  hand.MoveTo(0.02);
  EXPECT_NEAR(hand.Scene->GetHapticInterfacePoint()[2], 0.03, 1e-12);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  EXPECT_FALSE(hand.Scene->ScaleWorkspace(0.0));
  EXPECT_FALSE(hand.Scene->ScaleWorkspace(std::nan("")));
  EXPECT_EQ(errors.Count, 2);
}

//  =========  |     a lid comes down on the hand, through the table, and goes up again
//      o      v
//  =========
TEST(SceneEvents, ReportThatSurfacesLeaveTheHandNoPlace)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(0.0));
  vtkNew<vtkActor> lid;
  lid->SetMapper(mapper);
  lid->SetPosition(0.0, 0.0, 0.02);
  hand.Scene->AddSurface(lid);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  ASSERT_GT(hand.Scene->GetForce()[2], 0.0);
  EXPECT_FALSE(hand.Scene->GetServo()->GetReadings()->GetSqueezed());
  Diary diary(hand.Scene);
  lid->SetPosition(0.0, 0.0, -0.003);
  hand.Scene->Step(100);
  EXPECT_EQ(diary.Events, " end squeeze");
  EXPECT_TRUE(hand.Scene->GetServo()->GetReadings()->GetSqueezed());
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);
  ASSERT_EQ(diary.Probes.size(), 2U);
  EXPECT_FALSE(diary.Probes.back()->GetTouching());
  EXPECT_NEAR(diary.Probes.back()->GetHapticInterfacePoint()[2], -0.001, 1e-12);
  diary.Events.clear();
  lid->SetPosition(0.0, 0.0, 0.02);
  hand.Scene->Step(100);
  EXPECT_EQ(diary.Events, " begin");
  EXPECT_FALSE(hand.Scene->GetServo()->GetReadings()->GetSqueezed());
  EXPECT_GT(hand.Scene->GetForce()[2], 0.0) << "on the side of the table where it was";
}

TEST(SceneEvents, ProbesAndMessagesCallASurfaceByItsName)
{
  LedHand hand;
  vtkSmartPointer<vtkPolyData> table = MakeTable(0.0);
  const int id = hand.Scene->AddSurface(table);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  EXPECT_EQ(hand.Scene->GetProbe()->GetSurfaceName(), "surface 0");
  ASSERT_TRUE(hand.Scene->GetSurfaces()->SetName(id, "table"));
  hand.MoveTo(-0.002);
  EXPECT_EQ(hand.Scene->GetSurfaces()->GetName(id), "table");
  EXPECT_EQ(hand.Scene->GetProbe()->GetSurfaceName(), "table");
  EXPECT_EQ(hand.Scene->GetProbe()->GetText().rfind("table   cell 0", 0), 0U)
    << hand.Scene->GetProbe()->GetText();
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  table->SetLines(table->GetPolys());
  table->SetPolys(nullptr);
  hand.Scene->Step(1);
  EXPECT_EQ(std::string(hand.Scene->GetErrorMessage()).rfind("Surface 0 (table): ", 0), 0U)
    << hand.Scene->GetErrorMessage();
  EXPECT_FALSE(hand.Scene->GetSurfaces()->SetName(7, "none"));
  EXPECT_EQ(hand.Scene->GetSurfaces()->GetName(7), "");
}
