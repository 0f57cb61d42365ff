#ifndef Haptics_PVHapticSceneInternals_h
#define Haptics_PVHapticSceneInternals_h

#include "HapticDeviceChoice.h"
#include "vtkActor.h"
#include "vtkCompositeRepresentation.h"
#include "vtkGodObjectActor.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticScene.h"
#include "vtkHapticSurfaceRepresentation.h"
#include "vtkHapticView.h"
#include "vtkNew.h"
#include "vtkPVHapticScene.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkWeakPointer.h"

#include <string>
#include <vector>

/// What a vtkPVHapticScene is made of, for its source files.
class vtkPVHapticScene::Internals
{
public:
  struct Surface
  {
    vtkWeakPointer<vtkObject> Representation;
    vtkSmartPointer<vtkActor> Actor; // null while it cannot be touched
    int Id = -1;                     // in the scene
    std::string Name;
  };

  vtkNew<vtkHapticScene> Scene;
  vtkNew<vtkHapticView> Picture;
  vtkWeakPointer<vtkPVRenderView> View;
  vtkWeakPointer<vtkRenderer> Renderer; // that shows the hand
  vtkWeakPointer<vtkRenderer> OverlayRenderer;
  std::vector<unsigned long> ViewObservers;
  std::vector<Surface> Surfaces;
  std::string DeviceName = "mouse";
  haptics::DeviceChoice Choice;
  bool Fitted = false;
  bool PathIsKnown = false; // to the device, for the workspace transform in force
  bool Wanted = false;      // engaged, or about to be when the device is ready
  bool InPieces = false;
  int Side = vtkGodObjectFilter::AUTOMATIC_SIDE;
  double MaximumForce = 3.3;
  std::string Message;
  std::string State;
  std::string ShownState;
  vtkNew<vtkStringArray> Probed;

  Internals() { this->Picture->SetScene(this->Scene); }

  static vtkHapticSurfaceRepresentation* Active(vtkObject* representation)
  {
    if (auto* composite = vtkCompositeRepresentation::SafeDownCast(representation))
    {
      representation = composite->GetActiveRepresentation();
    }
    return vtkHapticSurfaceRepresentation::SafeDownCast(representation);
  }

  void Show(vtkRenderer* renderer)
  {
    vtkGodObjectActor* hand = this->Picture->GetGodObjectActor();
    if (renderer != this->Renderer)
    {
      if (this->Renderer)
      {
        this->Renderer->RemoveViewProp(hand);
      }
      if (renderer)
      {
        renderer->AddViewProp(hand);
      }
      this->Renderer = renderer;
    }
  }

  /// Where the picture is drawn on a server only the non-composited renderer draws here.
  void OnRender()
  {
    if (this->View)
    {
      const bool remote = this->View->GetUsedLODForLastRender()
        ? this->View->GetUseDistributedRenderingForLODRender()
        : this->View->GetUseDistributedRenderingForRender();
      this->Show(remote ? this->View->GetNonCompositedRenderer() : this->View->GetRenderer());
      this->Picture->GetGodObjectActor()->IncludeInClippingRange(this->Renderer);
    }
  }
};

#endif
