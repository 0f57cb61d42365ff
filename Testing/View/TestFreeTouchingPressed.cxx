// Three balls and three hands. Left: a free hand, one sphere and nothing else. Middle: a light
// touch, a short arrow. Right: pressed hard, the HIP deep inside at the end of its spring, a long
// arrow. Seen to fail with every arrow as long as that of 1 N, and with the god-object drawn at the
// HIP.
#include "ImageTestTools.h"

#include <iostream>

int TestFreeTouchingPressed(int argc, char* argv[])
{
  const double heights[3] = { 0.045, 0.021, 0.012 }; // of the hand, where the ball's is 0.03
  TestBall balls[3] = { { 0.03, 40, 40 }, { 0.03, 40, 40 }, { 0.03, 40, 40 } };
  TestHand touches[3];
  for (int i = 0; i < 3; ++i)
  {
    balls[i].Actor->SetPosition(0.07 * (i - 1), 0.0, 0.0);
    TestHand& touch = touches[i];
    touch.Scene->AddSurface(balls[i].Actor);
    touch.MoveTo(0.07 * (i - 1) - 0.005, -0.01, 0.05);
    touch.MoveTo(0.07 * (i - 1) - 0.005, -0.01, heights[i]);
    touch.MoveTo(0.07 * (i - 1) + 0.005, -0.01, heights[i]);
    if (touch.Scene->GetTouching() != (i > 0))
    {
      std::cerr << "Hand " << i << (i > 0 ? " touches nothing." : " is not free.") << '\n';
      return EXIT_FAILURE;
    }
  }

  TestPicture picture(balls[0].Actor, touches[0].View->GetGodObjectActor());
  for (int i = 1; i < 3; ++i)
  {
    picture.Renderer->AddActor(balls[i].Actor);
    picture.Renderer->AddViewProp(touches[i].View->GetGodObjectActor());
  }
  picture.LookFrom(0.0, -0.3, 0.1);
  return picture.Compare(argc, argv);
}
