// What the image tests share: a surface and the hand in a small window, and the comparison.
#ifndef ImageTestTools_h
#define ImageTestTools_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkGodObjectActor.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

struct TestBall
{
  TestBall(double radius, int aroundResolution, int acrossResolution)
  {
    this->Source->SetRadius(radius);
    this->Source->SetThetaResolution(aroundResolution);
    this->Source->SetPhiResolution(acrossResolution);
    this->Mapper->SetInputConnection(this->Source->GetOutputPort());
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetColor(0.55, 0.65, 0.75);
  }

  vtkNew<vtkSphereSource> Source;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

struct TestPicture
{
  TestPicture(vtkActor* surface, vtkGodObjectActor* hand)
    : Hand(hand)
  {
    this->Renderer->SetBackground(0.95, 0.95, 0.95);
    this->Renderer->AddActor(surface);
    this->Renderer->AddViewProp(hand);
    this->Window->SetSize(300, 300);
    this->Window->SetMultiSamples(0);
    this->Window->AddRenderer(this->Renderer);
    this->Interactor->SetRenderWindow(this->Window);
  }

  void LookFrom(double x, double y, double z)
  {
    vtkCamera* const camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(x, y, z);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCamera();
    camera->Zoom(1.3);
  }

  /// Renders and compares with the baseline; what a test's main returns.
  int Compare(int argc, char* argv[])
  {
    this->Renderer->ResetCameraClippingRange();
    this->Hand->IncludeInClippingRange(this->Renderer);
    this->Window->Render();
    // The default of 10 would not even miss the arrow; this leaves room for another driver's edges.
    const int result = vtkRegressionTestImageThreshold(this->Window, 0.2);
    if (result == vtkRegressionTester::DO_INTERACTOR)
    {
      this->Interactor->Start();
    }
    return result == vtkRegressionTester::FAILED ? EXIT_FAILURE : EXIT_SUCCESS;
  }

  vtkGodObjectActor* Hand;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderWindowInteractor> Interactor;
};

#endif
