#include "pqHapticsExamples.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqHapticsManager.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <QAction>

#include <functional>

namespace
{
constexpr double Isosurface = 157.0; // of the wavelet's scalars
constexpr double Radius = 0.5;       // of ParaView's sphere
constexpr int Round = 64;            // corners around it
constexpr int PathSteps = 1000;      // of a stroke, 1 ms each
constexpr double DeviceScale = 0.1;  // [m] for a world unit
constexpr double LineWidth = 4.0;    // of the trace [pixel]

using SetUp = std::function<void(vtkSMProxy*)>;

/// A source or filter of the session, computed.
vtkSMSourceProxy* make(
  const char* group, const char* name, vtkSMProxy* input = nullptr, const SetUp& setUp = SetUp())
{
  vtkSMSessionProxyManager* proxies = pqActiveObjects::instance().activeServer()->proxyManager();
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  vtkSmartPointer<vtkSMProxy> proxy;
  proxy.TakeReference(proxies->NewProxy(group, name));
  controller->PreInitializeProxy(proxy);
  if (input)
  {
    vtkSMPropertyHelper(proxy, "Input").Set(input);
  }
  if (setUp)
  {
    setUp(proxy);
  }
  controller->PostInitializeProxy(proxy);
  proxy->UpdateVTKObjects();
  controller->RegisterPipelineProxy(proxy);
  auto* source = vtkSMSourceProxy::SafeDownCast(proxy);
  source->UpdatePipeline();
  return source;
}

vtkSMViewProxy* activeView()
{
  pqView* view = pqActiveObjects::instance().activeView();
  return qobject_cast<pqRenderView*>(view) ? view->getViewProxy() : nullptr;
}

vtkSMProxy* showInView(vtkSMSourceProxy* source)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  return controller->Show(source, 0, activeView());
}

void colorBy(vtkSMProxy* shown, const char* array)
{
  // The members: ParaView 6 has no static functions of these names.
  if (auto* const colored = vtkSMPVRepresentationProxy::SafeDownCast(shown))
  {
    colored->SetScalarColoring(array, vtkDataObject::POINT);
    colored->RescaleTransferFunctionToDataRange();
  }
}

vtkSMSourceProxy* makeSphere()
{
  return make("sources", "SphereSource", nullptr,
    [](vtkSMProxy* sphere)
    {
      vtkSMPropertyHelper(sphere, "ThetaResolution").Set(Round);
      vtkSMPropertyHelper(sphere, "PhiResolution").Set(Round);
    });
}

/// Looks at a source as a whole, and chooses it in the pipeline browser.
void choose(vtkSMSourceProxy* source)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  pqActiveObjects::instance().setActiveSource(model->findItem<pqPipelineSource*>(source));
  pqActiveObjects::instance().activeView()->resetDisplay();
  pqActiveObjects::instance().activeView()->forceRender();
}
}

pqHapticsExamples::pqHapticsExamples(pqHapticsManager* manager, QWidget* parent)
  : Superclass("Examples", parent)
  , Manager(manager)
{
  this->setObjectName("HapticExamples");
  this->add("actionHapticExampleContour", "Touch a Contour",
    "Wavelet, Contour, Touch: what the tutorial begins with", &pqHapticsExamples::touchAContour);
  this->add("actionHapticExampleStiffness", "Stiffness by Data",
    "A ball that is soft at the bottom and hard at the top, by a data array",
    &pqHapticsExamples::stiffnessByData);
  this->add("actionHapticExampleFilter", "God Object Filter",
    "A ball as clean triangles, with a report in its field data",
    &pqHapticsExamples::cleanTriangles);
  this->add("actionHapticExampleTrace", "God Object Trace",
    "A straight path through a ball, and the forces on a hand along it, without a device",
    &pqHapticsExamples::traceAPath);
}

void pqHapticsExamples::add(
  const char* name, const QString& text, const QString& tip, void (pqHapticsExamples::*make)())
{
  QAction* action = this->addAction(text);
  action->setObjectName(name);
  action->setToolTip(tip);
  action->setStatusTip(tip);
  this->connect(action, &QAction::triggered, this,
    [this, text, make]
    {
      if (!activeView())
      {
        this->Manager->complain(
          text, "An example needs a render view. Click into one, or make one.");
        return;
      }
      this->Manager->setEngaged(
        false); // the device reaches for the example, not for what was there
      SCOPED_UNDO_SET("Example: " + text);
      vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
      controller->HideAll(activeView()); // which may lie around it
      (this->*make)();
    });
}

void pqHapticsExamples::touchAContour()
{
  vtkSMSourceProxy* wavelet = make("sources", "RTAnalyticSource");
  vtkSMSourceProxy* contour = make("filters", "Contour", wavelet,
    [](vtkSMProxy* filter) { vtkSMPropertyHelper(filter, "ContourValues").Set(Isosurface); });
  showInView(contour);
  choose(contour);
  this->Manager->touch();
}

void pqHapticsExamples::stiffnessByData()
{
  vtkSMSourceProxy* height = make("filters", "ElevationFilter", makeSphere(),
    [](vtkSMProxy* filter)
    {
      const double low[3] = { 0.0, -Radius, 0.0 };
      const double high[3] = { 0.0, Radius, 0.0 };
      vtkSMPropertyHelper(filter, "LowPoint").Set(low, 3);
      vtkSMPropertyHelper(filter, "HighPoint").Set(high, 3);
    });
  vtkSMProxy* shown = showInView(height);
  colorBy(shown, "Elevation");
  vtkSMPropertyHelper(shown, "HapticStiffnessArray")
    .SetInputArrayToProcess(vtkDataObject::POINT, "Elevation");
  shown->UpdateVTKObjects();
  choose(height);
  this->Manager->touch();
}

void pqHapticsExamples::cleanTriangles()
{
  vtkSMSourceProxy* clean = make("filters", "GodObjectFilter", makeSphere());
  showInView(clean);
  choose(clean);
  this->Manager->touch();
}

void pqHapticsExamples::traceAPath()
{
  vtkSMSourceProxy* sphere = makeSphere();
  vtkSMSourceProxy* path = make("sources", "LineSource", nullptr,
    [](vtkSMProxy* line)
    {
      const double begin[3] = { -1.2 * Radius, 0.3 * Radius, 0.85 * Radius };
      const double end[3] = { 1.2 * Radius, 0.3 * Radius, 0.85 * Radius };
      vtkSMPropertyHelper(line, "Point1").Set(begin, 3);
      vtkSMPropertyHelper(line, "Point2").Set(end, 3);
      vtkSMPropertyHelper(line, "Resolution").Set(PathSteps);
    });
  vtkSMSourceProxy* trace = make("filters", "GodObjectTrace", path,
    [sphere](vtkSMProxy* filter)
    {
      vtkSMPropertyHelper(filter, "Surface").Set(sphere);
      vtkSMPropertyHelper(filter, "WorldToDeviceScale").Set(DeviceScale);
    });
  showInView(sphere);
  showInView(path);
  vtkSMProxy* shown = showInView(trace);
  vtkSMPropertyHelper(shown, "LineWidth").Set(LineWidth);
  colorBy(shown, "Force");
  shown->UpdateVTKObjects();
  choose(sphere); // which can be touched
}
