// A tip of finite radius, as scene, servo, trace and view have it. Lengths are metres.
#include "GripTestTools.h"
#include "SceneTestTools.h"

#include "vtkDataArray.h"
#include "vtkGodObjectActor.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticProbe.h"
#include "vtkHapticProperties.h"
#include "vtkHapticView.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr double R = 0.003;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

vtkSmartPointer<vtkPolyData> MakeSphere(double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->Update();
  return sphere->GetOutput();
}

/// So many world units a metre of the device.
void SetScale(LedHand& hand, double scale)
{
  vtkNew<vtkMatrix4x4> deviceToWorld;
  for (int i = 0; i < 3; ++i)
  {
    deviceToWorld->SetElement(i, i, scale);
  }
  hand.Scene->SetWorkspaceTransform(deviceToWorld);
}
}

//      O
//  ---------
//      x
TEST(Tip, StaysItsRadiusOverATable)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.Scene->SetTipRadius(R);
  EXPECT_EQ(hand.Scene->GetTipRadius(), R);
  hand.MoveTo(0.05);
  hand.MoveTo(R - 0.001);
  EXPECT_EQ(hand.Scene->GetEffectiveTipRadius(), R);
  EXPECT_NEAR(hand.GodObjectHeight(), R, 1e-9);
  EXPECT_NEAR(hand.Scene->GetPenetration(), 0.001, 1e-9);
  EXPECT_NEAR(hand.Scene->GetForce()[2], 500.0 * 0.001, 1e-3);
  // The probe is on the table, under the ball.
  double place[3];
  hand.Scene->GetProbe()->GetPosition(place);
  EXPECT_NEAR(place[2], 0.0, 1e-6);
  EXPECT_NEAR(place[0], 0.01, 1e-6);
}

TEST(Tip, IsInTheDeviceFrame)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeSphere(0.5));
  SetScale(hand, 20.0);
  vtkNew<vtkHapticView> view;
  view->SetScene(hand.Scene);
  view->GetGodObjectActor();
  hand.Scene->SetTipRadius(R);
  hand.Device->SetPosition(0.0, 0.0, 0.04);
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.0, 0.0, 0.0252);
  hand.Scene->Step(1);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.5 + 20.0 * R, 1e-9);
  EXPECT_NEAR(view->GetGodObjectActor()->GetTipRadius(), 20.0 * R, 1e-12);
}

TEST(Tip, RefusesWhatIsNoRadius)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.Scene->SetTipRadius(R);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  EventCounter servoErrors(hand.Scene->GetServo(), vtkCommand::ErrorEvent);
  vtkNew<vtkGodObjectTrace> trace;
  EventCounter traceErrors(trace, vtkCommand::ErrorEvent);
  vtkNew<vtkGodObjectActor> actor;
  EventCounter actorErrors(actor, vtkCommand::ErrorEvent);
  int wrong = 0;
  for (const double radius : { NaN, -0.001, Infinity, -Infinity })
  {
    ++wrong;
    hand.Scene->SetTipRadius(radius);
    EXPECT_EQ(errors.Count, wrong) << radius;
    EXPECT_NE(
      std::string(hand.Scene->GetErrorMessage()).find("it stays 0.003 m"), std::string::npos);
    EXPECT_EQ(hand.Scene->GetTipRadius(), R);
    trace->SetTipRadius(radius);
    EXPECT_EQ(traceErrors.Count, wrong) << radius;
    actor->SetTipRadius(radius);
    EXPECT_EQ(actorErrors.Count, wrong) << radius;
  }
  hand.Scene->GetServo()->SetTipRadius(NaN);
  EXPECT_EQ(servoErrors.Count, 1);
  hand.Scene->SetTipRadius(0.0);
  EXPECT_EQ(std::string(hand.Scene->GetErrorMessage()), "");
}

TEST(Tip, ThatIsLargerThanTheSurfaceIsAPointUntilItFits)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeSphere(0.005));
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.Scene->SetTipRadius(0.02);
  EXPECT_EQ(errors.Count, 0);
  hand.MoveTo(0.03);
  EXPECT_EQ(errors.Count, 1);
  const std::string message = hand.Scene->GetErrorMessage();
  EXPECT_NE(message.find("larger than"), std::string::npos) << message;
  EXPECT_EQ(hand.Scene->GetTipRadius(), 0.02);
  EXPECT_EQ(hand.Scene->GetEffectiveTipRadius(), 0.0);
  hand.MoveTo(0.031);
  EXPECT_EQ(errors.Count, 1) << "it is said once";
  // As the message advises.
  SetScale(hand, 0.1);
  hand.MoveTo(0.04);
  EXPECT_EQ(hand.Scene->GetEffectiveTipRadius(), 0.02);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(std::string(hand.Scene->GetErrorMessage()), "");
}

TEST(Tip, ThatIsLargerThanTheReachIsAPointUntilItFits)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.Scene->SetTipRadius(10.0);
  hand.MoveTo(0.01);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(std::string(hand.Scene->GetErrorMessage()).find("reach"), std::string::npos);
  EXPECT_EQ(hand.Scene->GetEffectiveTipRadius(), 0.0);
  hand.Scene->SetTipRadius(R);
  hand.MoveTo(0.01);
  EXPECT_EQ(hand.Scene->GetEffectiveTipRadius(), R);
  EXPECT_EQ(errors.Count, 1);
}

// It is blown up: no step of the force is more than a 128th of what it comes to.
TEST(Tip, ThatGrowsInContactPushesSlowly)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  double force = hand.Scene->GetForce()[2];
  ASSERT_GT(force, 0.4);
  hand.Scene->SetTipRadius(R);
  for (int tick = 0; tick < 140; ++tick)
  {
    hand.MoveTo(-0.001);
    const double now = hand.Scene->GetForce()[2];
    EXPECT_GE(now, force - 1e-9) << tick;
    EXPECT_LE(now, force + 500.0 * R / 128.0 + 1e-3) << tick;
    force = now;
  }
  EXPECT_NEAR(hand.GodObjectHeight(), R, 1e-9);
  EXPECT_NEAR(force, 500.0 * (R + 0.001), 1e-3);
  hand.Scene->SetTipRadius(0.0);
  hand.MoveTo(0.01);
  hand.MoveTo(0.0005);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.0005, 1e-9);
}

//     (x)      starts in overlap: free to leave, no deeper, and pushed out slowly
//    -----
TEST(Tip, ThatStartsInOverlapIsPushedOutSlowly)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.Scene->SetTipRadius(R);
  double force = 0.0;
  for (int tick = 0; tick < 140; ++tick)
  {
    hand.MoveTo(0.001);
    const double now = vtkMath::Norm(hand.Scene->GetForce());
    EXPECT_LE(now, force + 500.0 * R / 128.0 + 1e-3) << tick;
    EXPECT_GE(hand.GodObjectHeight(), 0.001);
    force = now;
  }
  EXPECT_NEAR(hand.GodObjectHeight(), R, 1e-9);
  EXPECT_NEAR(force, 500.0 * (R - 0.001), 1e-3);
}

TEST(Tip, IsTheSameInTraceAndServo)
{
  std::vector<std::array<double, 3>> way;
  for (int i = 0; i < 600; ++i)
  {
    const double a = 0.01 * i;
    const double high = i == 0 ? 0.06 : 0.05 + 0.003 * std::cos(0.1 * i);
    way.push_back({ high * std::sin(a), 0.3 * high * std::sin(2.0 * a), high * std::cos(a) });
  }
  const auto sphere = MakeSphere(0.05);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  LedHand hand;
  const int id = hand.Scene->AddSurface(sphere);
  hand.Scene->GetSurfaceProperties(id)->SetStaticFriction(0.3);
  hand.Scene->SetTipRadius(R);
  hand.Device->SetDamping(0.0);
  hand.Scene->StartRecording();
  for (const auto& p : way)
  {
    points->InsertNextPoint(p.data());
    hand.Device->SetPosition(p[0], p[1], p[2]);
    hand.Scene->Step(1);
  }
  vtkNew<vtkPolyData> path;
  path->SetPoints(points);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(path);
  trace->SetSurfaceData(sphere);
  trace->SetWorldToDeviceScale(1.0);
  trace->GetProperties()->SetStaticFriction(0.3);
  trace->SetTipRadius(R);
  trace->Update();
  vtkPolyData* const recorded = hand.Scene->GetTrace();
  ASSERT_EQ(trace->GetOutput()->GetNumberOfPoints(), recorded->GetNumberOfPoints());
  int touching = 0;
  for (vtkIdType i = 0; i < recorded->GetNumberOfPoints(); ++i)
  {
    double a[3];
    double b[3];
    trace->GetOutput()->GetPoint(i, a);
    recorded->GetPoint(i, b);
    ASSERT_EQ(vtkMath::Distance2BetweenPoints(a, b), 0.0) << i;
    touching += recorded->GetPointData()->GetArray("ActiveConstraints")->GetComponent(i, 0) > 0.0;
  }
  EXPECT_GT(touching, 300);
}

TEST(Tip, ThatIsLargerThanTheSurfaceOfATraceIsAnError)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 1);
  vtkNew<vtkPolyData> path;
  path->SetPoints(points);
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(path);
  trace->SetSurfaceData(MakeSphere(0.05));
  trace->SetTipRadius(0.2);
  EventCounter errors(trace, vtkCommand::ErrorEvent);
  trace->Update();
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(trace->GetOutput()->GetNumberOfPoints(), 0);
  trace->SetTipRadius(0.01);
  trace->Update();
  EXPECT_EQ(trace->GetOutput()->GetNumberOfPoints(), 1);
}

// A part is carried by the ball that touches it, and is touched from its side again afterwards.
TEST(Tip, CarriesAPart)
{
  Workbench bench;
  bench.Scene->SetTipRadius(R);
  bench.Go(0.003, 0.005, 0.03);
  bench.Go(0.003, 0.005, 0.02 + R - 0.001);
  EXPECT_NEAR(bench.GodObject()[2], 0.02 + R, 1e-6);
  ASSERT_TRUE(bench.Scene->GetGrip()->Take());
  for (int i = 1; i <= 50; ++i)
  {
    bench.Go(0.003 - 4e-4 * i, 0.005, 0.02 + R - 0.001 + 2e-4 * i);
  }
  bench.Scene->GetGrip()->LetGo();
  bench.Go(0.003 - 0.02, 0.005, 0.02 + R - 0.001 + 0.01, 3);
  const Point part = bench.Place(bench.Part);
  EXPECT_NEAR(part[0], -0.02, 3e-3);
  EXPECT_NEAR(part[2], 0.01, 3e-3);
  EXPECT_NEAR(bench.GodObject()[2] - part[2], 0.02 + R, 1e-6);
  EXPECT_FALSE(bench.IsInside());
}
