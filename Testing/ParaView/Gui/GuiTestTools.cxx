#include "GuiTestTools.h"

#include "QVTKOpenGLStereoWidget.h"
#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqLoadDataReaction.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqQVTKWidget.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqTabbedMultiViewWidget.h"
#include "vtkNew.h"
#include "vtkPVHapticReadings.h"
#include "vtkPVHapticScene.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSMViewProxy.h"

#include <QAction>
#include <QApplication>
#include <QMessageBox>
#include <QMouseEvent>
#include <QTest>
#include <QToolBar>
#include <QWheelEvent>
#include <QWindow>

#include <string>

namespace GuiTest
{
bool waitUntil(const std::function<bool()>& isSo, double seconds)
{
  return QTest::qWaitFor(isSo, static_cast<int>(1000.0 * seconds));
}

QAction* findAction(const char* name)
{
  const QList<QWidget*> widgets = pqCoreUtilities::mainWidget()->findChildren<QWidget*>();
  for (QWidget* widget : widgets)
  {
    for (QAction* action : widget->actions())
    {
      if (action->objectName() == name)
      {
        return action;
      }
    }
  }
  return nullptr;
}

void pressTouch()
{
  auto* toolBar = find<QToolBar>("HapticsToolBar");
  QTest::mouseClick(toolBar->widgetForAction(findAction("actionTouch")), Qt::LeftButton);
}

bool touchIsDown()
{
  return findAction("actionTouch")->isChecked();
}

vtkSMProxy* scene()
{
  vtkSMSessionProxyManager* proxies = pqActiveObjects::instance().proxyManager();
  const char* name = proxies->GetProxyName("haptics", 0u);
  return name ? proxies->GetProxy("haptics", name) : nullptr;
}

vtkPVHapticScene* clientScene()
{
  vtkSMProxy* proxy = scene();
  return proxy ? vtkPVHapticScene::SafeDownCast(proxy->GetClientSideObject()) : nullptr;
}

QString takeComplaint()
{
  QString text;
  if (auto* box = find<QMessageBox>("HapticsComplaint"))
  {
    text = box->text();
    box->setObjectName("Read");
    box->close();
  }
  return text;
}

pqPipelineSource* makeSource(const char* name)
{
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  pqPipelineSource* source =
    builder->createSource("sources", name, pqActiveObjects::instance().activeServer());
  apply(source);
  return source;
}

pqPipelineSource* makeFilter(const char* name, pqPipelineSource* input)
{
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  pqPipelineSource* filter = builder->createFilter("filters", name, input);
  apply(filter);
  return filter;
}

pqPipelineSource* openFile(const QString& file)
{
  pqPipelineSource* source = pqLoadDataReaction::loadData(QStringList(file));
  apply(source);
  return source;
}

void apply(pqPipelineSource* source)
{
  source->getProxy()->UpdateVTKObjects();
  source->setModifiedState(pqProxy::UNMODIFIED);
  source->updatePipeline();
  pqActiveObjects::instance().setActiveSource(source);
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  pqView* view = pqActiveObjects::instance().activeView();
  controller->Show(source->getSourceProxy(), 0, view ? view->getViewProxy() : nullptr);
  if (view)
  {
    view->resetDisplay();
    view->forceRender();
  }
}

pqPipelineSource* makeWaveletContour()
{
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  pqPipelineSource* wavelet = builder->createSource(
    "sources", "RTAnalyticSource", pqActiveObjects::instance().activeServer());
  wavelet->getProxy()->UpdateVTKObjects();
  wavelet->setModifiedState(pqProxy::UNMODIFIED);
  wavelet->updatePipeline();
  pqPipelineSource* contour = builder->createFilter("filters", "Contour", wavelet);
  vtkSMPropertyHelper(contour->getProxy(), "ContourValues").Set(157.0);
  apply(contour);
  return contour;
}

namespace
{
/// What the mouse meets in the active view: a window or a widget, as ParaView has chosen.
QObject* mouseTarget(QSize& size)
{
  auto* container = qobject_cast<pqQVTKWidget*>(pqActiveObjects::instance().activeView()->widget());
  QWidget* widget = container->renderWidget();
  size = widget->size();
  auto* stereo = qobject_cast<QVTKOpenGLStereoWidget*>(widget);
  return stereo ? static_cast<QObject*>(stereo->embeddedOpenGLWindow()) : widget;
}

QPointF placeIn(const QSize& size, double x, double y)
{
  return QPointF(x * size.width(), (1.0 - y) * size.height());
}
}

void moveMouse(double x, double y)
{
  QSize size;
  QObject* target = mouseTarget(size);
  const QPointF place = placeIn(size, x, y);
  QMouseEvent event(
    QEvent::MouseMove, place, place, place, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(target, &event);
}

void turnWheel(double x, double y, int notches)
{
  constexpr int notch = 120; // as Qt counts
  QSize size;
  QObject* target = mouseTarget(size);
  const QPointF place = placeIn(size, x, y);
  for (int i = 0; i < std::abs(notches); ++i)
  {
    QWheelEvent event(place, place, QPoint(), QPoint(0, notches > 0 ? notch : -notch), Qt::NoButton,
      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(target, &event);
  }
}

QString representationType()
{
  return vtkSMPropertyHelper(
    pqActiveObjects::instance().activeRepresentation()->getProxy(), "Representation")
    .GetAsString();
}

bool isTouchable()
{
  return vtkSMPropertyHelper(
           pqActiveObjects::instance().activeRepresentation()->getProxy(), "Touchable")
           .GetAsInt() != 0;
}

bool engaged()
{
  return clientScene() && clientScene()->GetEngaged();
}

bool touching()
{
  return clientScene() && clientScene()->GetReadings()->GetTouching();
}

bool press(double height)
{
  if (!waitUntil([] { return !clientScene()->GetBuilding(); }))
  {
    return false;
  }
  moveMouse(0.5, height);
  QTest::qWait(200); // the hand comes to the cursor as an arm would
  turnWheel(0.5, height, 3);
  return waitUntil(touching);
}

void setDevice(const char* name)
{
  if (!scene())
  {
    pressTouch(); // which makes the scene, where there is something to touch
    pressTouch();
  }
  vtkSMPropertyHelper(scene(), "Device").Set(name);
  scene()->UpdateVTKObjects();
}

void startAnew()
{
  if (touchIsDown())
  {
    pressTouch();
  }
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  builder->destroySources();
  const QList<pqView*> views =
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqView*>();
  for (pqView* view : views)
  {
    // ParaView 6 leaves a layout split where its views are destroyed.
    auto* layout = vtkSMViewLayoutProxy::FindLayout(view->getViewProxy());
    builder->destroy(view);
    if (layout && layout->GetViews().empty())
    {
      layout->Reset();
    }
  }
  pqView* view =
    builder->createView(pqRenderView::renderViewType(), pqActiveObjects::instance().activeServer());
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->AssignViewToLayout(view->getViewProxy());
  pqActiveObjects::instance().setActiveView(view);
  // The same picture whatever the size of the window and of its panels.
  find<pqTabbedMultiViewWidget>("MultiViewWidget")->lockViewSize(QSize(400, 400));
  waitUntil([view] { return view->widget()->isVisible() && view->getSize() == QSize(400, 400); });
}
}
