// What the image tests share: a surface and the hand in a small window, and the comparison.
#ifndef Haptics_ImageTestTools_h
#define Haptics_ImageTestTools_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticScene.h"
#include "vtkHapticView.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSimulatedHapticDevice.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <algorithm>

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

inline vtkSmartPointer<vtkActor> MakeActor(vtkAlgorithmOutput* geometry)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(geometry);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.55, 0.65, 0.75);
  return actor;
}

/// A hand in virtual time that strokes surfaces along straight lines. Device frame = world frame.
struct TestHand
{
  TestHand()
  {
    this->Scene->SetDevice(this->Device);
    this->Scene->SetStiffness(150.0);
    this->View->SetScene(this->Scene);
    this->View->GetGodObjectActor()->SetSize(0.03);
  }

  /// Goes straight on from where it is, in 250 ticks; the first time it begins there.
  void MoveTo(double x, double y, double z)
  {
    const double to[3] = { x, y, z };
    const bool began = this->Began;
    this->Began = true;
    for (int tick = began ? 1 : 250; tick <= 250; ++tick)
    {
      const double s = tick / 250.0;
      this->Device->SetPosition(this->At[0] + s * (to[0] - this->At[0]),
        this->At[1] + s * (to[1] - this->At[1]), this->At[2] + s * (to[2] - this->At[2]));
      this->Scene->Step(1);
    }
    std::copy(to, to + 3, this->At);
  }

  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticScene> Scene;
  vtkNew<vtkHapticView> View;
  double At[3] = { 0.0, 0.0, 0.0 };
  bool Began = false;
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

  void LookFrom(double x, double y, double z, double zoom = 1.0)
  {
    vtkCamera* const camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(x, y, z);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCamera();
    camera->Zoom(zoom);
  }

  /// Renders and compares with the baseline; what a test's main returns.
  int Compare(int argc, char* argv[])
  {
    this->Renderer->ResetCameraClippingRange();
    this->Hand->IncludeInClippingRange(this->Renderer);
    this->Window->Render();
    // The default of 10 would not even miss the arrow. VTK 9.1 to 9.3 with Mesa 22 and 25 differ by
    // 0; this leaves room for another driver's edges.
    const int result = vtkRegressionTestImageThreshold(this->Window, 0.05);
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
