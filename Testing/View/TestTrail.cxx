// A trail lies exactly on a slope that is seen nearly from its edge, where half of the line's width
// is below the surface. Drawn as it is, about half of it is hidden.
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkGodObjectActor.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace
{
struct Slope
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkActor> Surface;
  vtkNew<vtkGodObjectActor> Hand;

  Slope(double size, bool parallel)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-size, -size, 0.0);
    plane->SetPoint1(size, -size, 0.0);
    plane->SetPoint2(-size, size, 0.0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    this->Surface->SetMapper(mapper);
    this->Surface->GetProperty()->SetColor(0.0, 0.0, 1.0);
    this->Surface->GetProperty()->LightingOff();
    this->Hand->ShowTrailOn();
    this->Hand->SetSize(1e-6);
    for (int i = -50; i <= 50; ++i)
    {
      const double point[3] = { 0.01 * i * size, 0.002 * i * size, 0.0 };
      this->Hand->AddTrailPoint(point, true);
    }
    this->Renderer->AddActor(this->Surface);
    this->Renderer->AddViewProp(this->Hand);
    this->Window->SetSize(200, 200);
    this->Window->SetMultiSamples(0);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetParallelProjection(parallel);
    camera->SetPosition(0.0, -std::cos(0.35), std::sin(0.35)); // 20 degrees above the surface
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCamera();
  }

  /// Pixels that are more red than blue: the trail's.
  int CountTrail()
  {
    this->Window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, 199, 199, 0, pixels);
    int count = 0;
    for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
    {
      count += pixels->GetComponent(i, 0) > pixels->GetComponent(i, 2) ? 1 : 0;
    }
    return count;
  }
};
}

TEST(GodObjectActor, TheTrailIsSeenWholeOnASlopeAtAnyScale)
{
  // All stay open till the end: an X server without clients may start anew, and refuse meanwhile.
  std::vector<std::unique_ptr<Slope>> slopes;
  for (const double size : { 0.003, 30000.0 })
  {
    for (const bool parallel : { false, true })
    {
      slopes.push_back(std::make_unique<Slope>(size, parallel));
      Slope& slope = *slopes.back();
      const int withSurface = slope.CountTrail();
      slope.Surface->GetProperty()->SetOpacity(0.0);
      const int alone = slope.CountTrail();
      ASSERT_GT(alone, 200);
      EXPECT_GE(withSurface, 0.98 * alone) << size << (parallel ? ", parallel" : "");
    }
  }
}

TEST(GodObjectActor, TheTrailIsHiddenByWhatLiesInFrontOfIt)
{
  Slope slope(1.0, false);
  slope.Surface->SetPosition(0.0, 0.0, 0.2); // lifted off the trail
  EXPECT_LT(slope.CountTrail(), 10);
}
