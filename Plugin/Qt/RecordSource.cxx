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
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <string>
#include <vector>

namespace haptics
{
namespace
{
constexpr double PointSize = 12.0; // [pixel]
constexpr double LineWidth = 3.0;  // [pixel]
const std::string ForceSeries = "ForceMagnitude";

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

void Render(vtkSMProxy* shown)
{
  shown->UpdateVTKObjects();
  pqActiveObjects::instance().activeView()->render();
}

/// Of a line chart's series, where it has the force among them.
void ShowForceAlone(vtkSMProxy* chart)
{
  vtkSMPropertyHelper visible(chart, "SeriesVisibility");
  std::vector<std::string> series;
  for (unsigned int i = 0; i + 1 < visible.GetNumberOfElements(); i += 2)
  {
    series.emplace_back(visible.GetAsString(i));
  }
  if (std::find(series.begin(), series.end(), ForceSeries) == series.end())
  {
    return;
  }
  for (const std::string& name : series)
  {
    visible.SetStatus(name.c_str(), name == ForceSeries ? 1 : 0);
  }
  chart->UpdateVTKObjects();
}

/// Lines that are coloured by the force.
vtkSMProxy* MakeLines(vtkPolyData* record, const char* name)
{
  vtkSMProxy* shown = nullptr;
  vtkSMProxy* source = Make(record, name, shown);
  if (shown)
  {
    vtkSMPropertyHelper(shown, "LineWidth").Set(LineWidth);
    if (record->GetPointData()->HasArray("Force"))
    {
      // The members: ParaView 6 has no static functions of these names.
      if (auto* const colored = vtkSMPVRepresentationProxy::SafeDownCast(shown))
      {
        colored->SetScalarColoring("ForceMagnitude", vtkDataObject::POINT);
        colored->RescaleTransferFunctionToDataRange();
      }
    }
    Render(shown);
  }
  return source;
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
    Render(shown);
  }
  return source;
}

vtkSMProxy* MakeTraceSource(vtkPolyData* trace)
{
  SCOPED_UNDO_SET("Trace to Source");
  return MakeLines(trace, "HapticTrace");
}

vtkSMProxy* MakeCurvesSource(vtkPolyData* curves)
{
  SCOPED_UNDO_SET("Draw Curves");
  return MakeLines(curves, "HapticCurves");
}

void BeginChartOfTrace(vtkSMProxy* representation)
{
  if (!representation || !representation->GetProperty("SeriesVisibility") ||
    !representation->GetProperty("Input"))
  {
    return;
  }
  // The source itself, or what Plot Data makes of it.
  vtkSMProxy* source = vtkSMPropertyHelper(representation, "Input").GetAsProxy();
  if (source && source->GetXMLName() == std::string("PlotAttributes"))
  {
    source = vtkSMPropertyHelper(source, "Input").GetAsProxy();
  }
  if (source && source->GetXMLName() == std::string("HapticRecord"))
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
    ShowForceAlone(representation);
  }
}

void PlotTrace(vtkSMProxy* trace)
{
  SCOPED_UNDO_SET("Plot Force");
  pqView* active = pqActiveObjects::instance().activeView();
  pqPipelineSource* selected = pqActiveObjects::instance().activeSource();
  vtkSMSessionProxyManager* proxies = trace->GetSessionProxyManager();
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;

  vtkSmartPointer<vtkSMProxy> plot;
  plot.TakeReference(proxies->NewProxy("filters", "PlotAttributes"));
  controller->PreInitializeProxy(plot);
  vtkSMPropertyHelper(plot, "Input").Set(trace);
  controller->PostInitializeProxy(plot);
  plot->UpdateVTKObjects();
  controller->RegisterPipelineProxy(plot);
  auto* source = vtkSMSourceProxy::SafeDownCast(plot);
  source->UpdatePipeline();

  vtkSmartPointer<vtkSMProxy> view;
  view.TakeReference(proxies->NewProxy("views", "XYChartView"));
  controller->InitializeProxy(view);
  controller->RegisterViewProxy(view);
  controller->AssignViewToLayout(vtkSMViewProxy::SafeDownCast(view));
  vtkSMPropertyHelper(view, "ChartTitle").Set("Force on the hand");
  vtkSMPropertyHelper(view, "BottomAxisTitle").Set("Time [s]");
  vtkSMPropertyHelper(view, "LeftAxisTitle").Set("Force [N]");
  view->UpdateVTKObjects();
  vtkSMProxy* shown = controller->Show(source, 0, vtkSMViewProxy::SafeDownCast(view));
  vtkSMPropertyHelper(shown, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(shown, "XArrayName").Set("Time");
  ShowForceAlone(shown);
  vtkSMViewProxy::SafeDownCast(view)->StillRender();
  pqActiveObjects::instance().setActiveView(active);
  pqActiveObjects::instance().setActiveSource(selected);
}
}
