// The hand presses into the corner of a room: floor and both walls hold the god-object there, each
// with a highlighted triangle, and the force points out of the corner. Seen to fail when only one
// of the triangles was given, with the god-object drawn at the HIP, and without triangles or arrow.
#include "ImageTestTools.h"

#include "vtkAppendPolyData.h"
#include "vtkPlaneSource.h"

#include <iostream>

int TestConcaveCorner(int argc, char* argv[])
{
  //  z |   / y      floor z = 0, walls x = 0 and y = 0, all facing the room
  //    | /
  //    +------ x
  vtkNew<vtkAppendPolyData> room;
  for (int axis = 0; axis < 3; ++axis)
  {
    double first[3] = { 0.0, 0.0, 0.0 };
    double second[3] = { 0.0, 0.0, 0.0 };
    first[(axis + 1) % 3] = 0.1;
    second[(axis + 2) % 3] = 0.1;
    vtkNew<vtkPlaneSource> side;
    side->SetOrigin(0.0, 0.0, 0.0);
    side->SetPoint1(first);
    side->SetPoint2(second);
    room->AddInputConnection(side->GetOutputPort());
  }
  vtkSmartPointer<vtkActor> actor = MakeActor(room->GetOutputPort());

  TestHand touch;
  touch.Scene->AddSurface(actor);
  vtkGodObjectActor* hand = touch.View->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->ShowActiveTrianglesOn();
  touch.MoveTo(0.07, 0.05, 0.02);
  touch.MoveTo(0.06, 0.05, -0.01); // on the floor
  touch.MoveTo(0.05, -0.01, -0.01);
  touch.MoveTo(-0.015, -0.012, -0.012);
  if (touch.Scene->GetForce()[0] < 1.0)
  {
    std::cerr << "The hand is not in the corner: " << touch.Scene->GetErrorMessage() << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(actor, hand);
  picture.LookFrom(0.3, 0.35, 0.3);
  return picture.Compare(argc, argv);
}
