// A ball that its actor's matrix has put on a table: the hand strokes the table, comes to the ball
// and is held in the crease by both, each surface with its highlighted triangle. Seen to fail with
// the actor's matrix ignored, without the HIP, and with the god-object drawn at the HIP.
#include "ImageTestTools.h"

#include "vtkPlaneSource.h"

#include <iostream>

int TestSeveralSurfaces(int argc, char* argv[])
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.06, -0.06, 0.0);
  plane->SetPoint1(0.06, -0.06, 0.0);
  plane->SetPoint2(-0.06, 0.06, 0.0);
  plane->SetResolution(8, 8);
  vtkSmartPointer<vtkActor> table = MakeActor(plane->GetOutputPort());
  TestBall ball(1.0, 24, 24);
  ball.Actor->SetScale(0.03);
  ball.Actor->SetPosition(0.02, 0.02, 0.02);
  ball.Actor->GetProperty()->SetColor(0.80, 0.70, 0.55);

  TestHand touch;
  touch.Scene->AddSurface(table);
  touch.Scene->AddSurface(ball.Actor);
  vtkGodObjectActor* hand = touch.View->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->ShowActiveTrianglesOn();
  touch.MoveTo(-0.05, -0.04, 0.01);
  touch.MoveTo(-0.05, -0.04, -0.01);
  touch.MoveTo(0.03, -0.035, -0.012);
  touch.MoveTo(0.015, 0.012, -0.012);
  const double* force = touch.Scene->GetForce();
  if (force[1] > -1.0 || force[2] < 1.0)
  {
    std::cerr << "Not held by both: force (" << force[0] << ", " << force[1] << ", " << force[2]
              << ")" << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(table, hand);
  picture.Renderer->AddActor(ball.Actor);
  picture.LookFrom(-0.3, -0.12, 0.2, 1.2);
  return picture.Compare(argc, argv);
}
