// The hand slides over a cube's top and on past its edge: the trail bends sharply over the edge and
// the god-object is held by the side that faces right. Seen to fail without the trail, without the
// arrow, and with the god-object drawn at the HIP.
#include "ImageTestTools.h"

#include "vtkCubeSource.h"

#include <iostream>

int TestConvexEdge(int argc, char* argv[])
{
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(0.1);
  cube->SetYLength(0.1);
  cube->SetZLength(0.1);
  vtkSmartPointer<vtkActor> actor = MakeActor(cube->GetOutputPort());

  TestHand touch;
  touch.Scene->AddSurface(actor);
  vtkGodObjectActor* hand = touch.View->GetGodObjectActor();
  hand->ShowTrailOn();
  touch.MoveTo(-0.02, -0.02, 0.06);
  touch.MoveTo(-0.02, -0.02, 0.04);
  touch.MoveTo(0.0501, 0.01, 0.04); // just past the edge
  touch.MoveTo(0.035, 0.02, 0.0);
  if (touch.Scene->GetForce()[0] < 1.0)
  {
    std::cerr << "The hand has not gone over the edge: its force is " << touch.Scene->GetForce()[0]
              << " N to the right." << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(actor, hand);
  picture.LookFrom(0.3, -0.2, 0.25);
  return picture.Compare(argc, argv);
}
