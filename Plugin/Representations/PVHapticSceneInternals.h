#ifndef Haptics_PVHapticSceneInternals_h
#define Haptics_PVHapticSceneInternals_h

#include "HapticDeviceChoice.h"
#include "vtkActor.h"
#include "vtkCompositeRepresentation.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkGodObjectActor.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticScene.h"
#include "vtkHapticSurfaceRepresentation.h"
#include "vtkHapticView.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPVHapticScene.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkWeakPointer.h"

#include <set>
#include <string>
#include <vector>

/// What a vtkPVHapticScene is made of, for its source files.
class vtkPVHapticScene::Internals
{
public:
  struct Surface
  {
    vtkWeakPointer<vtkObject> Representation;
    vtkWeakPointer<vtkHapticSurfaceRepresentation> Beside; // that is touched while another is drawn
    vtkSmartPointer<vtkActor> Actor;                       // null while it cannot be touched
    int Id = -1;                                           // in the scene
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
  bool MessageIsOfSurface = false; // it goes when no surface is bad any more
  std::string ReleasedBecause;     // by what the user did with sources and views
  bool MustRender = false;         // the picture is older than what is known
  bool HasTouched = false;         // the hint is not needed any more
  std::string TouchedName;
  std::string State;
  std::string ShownState;
  vtkNew<vtkStringArray> Probed;

  Internals() { this->Picture->SetScene(this->Scene); }

  /// What brings the triangles of a surface; null where it cannot be touched just now.
  static vtkHapticSurfaceRepresentation* Touched(const Surface& surface)
  {
    vtkObject* drawn = surface.Representation;
    if (auto* composite = vtkCompositeRepresentation::SafeDownCast(drawn))
    {
      drawn = composite->GetActiveRepresentation();
    }
    auto* haptic = vtkHapticSurfaceRepresentation::SafeDownCast(drawn);
    return haptic                                        ? haptic
      : surface.Beside && surface.Beside->GetTouchable() ? +surface.Beside
                                                         : nullptr;
  }

  /// The point and cell arrays of the surfaces but for ParaView's own bookkeeping.
  std::set<std::string> NamesOfArrays() const
  {
    std::set<std::string> names;
    for (const Surface& surface : this->Surfaces)
    {
      vtkDataSet* data = surface.Actor ? surface.Actor->GetMapper()->GetInput() : nullptr;
      for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
      {
        vtkFieldData* arrays = data ? data->GetAttributesAsFieldData(kind) : nullptr;
        for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
        {
          const char* name = arrays->GetArray(i) ? arrays->GetArray(i)->GetName() : nullptr;
          if (name && std::string(name).rfind("vtk", 0) != 0)
          {
            names.insert(name);
          }
        }
      }
    }
    return names;
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
    this->MustRender = false;
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
