// A bright and a dark ball; a landmark on each, and one between them on the bright ball's back,
// with numbers and distances next to them: readable over both, seen whole though their balls lie on
// slopes, and hidden with their ball by what is in front. The dark ball moves away and takes its
// landmark with it, whose distance grows. The hand is out of the picture, and they are not.
// It failed, with no landmark drawn, while they did not count for the picture's bounds.
#include "ImageTestTools.h"

#include "vtkHapticLandmarks.h"
#include "vtkMatrix4x4.h"

#include <cmath>
#include <iostream>

int TestLandmarkTexts(int argc, char* argv[])
{
  TestBall bright(0.04, 48, 32);
  TestBall dark(0.04, 48, 32);
  bright.Source->SetCenter(-0.05, 0.0, 0.0);
  dark.Source->SetCenter(0.03, 0.0, 0.0);
  bright.Actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
  dark.Actor->GetProperty()->SetColor(0.05, 0.05, 0.08);

  TestHand hand;
  hand.Scene->AddSurface(bright.Actor);
  hand.Scene->AddSurface(dark.Actor);
  hand.Scene->SetWorkspaceTransform(vtkNew<vtkMatrix4x4>());
  hand.Scene->GetWorkspace()->SetUnitLength(0.001);
  const double places[][3] = { { -0.05, 1.0, 0.0 }, { -0.05, -0.8, 0.6 }, { 0.03, -0.8, -0.6 } };
  for (const auto& [center, y, z] : places)
  {
    hand.MoveTo(center, 0.06 * y, 0.06 * z);
    hand.MoveTo(center, 0.035 * y, 0.035 * z);
    if (hand.Scene->DropLandmark() < 0)
    {
      std::cerr << "Nothing is touched: " << hand.Scene->GetErrorMessage() << '\n';
      return EXIT_FAILURE;
    }
    hand.MoveTo(center, 0.06 * y, 0.06 * z);
    hand.MoveTo(center, 0.06 * y, 0.1);
    hand.MoveTo(center, 0.0, 0.1);
  }
  dark.Actor->SetPosition(0.02, 0.0, 0.0);
  hand.Scene->Step(1);
  const double apart = std::sqrt(0.1 * 0.1 + 0.048 * 0.048);
  const double found = hand.Scene->GetLandmarks()->GetDistanceToPrevious(2);
  if (std::abs(found - apart) > 0.001)
  {
    std::cerr << "The landmarks are " << found << " apart, not " << apart << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(bright.Actor, hand.View->GetGodObjectActor());
  picture.Renderer->AddActor(dark.Actor);
  picture.Window->SetSize(400, 240);
  picture.LookFrom(0.0, -0.4, 0.0, 1.4);
  return picture.Compare(argc, argv);
}
