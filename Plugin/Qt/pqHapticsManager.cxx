#include "pqHapticsManager.h"

#include "PythonStates.h"
#include "RecordSource.h"
#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqDataRepresentation.h"
#include "pqHapticsBrush.h"
#include "pqHapticsKeyboard.h"
#include "pqHapticsPen.h"
#include "pqHapticsRecorder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqQVTKWidget.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqServerManagerObserver.h"
#include "pqSettings.h"
#include "pqUndoStack.h"
#include "vtkCommand.h"
#include "vtkHapticDevice.h"
#include "vtkHapticScene.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkPVHapticPicture.h"
#include "vtkPVHapticReadings.h"
#include "vtkPVHapticRecords.h"
#include "vtkPVHapticScene.h"
#include "vtkPVRenderView.h"
#include "vtkSMHapticSceneProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMStringListDomain.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <QCoreApplication>
#include <QMessageBox>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace
{
constexpr const char* Group = "haptics";
constexpr const char* HapticSurface = "Haptic Surface";
constexpr const char* DeviceSetting = "Haptics/Device";

constexpr int RestTime = 250; // [ms] without change, after which the picture is drawn in full

/// How a representation draws its source.
QString typeOf(vtkSMProxy* representation)
{
  return representation && representation->GetProperty("Representation")
    ? vtkSMPropertyHelper(representation, "Representation").GetAsString()
    : "";
}

/// Whether a representation can be touched, as it is drawn or in addition.
bool isHaptic(vtkSMProxy* representation)
{
  const bool hasTypes = representation && representation->GetProperty("Representation");
  return hasTypes &&
    ((representation->GetProperty("Touchable") &&
       vtkSMPropertyHelper(representation, "Touchable").GetAsInt() != 0) ||
      typeOf(representation) == HapticSurface);
}

/// The outputs that are selected in the pipeline browser.
QList<pqOutputPort*> selectedPorts()
{
  QList<pqOutputPort*> ports;
  for (pqServerManagerModelItem* item : pqActiveObjects::instance().selection())
  {
    auto* source = qobject_cast<pqPipelineSource*>(item);
    auto* port = source ? source->getOutputPort(0) : qobject_cast<pqOutputPort*>(item);
    if (port)
    {
      ports.append(port);
    }
  }
  return ports;
}
}

pqHapticsManager* pqHapticsManager::instance()
{
  static QPointer<pqHapticsManager> manager;
  if (!manager)
  {
    manager = new pqHapticsManager(pqApplicationCore::instance());
  }
  return manager;
}

pqHapticsManager::pqHapticsManager(QObject* parent)
  : Superclass(parent)
  , Recorder(new pqHapticsRecorder(this))
  , Pen(new pqHapticsPen(this))
{
  this->setObjectName("HapticsManager");
  new pqHapticsBrush(this);
  new pqHapticsKeyboard(this);
  haptics::ExtendPython();
  this->Resting.setSingleShot(true);
  this->Resting.setInterval(RestTime);
  this->connect(&this->Resting, &QTimer::timeout, this, &pqHapticsManager::redraw);
  this->Timer.setObjectName("HapticsTimer");
  this->Timer.setInterval(1000 / MaximumRate + 1);
  this->connect(&this->Timer, &QTimer::timeout, this, &pqHapticsManager::poll);

  // No force stays on a device whose program ends.
  this->connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, this,
    [this] { this->setEngaged(false); });

  pqActiveObjects* active = &pqActiveObjects::instance();
  this->connect(active, &pqActiveObjects::selectionChanged, this, &pqHapticsManager::choiceChanged);
  this->connect(active, &pqActiveObjects::viewChanged, this, &pqHapticsManager::choiceChanged);
  this->connect(active, &pqActiveObjects::dataUpdated, this, &pqHapticsManager::choiceChanged);
  // A new source is selected before it counts as one that was not applied.
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::modifiedStateChanged, this, &pqHapticsManager::choiceChanged);
  this->connect(this, &pqHapticsManager::engagedChanged, this, &pqHapticsManager::choiceChanged);

  // The one that there is later, where this plugin is loaded before the main window is there.
  this->connect(pqApplicationCore::instance(), &pqApplicationCore::undoStackChanged, this,
    &pqHapticsManager::followUndo);
  this->followUndo(pqApplicationCore::instance()->getUndoStack());

  // A state file or a script may bring a scene, or take it away.
  pqServerManagerObserver* observer = pqApplicationCore::instance()->getServerManagerObserver();
  const auto look = [this](const QString& group)
  {
    if (group == Group || group == "settings")
    {
      this->findScene();
    }
  };
  // When its data are known.
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::representationAdded, this,
    [](pqRepresentation* representation)
    {
      QTimer::singleShot(0, representation,
        [representation] { haptics::BeginChartOfTrace(representation->getProxy()); });
    });
  using Registered = QOverload<const QString&, const QString&, vtkSMProxy*>;
  this->connect(observer, Registered::of(&pqServerManagerObserver::proxyRegistered), this, look);
  this->connect(observer, Registered::of(&pqServerManagerObserver::proxyUnRegistered), this, look);
  this->connect(&pqActiveObjects::instance(), &pqActiveObjects::serverChanged, this,
    [this](pqServer*) { this->findScene(); });
  this->findScene();
}

void pqHapticsManager::followUndo(pqUndoStack* stack)
{
  const auto follow = [this]
  {
    this->Landmarks = this->numberOfLandmarks(); // undo has changed them itself
    this->poll();
  };
  if (stack)
  {
    this->connect(stack, &pqUndoStack::undone, this, follow);
    this->connect(stack, &pqUndoStack::redone, this, follow);
  }
}

vtkSMProxy* pqHapticsManager::scene() const
{
  return this->Scene;
}

vtkSMProxy* pqHapticsManager::values() const
{
  pqServer* server = pqActiveObjects::instance().activeServer();
  if (this->Scene || !server)
  {
    return this->Scene;
  }
  vtkSMProxy* settings = server->proxyManager()->GetProxy("settings", "HapticSettings");
  return settings ? settings : server->proxyManager()->GetPrototypeProxy(Group, "HapticScene");
}

vtkPVHapticScene* pqHapticsManager::clientScene() const
{
  return this->Scene ? vtkPVHapticScene::SafeDownCast(this->Scene->GetClientSideObject()) : nullptr;
}

vtkHapticScene* pqHapticsManager::hand() const
{
  vtkPVHapticScene* scene = this->clientScene();
  return scene ? scene->GetScene() : nullptr;
}

vtkHapticDevice* pqHapticsManager::viewDevice() const
{
  vtkHapticDevice* device = this->hand() ? this->hand()->GetDevice() : nullptr;
  return device && device->UsesView() ? device : nullptr;
}

pqOutputPort* pqHapticsManager::touchedPort() const
{
  vtkPVHapticScene* scene = this->clientScene();
  const int touched = scene ? scene->GetReadings()->GetTouchedRepresentation() : -1;
  vtkSMPropertyHelper surfaces(this->Scene, "Surfaces", true);
  if (touched < 0 || touched >= static_cast<int>(surfaces.GetNumberOfElements()))
  {
    return nullptr;
  }
  vtkSMPropertyHelper input(surfaces.GetAsProxy(touched), "Input", true);
  auto* source =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
      input.GetAsProxy());
  return source ? source->getOutputPort(static_cast<int>(input.GetOutputPort())) : nullptr;
}

QString pqHapticsManager::whyNotTouch() const
{
  if (!qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView()))
  {
    return "The active view shows no surface that could be touched. Click into a render view, or "
           "make one.";
  }
  const QList<pqOutputPort*> ports = selectedPorts();
  if (ports.isEmpty())
  {
    return "No source is selected. Select one in the pipeline browser.";
  }
  for (pqOutputPort* port : ports)
  {
    pqPipelineSource* source = port->getSource();
    if (source->modifiedState() == pqProxy::UNINITIALIZED)
    {
      return source->getSMName() + " has not been computed yet. Press Apply.";
    }
    vtkPVDataInformation* data = port->getDataInformation();
    if (data->DataSetTypeIsA("vtkTable") || data->DataSetTypeIsA("vtkGraph"))
    {
      return source->getSMName() + " is no surface. Select a source of surfaces or volumes.";
    }
    if (source->getProxy()->GetXMLName() == std::string("HapticRecord"))
    {
      return source->getSMName() +
        " is what a hand has left: it has no surface. Select another "
        "source.";
    }
  }
  return QString();
}

bool pqHapticsManager::isTouchingSelection() const
{
  const QList<pqOutputPort*> ports = selectedPorts();
  return this->Engaged && this->View &&
    std::all_of(ports.begin(), ports.end(),
      [this](pqOutputPort* port)
      {
        pqDataRepresentation* shown = port->getRepresentation(this->View);
        return shown && isHaptic(shown->getProxy());
      });
}

void pqHapticsManager::findScene()
{
  pqServer* server = pqActiveObjects::instance().activeServer();
  vtkSMProxy* found = nullptr;
  if (server)
  {
    vtkSMSessionProxyManager* proxies = server->proxyManager();
    if (const char* name = proxies->GetProxyName(Group, 0u))
    {
      found = proxies->GetProxy(Group, name);
    }
  }
  this->adoptScene(found);
  // Until there is a scene the panel shows what it will begin with.
  vtkSMProxy* begin = this->values();
  if (begin && begin != this->Scene && begin != this->Begin)
  {
    this->Begin = begin;
    pqCoreUtilities::connect(
      begin, vtkCommand::PropertyModifiedEvent, this, SIGNAL(sceneChanged()));
    emit this->sceneChanged(); // there was no server before that had them
  }
}

void pqHapticsManager::adoptScene(vtkSMProxy* proxy)
{
  if (proxy != this->Scene)
  {
    this->Scene = proxy;
    this->Landmarks = this->numberOfLandmarks();
    emit this->sceneChanged();
    this->noticeState();
  }
}

vtkSMProxy* pqHapticsManager::makeScene()
{
  pqServer* server = pqActiveObjects::instance().activeServer();
  if (this->Scene || !server)
  {
    return this->Scene;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkSMSessionProxyManager* proxies = server->proxyManager();
  vtkSmartPointer<vtkSMProxy> scene;
  scene.TakeReference(proxies->NewProxy(Group, "HapticScene"));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->InitializeProxy(scene);
  const QString device = this->device();
  vtkSMProxy* begin = this->values();
  if (begin && begin->GetXMLGroup() == std::string("settings"))
  {
    vtkSMHapticSceneProxy::SafeDownCast(scene)->TakeSettings(begin);
  }
  vtkSMPropertyHelper(scene, "Device").Set(device.toUtf8().data());
  scene->UpdateVTKObjects();
  proxies->RegisterProxy(Group, "HapticScene", scene); // findScene() takes it from here
  return this->Scene;
}

QString pqHapticsManager::device() const
{
  if (this->Scene)
  {
    return vtkSMPropertyHelper(this->Scene, "Device").GetAsString();
  }
  vtkSMProxy* begin = this->values();
  const bool isChosen = begin && begin->GetXMLGroup() == std::string("settings");
  const QString chosen = isChosen ? vtkSMPropertyHelper(begin, "Device").GetAsString() : "";
  return !chosen.isEmpty()
    ? chosen
    : pqApplicationCore::instance()->settings()->value(DeviceSetting, "mouse").toString();
}

void pqHapticsManager::setDevice(const QString& device)
{
  if (vtkSMProxy* scene = this->makeScene())
  {
    this->setEngaged(false);
    if (device == this->Recorder->file())
    {
      this->Recorder->setFile(QString()); // played, it is not to be written over
    }
    SCOPED_UNDO_SET("Haptic Device");
    vtkSMPropertyHelper(scene, "Device").Set(device.toUtf8().data());
    scene->UpdateVTKObjects();
    pqApplicationCore::instance()->settings()->setValue(DeviceSetting, device);
    emit this->updated();
  }
}

void pqHapticsManager::touch()
{
  const QString title = "Touch";
  const QString reason = this->whyNotTouch();
  if (!reason.isEmpty())
  {
    this->complain(title, reason);
    return;
  }
  pqView* view = pqActiveObjects::instance().activeView();
  const QList<pqOutputPort*> ports = selectedPorts();
  SCOPED_UNDO_SET(title);
  bool isDrawn = !view->getViewProxy()->GetNeedsUpdate();
  for (pqOutputPort* port : ports)
  {
    pqDataRepresentation* before = port->getRepresentation(view);
    const QString type = before && before->isVisible() ? typeOf(before->getProxy()) : QString();
    QString problem;
    if (!this->show(port, view, problem))
    {
      this->complain(title, problem);
      return;
    }
    isDrawn = isDrawn && type == typeOf(port->getRepresentation(view)->getProxy());
  }
  const bool isAdded = this->Engaged && view == this->View;
  this->engage(title, !isAdded, isDrawn);
}

bool pqHapticsManager::show(pqOutputPort* port, pqView* view, QString& problem)
{
  pqPipelineSource* source = port->getSource();
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  vtkSMProxy* representation =
    controller->Show(source->getSourceProxy(), port->getPortNumber(), view->getViewProxy());
  if (!representation || !representation->GetProperty("Touchable"))
  {
    problem = source->getSMName() +
      " has no surface that could be touched. Extract one, with Extract Surface or Contour for "
      "example, select that, and press Touch again.";
    return false;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
  vtkSMPropertyHelper(representation, "Touchable").Set(1);
  // An outline hides what is touched.
  const std::string type = vtkSMPropertyHelper(representation, "Representation").GetAsString();
  unsigned int index = 0;
  auto types = representation->GetProperty("Representation")->FindDomain<vtkSMStringListDomain>();
  if (type == "Outline" && types && types->IsInDomain("Surface", index))
  {
    vtkSMRepresentationProxy::SetRepresentationType(representation, "Surface");
  }
  representation->UpdateVTKObjects();
  return true;
}

/// `isDrawn`: the view shows all that is to be seen, but for the hand.
void pqHapticsManager::engage(const QString& title, bool anew, bool isDrawn)
{
  vtkSMProxy* scene = this->makeScene();
  if (!scene)
  {
    this->complain(title, "There is no connection to a server. Connect to one first.");
    return;
  }
  this->followActiveView();
  if (this->followSurfaces() == 0)
  {
    this->complain(
      title, "The active view shows nothing that can be touched. Select a source and press Touch.");
    return;
  }
  this->bringSurfaces(isDrawn);
  if (anew)
  {
    this->setForNow("Engaged", 0);
  }
  if (!anew || this->clientScene()->Fit())
  {
    this->setForNow("Engaged", 1);
    this->focusView();
  }
  this->Asked = title;
  // The first picture of a hand takes a while: that it is on its way is shown before.
  if (this->look() && !this->Timer.isActive())
  {
    this->draw();
  }
}

/// From other processes surfaces come to the client with a render; within one it takes none, which
/// may last long.
void pqHapticsManager::bringSurfaces(bool isDrawn)
{
  if (this->View->getServer()->isRemote())
  {
    this->View->forceRender();
    return;
  }
  this->View->getViewProxy()->Update();
  if (!isDrawn)
  {
    this->View->render();
  }
}

QWidget* pqHapticsManager::viewWidget() const
{
  auto* container = this->View ? qobject_cast<pqQVTKWidget*>(this->View->widget()) : nullptr;
  return container ? container->renderWidget() : nullptr;
}

/// Keys go to where the hand is.
void pqHapticsManager::focusView()
{
  if (QWidget* widget = this->viewWidget())
  {
    widget->activateWindow(); // a panel may be a window of its own
    widget->setFocus(Qt::OtherFocusReason);
  }
}

/// Draws the hand in each view where what is shown of it is outdated: over the rest of the picture,
/// else with that. Data that changed are drawn in full.
void pqHapticsManager::draw()
{
  vtkPVHapticScene* scene = this->clientScene();
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqRenderView* shown : model->findItems<pqRenderView*>())
  {
    vtkSMViewProxy* view = shown->getViewProxy();
    auto* drawn = vtkPVRenderView::SafeDownCast(view->GetClientSideObject());
    if (!scene->GetPicture()->IsOutdated(drawn))
    {
      continue;
    }
    if (view->GetNeedsUpdate())
    {
      shown->render(); // asks for one: many of them become one
    }
    else if (!scene->GetPicture()->DrawHand(drawn))
    {
      this->drawAll(view);
    }
  }
}

/// At ParaView's level of detail while the hand moves.
void pqHapticsManager::drawAll(vtkSMViewProxy* view)
{
  // Where pictures take long, other events have as much time as they.
  if (this->Drawn.isValid() && this->Drawn.elapsed() < this->DrawingTime)
  {
    return; // the scene asks again
  }
  this->Drawn.start();
  view->InteractiveRender();
  this->DrawingTime = this->Drawn.restart();
  auto* drawn = vtkPVRenderView::SafeDownCast(view->GetClientSideObject());
  if (drawn && drawn->GetUsedLODForLastRender())
  {
    this->Resting.start();
  }
}

/// What was asked for fails at once where there is no device, and when all surfaces are built where
/// none of them can be touched.
void pqHapticsManager::proveAsked()
{
  vtkPVHapticScene* scene = this->clientScene();
  const QString message = scene ? scene->GetMessage() : "";
  const bool failed = scene && !scene->GetEngaged() && !message.isEmpty();
  if (this->Asked.isEmpty() || (scene && scene->GetBuilding() && !failed))
  {
    return;
  }
  const QString title = this->Asked;
  this->Asked.clear();
  if (failed || !this->hasWork() || scene->GetNumberOfTouchableSurfaces() == 0)
  {
    const QString problem = failed || !scene ? message : QString(this->hand()->GetErrorMessage());
    this->setEngaged(false);
    this->complain(title,
      problem.isEmpty() ? QString("What is shown cannot be touched just now: it is hidden, or its "
                                  "preparation was given up.")
                        : problem);
  }
}

void pqHapticsManager::setEngaged(bool engaged)
{
  if (engaged)
  {
    pqView* view = this->View ? +this->View : pqActiveObjects::instance().activeView();
    this->engage("Engage", false, view && !view->getViewProxy()->GetNeedsUpdate());
  }
  else if (this->Scene)
  {
    this->Asked.clear();
    this->setForNow("Engaged", 0);
    this->poll();
  }
}

bool pqHapticsManager::followActiveView()
{
  pqView* active = pqActiveObjects::instance().activeView();
  if (!this->Scene || !qobject_cast<pqRenderView*>(active))
  {
    return false;
  }
  // An undo takes the view from the scene, too.
  if (active == this->View &&
    vtkSMPropertyHelper(this->Scene, "View").GetAsProxy() == active->getProxy())
  {
    return false;
  }
  const QList<pqRepresentation*> shown = active->getRepresentations();
  const bool canBeTouched = std::any_of(shown.begin(), shown.end(),
    [](pqRepresentation* representation) { return isHaptic(representation->getProxy()); });
  if (!canBeTouched && this->Engaged)
  {
    return false; // an engaged hand stays where it can touch something
  }
  SCOPED_UNDO_EXCLUDE();
  this->View = active;
  vtkSMPropertyHelper(this->Scene, "View").Set(active->getProxy());
  this->Scene->UpdateVTKObjects();
  return this->Engaged;
}

int pqHapticsManager::followSurfaces()
{
  std::vector<vtkSMProxy*> wanted;
  const QList<pqRepresentation*> shown =
    this->View ? this->View->getRepresentations() : QList<pqRepresentation*>();
  for (pqRepresentation* representation : shown)
  {
    if (isHaptic(representation->getProxy()))
    {
      wanted.push_back(representation->getProxy());
    }
  }
  vtkSMPropertyHelper surfaces(this->Scene, "Surfaces");
  const auto count = static_cast<unsigned int>(wanted.size());
  bool same = surfaces.GetNumberOfElements() == count;
  for (unsigned int i = 0; same && i < count; ++i)
  {
    same = surfaces.GetAsProxy(i) == wanted[i];
  }
  if (!same)
  {
    SCOPED_UNDO_EXCLUDE();
    surfaces.Set(wanted.data(), count);
    this->Scene->UpdateVTKObjects();
    emit this->choiceChanged(); // by an undo, too, the selection is touched or not
  }
  return static_cast<int>(count);
}

void pqHapticsManager::set(const char* what, const char* property, double value)
{
  if (vtkSMProxy* scene = this->makeScene())
  {
    SCOPED_UNDO_SET(what);
    vtkSMPropertyHelper(scene, property).Set(value);
    scene->UpdateVTKObjects();
    this->poll();
  }
}

void pqHapticsManager::setForNow(const char* property, int value)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(this->Scene, property).Set(value);
  this->Scene->UpdateVTKObjects();
}

void pqHapticsManager::fit()
{
  this->command("Fit");
}

void pqHapticsManager::command(const char* property)
{
  if (this->Scene)
  {
    this->Scene->InvokeCommand(property);
    this->poll();
  }
}

void pqHapticsManager::redraw()
{
  vtkPVHapticScene* scene = this->clientScene();
  vtkPVHapticPicture* picture = scene ? scene->GetPicture() : nullptr;
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqRenderView* shown : model->findItems<pqRenderView*>())
  {
    vtkSMViewProxy* view = shown->getViewProxy();
    auto* drawn = vtkPVRenderView::SafeDownCast(view->GetClientSideObject());
    if (picture && picture->IsShownIn(drawn) &&
      (view->GetNeedsUpdate() || !picture->DrawHand(drawn)))
    {
      shown->render();
    }
  }
}

void pqHapticsManager::poll()
{
  if (this->look())
  {
    this->draw();
  }
}

/// Takes in what has changed. Whether a picture is outdated by it.
bool pqHapticsManager::look()
{
  bool isOutdated = false;
  vtkPVHapticScene* scene = this->clientScene();
  const bool busy = this->View && this->View->getServer()->isProgressPending();
  if (scene && !busy) // a pipeline that is being computed is looked at when it is done
  {
    if (this->followActiveView())
    {
      this->engage("Touch", true, false); // another view releases the hand
      return false;
    }
    this->followSurfaces();
    isOutdated = scene->Update();
    this->keepLandmarks();
  }
  this->noticeState();
  this->proveAsked();
  emit this->updated();
  return isOutdated;
}

int pqHapticsManager::numberOfLandmarks() const
{
  vtkPVHapticScene* scene = this->clientScene();
  return scene ? scene->GetRecords()->GetNumberOfLandmarks() : 0;
}

/// Whether dropped by a key or by the device: what has come or gone, undo takes back.
void pqHapticsManager::keepLandmarks()
{
  const int before = std::exchange(this->Landmarks, this->numberOfLandmarks());
  if (this->Landmarks != before)
  {
    SCOPED_UNDO_SET("Haptic Landmarks");
    this->Scene->UpdateVTKObjects(); // the proxy asks for them
  }
}

/// Whether anything can change by itself, so that the scene is to be looked at again.
bool pqHapticsManager::hasWork() const
{
  vtkPVHapticScene* scene = this->clientScene();
  vtkHapticDevice* device = scene ? scene->GetScene()->GetDevice() : nullptr;
  const int state = device ? device->GetState() : vtkHapticDevice::Closed;
  const bool opening = state != vtkHapticDevice::Closed && state != vtkHapticDevice::Ready &&
    state != vtkHapticDevice::Faulted;
  return scene && (scene->GetEngaged() || scene->GetBuilding() || opening);
}

void pqHapticsManager::noticeState()
{
  vtkPVHapticScene* scene = this->clientScene();
  const bool engaged = scene && scene->GetEngaged();
  if (!this->hasWork())
  {
    this->Timer.stop();
    if (this->Scene && vtkSMPropertyHelper(this->Scene, "Engaged").GetAsInt() != 0)
    {
      this->setForNow("Engaged", 0);
    }
  }
  else if (!this->Timer.isActive())
  {
    this->Timer.start();
  }
  if (engaged != this->Engaged)
  {
    this->Engaged = engaged;
    if (!engaged)
    {
      this->redraw(); // without the hand, however lately it was drawn
    }
    emit this->engagedChanged(engaged);
  }
}

void pqHapticsManager::complain(const QString& title, const QString& message)
{
  auto* box = new QMessageBox(
    QMessageBox::Warning, title, message, QMessageBox::Ok, pqCoreUtilities::mainWidget());
  box->setObjectName("HapticsComplaint");
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}
