// A ball is gripped at its right side and carried to a block, which holds the point in the hand and
// the ball with it: the ball lies against the block, far from where it was (drawn as wires), and
// the arrow is the block's force. Seen to fail when the actor stays, and when it follows the HIP.
#include "ImageTestTools.h"

#include "vtkCubeSource.h"
#include "vtkHapticGrip.h"
#include "vtkPlaneSource.h"

#include <iostream>

int TestCarry(int argc, char* argv[])
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.1, -0.05, -0.02);
  plane->SetPoint1(0.1, -0.05, -0.02);
  plane->SetPoint2(-0.1, 0.05, -0.02);
  vtkSmartPointer<vtkActor> table = MakeActor(plane->GetOutputPort());
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(0.03);
  cube->SetYLength(0.06);
  cube->SetZLength(0.06);
  cube->SetCenter(0.075, 0.0, 0.01);
  vtkSmartPointer<vtkActor> block = MakeActor(cube->GetOutputPort());
  block->GetProperty()->SetColor(0.62, 0.68, 0.60);
  TestBall ball(0.02, 24, 24);
  ball.Actor->SetPosition(-0.06, 0.0, 0.0);
  ball.Actor->GetProperty()->SetColor(0.80, 0.70, 0.55);
  TestBall start(0.02, 12, 12);
  start.Actor->SetPosition(-0.06, 0.0, 0.0);
  start.Actor->GetProperty()->SetRepresentationToWireframe();
  start.Actor->GetProperty()->LightingOff();
  start.Actor->GetProperty()->SetColor(0.45, 0.40, 0.35);

  TestHand touch;
  touch.Scene->AddSurface(table);
  touch.Scene->AddSurface(block);
  touch.Scene->AddSurface(ball.Actor);
  vtkGodObjectActor* hand = touch.View->GetGodObjectActor();
  touch.MoveTo(-0.03, -0.005, 0.005);
  touch.MoveTo(-0.043, -0.005, 0.005);
  touch.Device->SetButtons(1u << 2);
  touch.MoveTo(-0.044, -0.005, 0.005);
  touch.MoveTo(0.0, -0.005, 0.05);
  touch.MoveTo(0.075, -0.005, 0.01);
  if (touch.Scene->GetGrip()->GetSurface() < 0 || touch.Scene->GetForce()[0] > -1.0)
  {
    std::cerr << "The block holds nothing: force " << touch.Scene->GetForce()[0]
              << " N along x, surface " << touch.Scene->GetGrip()->GetSurface() << " gripped"
              << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(table, hand);
  picture.Renderer->AddActor(block);
  picture.Renderer->AddActor(ball.Actor);
  picture.Renderer->AddActor(start.Actor);
  picture.LookFrom(-0.1, -0.3, 0.2, 1.3);
  return picture.Compare(argc, argv);
}
