#include "RecordSource.h"

#include "pqActiveObjects.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "vtkDataObject.h"
#include "vtkHapticRecordSource.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

namespace haptics
{
namespace
{
constexpr double PointSize = 12.0; // [pixel]
constexpr double LineWidth = 3.0;  // [pixel]

/// Makes the source and its representation, null in a view that is no render view.
vtkSMProxy* Make(vtkPolyData* record, const char* name, vtkSMProxy*& shown)
{
  shown = nullptr;
  pqServer* server = pqActiveObjects::instance().activeServer();
  if (!server)
  {
    return nullptr;
  }
  pqPipelineSource* selected = pqActiveObjects::instance().activeSource();
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  vtkSmartPointer<vtkSMProxy> proxy;
  proxy.TakeReference(server->proxyManager()->NewProxy("sources", "HapticRecord"));
  auto* source = vtkSMSourceProxy::SafeDownCast(proxy);
  controller->PreInitializeProxy(source);
  vtkSMPropertyHelper(source, "Contents").Set(vtkHapticRecordSource::MakeContents(record).c_str());
  controller->PostInitializeProxy(source);
  source->UpdateVTKObjects();
  controller->RegisterPipelineProxy(
    source, server->proxyManager()->GetUniqueProxyName("sources", name).c_str());
  source->UpdatePipeline();
  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  shown = view ? controller->Show(source, 0, view->getViewProxy()) : nullptr;
  if (selected)
  {
    pqActiveObjects::instance().setActiveSource(selected);
  }
  return source;
}

void Render()
{
  if (pqView* view = pqActiveObjects::instance().activeView())
  {
    view->render();
  }
}
}

vtkSMProxy* MakeLandmarksSource(vtkPolyData* landmarks)
{
  SCOPED_UNDO_SET("Landmarks to Source");
  vtkSMProxy* shown = nullptr;
  vtkSMProxy* source = Make(landmarks, "HapticLandmarks", shown);
  if (shown)
  {
    vtkSMPropertyHelper(shown, "PointSize").Set(PointSize);
    vtkSMPropertyHelper(shown, "RenderPointsAsSpheres").Set(1);
    shown->UpdateVTKObjects();
    Render();
  }
  return source;
}

vtkSMProxy* MakeTraceSource(vtkPolyData* trace)
{
  SCOPED_UNDO_SET("Trace to Source");
  vtkSMProxy* shown = nullptr;
  vtkSMProxy* source = Make(trace, "HapticTrace", shown);
  if (shown)
  {
    vtkSMPropertyHelper(shown, "LineWidth").Set(LineWidth);
    if (trace->GetPointData()->HasArray("Force"))
    {
      vtkSMPVRepresentationProxy::SetScalarColoring(shown, "ForceMagnitude", vtkDataObject::POINT);
      vtkSMPVRepresentationProxy::RescaleTransferFunctionToDataRange(shown);
    }
    shown->UpdateVTKObjects();
    Render();
  }
  return source;
}
}
