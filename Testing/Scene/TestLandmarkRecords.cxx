// Landmarks as they are kept in files: taken out of a scene and into another one, and of no use.
#include "SceneTestTools.h"

#include "haptics/Scene/FieldValues.h"
#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticProbe.h"
#include "vtkHapticSurfaces.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{
constexpr double Tolerance = 1e-9; // of places at 0.1 that were read as doubles

/// A scene with a table of this name that can be moved.
struct NamedTable : LedHand
{
  vtkNew<vtkActor> Actor;
  int Surface = -1;

  explicit NamedTable(const char* name, vtkPolyData* table = MakeTable(0.0))
  {
    vtkNew<vtkDoubleArray> heat;
    heat->SetName("Heat");
    heat->SetNumberOfValues(table->GetNumberOfPoints());
    heat->Fill(37.0);
    table->GetPointData()->AddArray(heat);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(table);
    this->Actor->SetMapper(mapper);
    this->Surface = this->Scene->AddSurface(this->Actor);
    this->Scene->GetSurfaces()->SetName(this->Surface, name);
    this->MoveTo(0.01);
  }
  vtkHapticLandmarks* Marks() { return this->Scene->GetLandmarks(); }
  void Drop()
  {
    this->MoveTo(-0.001);
    ASSERT_GE(this->Scene->DropLandmark(), 0) << this->Scene->GetErrorMessage();
    this->MoveTo(0.01);
  }
  double Height(int number)
  {
    double position[3];
    this->Marks()->GetPosition(number, position);
    return position[2];
  }
};

/// What a scene has, in another one.
void Take(vtkHapticLandmarks* from, vtkHapticLandmarks* to)
{
  vtkNew<vtkPolyData> record;
  for (int i = 0; i < from->GetNumberOfLandmarks(); ++i)
  {
    from->GetRecord(i, record);
    ASSERT_EQ(to->Add(record), i);
  }
}
}

TEST(LandmarkRecords, KeepLabelPlaceValuesAndTheNextNumber)
{
  NamedTable first("Bone");
  first.Drop();
  first.Drop();
  first.Marks()->SetLabel(0, "apex");
  NamedTable second("Bone");
  Take(first.Marks(), second.Marks());

  EXPECT_EQ(second.Marks()->GetLabel(0), "apex");
  EXPECT_EQ(second.Marks()->GetLabel(1), "2");
  vtkHapticProbe* const before = first.Marks()->GetLandmark(1);
  vtkHapticProbe* const after = second.Marks()->GetLandmark(1);
  EXPECT_EQ(after->GetSurfaceName(), "Bone");
  EXPECT_EQ(after->GetCell(), before->GetCell());
  EXPECT_EQ(after->GetValue("Heat"), 37.0);
  EXPECT_EQ(after->GetForce()[2], before->GetForce()[2]);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(after->GetPosition()[i], before->GetPosition()[i]);
    EXPECT_EQ(after->GetPointId(i), before->GetPointId(i));
  }
  second.Drop();
  EXPECT_EQ(second.Marks()->GetLabel(2), "3");
}

TEST(LandmarkRecords, FindTheirSurfaceByItsNameAndGoWithIt)
{
  NamedTable first("Bone");
  first.Drop();
  first.Drop();
  NamedTable second("Bone");
  Take(first.Marks(), second.Marks());
  EXPECT_EQ(second.Marks()->GetLandmark(0)->GetSurface(), -1);
  second.MoveTo(0.01);
  EXPECT_EQ(second.Marks()->GetLandmark(0)->GetSurface(), second.Surface);
  EXPECT_NEAR(second.Height(0), 0.0, Tolerance);
  EXPECT_NEAR(second.Marks()->GetGeodesicDistance(0, 1), 0.0, Tolerance);
  second.Actor->SetPosition(0.0, 0.0, -0.02);
  second.MoveTo(0.01);
  EXPECT_NEAR(second.Height(0), -0.02, Tolerance);
}

TEST(LandmarkRecords, FindARenamedSurfaceByTheirPlaceWhereThereIsOnlyOne)
{
  NamedTable first("Bone");
  first.Drop();
  NamedTable second("Skull");
  Take(first.Marks(), second.Marks());
  EXPECT_EQ(second.Marks()->GetNumberOfFreeLandmarks(), 1);
  second.MoveTo(0.01);
  EXPECT_EQ(second.Marks()->GetNumberOfFreeLandmarks(), 0);
  EXPECT_EQ(second.Marks()->GetLandmark(0)->GetSurface(), second.Surface);
  second.Actor->SetPosition(0.0, 0.0, -0.02);
  second.MoveTo(0.01);
  EXPECT_NEAR(second.Height(0), -0.02, Tolerance);
  vtkNew<vtkPolyData> record;
  second.Marks()->GetRecord(0, record);
  std::string name;
  ASSERT_TRUE(haptics::FieldValues(record->GetFieldData()).Get("SurfaceName", name));
  EXPECT_EQ(name, "Skull");

  // Which of two it is, nobody knows; nor is it another one while one has the name.
  for (const char* another : { "Copy", "Bone" })
  {
    NamedTable scene("Skull");
    vtkNew<vtkPlaneSource> fine;
    fine->SetResolution(5, 5);
    fine->Update();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(another == std::string("Bone")
        ? fine->GetOutput()
        : vtkPolyData::SafeDownCast(scene.Actor->GetMapper()->GetInput()));
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    scene.Scene->GetSurfaces()->SetName(scene.Scene->AddSurface(actor), another);
    Take(first.Marks(), scene.Marks());
    scene.MoveTo(0.01);
    EXPECT_EQ(scene.Marks()->GetNumberOfFreeLandmarks(), 1) << another;
    EXPECT_NEAR(scene.Height(0), 0.0, Tolerance);
  }
}

TEST(LandmarkRecords, StayWhereTheyWereOnAnotherSurface)
{
  NamedTable first("Bone");
  first.Drop();
  first.Actor->SetPosition(0.0, 0.0, -0.02); // where it is taken from
  first.MoveTo(0.01);
  vtkNew<vtkPlaneSource> fine;
  fine->SetResolution(5, 5);
  fine->Update();
  NamedTable other("Skin");
  NamedTable finer("Bone", fine->GetOutput());
  for (NamedTable* scene : { &other, &finer })
  {
    Take(first.Marks(), scene->Marks());
    scene->Actor->SetPosition(0.0, 0.0, -0.03);
    scene->MoveTo(0.01);
    EXPECT_EQ(scene->Marks()->GetLandmark(0)->GetSurface(), -1);
    EXPECT_NEAR(scene->Height(0), -0.02, Tolerance);
  }
  vtkNew<vtkPolyData> record;
  first.Marks()->GetRecord(0, record);
  EXPECT_EQ(other.Marks()->Add(record), 1);
  other.Marks()->SetDistance(vtkHapticLandmarks::ALONG_SURFACE);
  EXPECT_TRUE(std::isnan(other.Marks()->GetDistanceToPrevious(1))); // there is no way along nothing
}
