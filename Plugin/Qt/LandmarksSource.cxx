#include "LandmarksSource.h"

#include "pqActiveObjects.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "vtkHapticRecordSource.h"
#include "vtkNew.h"
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
}

vtkSMProxy* MakeLandmarksSource(vtkPolyData* landmarks)
{
  pqServer* server = pqActiveObjects::instance().activeServer();
  if (!server)
  {
    return nullptr;
  }
  SCOPED_UNDO_SET("Landmarks to Source");
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  vtkSmartPointer<vtkSMProxy> proxy;
  proxy.TakeReference(server->proxyManager()->NewProxy("sources", "HapticRecord"));
  auto* source = vtkSMSourceProxy::SafeDownCast(proxy);
  controller->PreInitializeProxy(source);
  vtkSMPropertyHelper(source, "Contents")
    .Set(vtkHapticRecordSource::MakeContents(landmarks).c_str());
  controller->PostInitializeProxy(source);
  source->UpdateVTKObjects();
  controller->RegisterPipelineProxy(
    source, server->proxyManager()->GetUniqueProxyName("sources", "HapticLandmarks").c_str());
  source->UpdatePipeline();

  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  vtkSMProxy* shown = view ? controller->Show(source, 0, view->getViewProxy()) : nullptr;
  if (shown)
  {
    vtkSMPropertyHelper(shown, "PointSize").Set(PointSize);
    vtkSMPropertyHelper(shown, "RenderPointsAsSpheres").Set(1);
    shown->UpdateVTKObjects();
    view->render();
  }
  return source;
}
}
