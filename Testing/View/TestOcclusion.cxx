// Two balls, each touched on its far side. Left: god-object, HIP and spring are seen through the
// ball. Right (SeeThrough off): the ball hides them, and only the tip of the arrow looks over it.
// Seen to fail when both were seen through, and when neither was.
#include "ImageTestTools.h"

#include <iostream>

int TestOcclusion(int argc, char* argv[])
{
  TestBall balls[2] = { { 0.03, 40, 40 }, { 0.03, 40, 40 } };
  TestHand touches[2];
  for (int i = 0; i < 2; ++i)
  {
    const double x = i == 0 ? -0.035 : 0.035;
    balls[i].Actor->SetPosition(x, 0.0, 0.0);
    TestHand& touch = touches[i];
    touch.Scene->AddSurface(balls[i].Actor);
    touch.View->GetGodObjectActor()->SetSeeThrough(i == 0);
    touch.MoveTo(x, 0.05, 0.05);
    touch.MoveTo(x, 0.01, 0.015);
    if (!touch.Scene->GetTouching())
    {
      std::cerr << "Hand " << i << " touches nothing." << '\n';
      return EXIT_FAILURE;
    }
  }

  TestPicture picture(balls[0].Actor, touches[0].View->GetGodObjectActor());
  picture.Renderer->AddActor(balls[1].Actor);
  picture.Renderer->AddViewProp(touches[1].View->GetGodObjectActor());
  picture.LookFrom(0.0, -0.3, 0.0);
  return picture.Compare(argc, argv);
}
