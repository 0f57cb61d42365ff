// A plate 0.5 mm thick, pressed 25 mm deep: the god-object stays on the face where the hand came
// in, while the HIP is seen far below the other one. Seen to fail without the spring, without the
// HIP, and with the god-object drawn at the HIP.
#include "ImageTestTools.h"

#include "vtkCubeSource.h"

#include <iostream>

int TestThinPlate(int argc, char* argv[])
{
  vtkNew<vtkCubeSource> plate;
  plate->SetXLength(0.1);
  plate->SetYLength(0.1);
  plate->SetZLength(0.0005);
  vtkSmartPointer<vtkActor> actor = MakeActor(plate->GetOutputPort());

  TestHand touch;
  touch.Scene->AddSurface(actor);
  vtkGodObjectActor* hand = touch.View->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->SetReferenceForce(5.0);
  touch.MoveTo(-0.03, -0.02, 0.02);
  touch.MoveTo(-0.03, -0.02, -0.005);
  touch.MoveTo(0.015, 0.01, -0.025);
  if (touch.Scene->GetForce()[2] < 1.0)
  {
    std::cerr << "The plate does not press back: " << touch.Scene->GetForce()[2] << " N" << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(actor, hand);
  picture.LookFrom(0.1, -0.3, 0.13, 1.2);
  return picture.Compare(argc, argv);
}
