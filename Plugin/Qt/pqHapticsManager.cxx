#include "pqHapticsManager.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerObserver.h"
#include "pqSettings.h"
#include "pqUndoStack.h"
#include "vtkHapticDevice.h"
#include "vtkHapticScene.h"
#include "vtkNew.h"
#include "vtkPVHapticScene.h"
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
#include <vector>

namespace
{
constexpr const char* Group = "haptics";
constexpr const char* HapticSurface = "Haptic Surface";
constexpr const char* DeviceSetting = "Haptics/Device";

/// Whether a representation is of the type that can be touched.
bool isHaptic(vtkSMProxy* representation)
{
  return representation && representation->GetProperty("Representation") &&
    HapticSurface ==
    std::string(vtkSMPropertyHelper(representation, "Representation").GetAsString());
}

/// What an engaged hand does is no edit of the user's: there is nothing to undo.
void set(vtkSMProxy* scene, const char* property, int value)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(scene, property).Set(value);
  scene->UpdateVTKObjects();
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
{
  this->setObjectName("HapticsManager");
  this->Timer.setObjectName("HapticsTimer");
  this->Timer.setInterval(1000 / MaximumRate + 1);
  this->connect(&this->Timer, &QTimer::timeout, this, &pqHapticsManager::poll);

  // No force stays on a device whose program ends.
  this->connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, this,
    [this] { this->setEngaged(false); });

  // A state file or a script may bring a scene, or take it away.
  pqServerManagerObserver* observer = pqApplicationCore::instance()->getServerManagerObserver();
  const auto look = [this](const QString& group)
  {
    if (group == Group)
    {
      this->findScene();
    }
  };
  using Registered = QOverload<const QString&, const QString&, vtkSMProxy*>;
  this->connect(observer, Registered::of(&pqServerManagerObserver::proxyRegistered), this, look);
  this->connect(observer, Registered::of(&pqServerManagerObserver::proxyUnRegistered), this, look);
  this->connect(&pqActiveObjects::instance(), &pqActiveObjects::serverChanged, this,
    [this](pqServer*) { this->findScene(); });
  this->findScene();
}

vtkSMProxy* pqHapticsManager::scene() const
{
  return this->Scene;
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
}

void pqHapticsManager::adoptScene(vtkSMProxy* proxy)
{
  if (proxy != this->Scene)
  {
    this->Scene = proxy;
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
  vtkSMPropertyHelper(scene, "Device").Set(this->device().toUtf8().data());
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
  return pqApplicationCore::instance()->settings()->value(DeviceSetting, "mouse").toString();
}

void pqHapticsManager::setDevice(const QString& device)
{
  if (vtkSMProxy* scene = this->makeScene())
  {
    this->setEngaged(false);
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
  pqView* view = pqActiveObjects::instance().activeView();
  if (!qobject_cast<pqRenderView*>(view))
  {
    this->complain(title,
      "The active view shows no surface that could be touched. Click into a render view, or make "
      "one, and press Touch again.");
    return;
  }
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
  if (ports.isEmpty())
  {
    this->complain(
      title, "No source is selected. Select one in the pipeline browser and press Touch again.");
    return;
  }
  SCOPED_UNDO_SET(title);
  for (pqOutputPort* port : ports)
  {
    QString problem;
    if (!this->show(port, view, problem))
    {
      this->complain(title, problem);
      return;
    }
  }
  this->engage(title, true);
}

bool pqHapticsManager::show(pqOutputPort* port, pqView* view, QString& problem)
{
  pqPipelineSource* source = port->getSource();
  const QString name = source->getSMName();
  if (source->modifiedState() == pqProxy::UNINITIALIZED)
  {
    problem = name + " has not been computed yet. Press Apply, then Touch.";
    return false;
  }
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  vtkSMProxy* representation =
    controller->Show(source->getSourceProxy(), port->getPortNumber(), view->getViewProxy());
  vtkSMProperty* type = representation ? representation->GetProperty("Representation") : nullptr;
  auto types = type ? type->FindDomain<vtkSMStringListDomain>() : nullptr;
  unsigned int index = 0;
  if (!types || !types->IsInDomain(HapticSurface, index))
  {
    problem = name +
      " has no surface that could be touched. Extract one, with Extract Surface or Contour for "
      "example, select that, and press Touch again.";
    return false;
  }
  if (!isHaptic(representation))
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
    vtkSMRepresentationProxy::SetRepresentationType(representation, HapticSurface);
    representation->UpdateVTKObjects();
  }
  return true;
}

void pqHapticsManager::engage(const QString& title, bool anew)
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
    this->complain(title,
      "The active view shows nothing that can be touched. Select a source and press Touch, or "
      "choose the representation Haptic Surface for it.");
    return;
  }
  this->View->forceRender(); // surfaces come to the client with a render
  if (anew)
  {
    set(scene, "Engaged", 0);
  }
  if (!anew || this->clientScene()->Fit())
  {
    set(scene, "Engaged", 1);
  }
  this->Asked = title;
  this->poll();
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
    this->engage("Engage", false);
  }
  else if (this->Scene)
  {
    this->Asked.clear();
    set(this->Scene, "Engaged", 0);
    this->poll();
  }
}

bool pqHapticsManager::followActiveView()
{
  pqView* active = pqActiveObjects::instance().activeView();
  if (!this->Scene || !qobject_cast<pqRenderView*>(active) || active == this->View)
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
  }
  return static_cast<int>(count);
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

void pqHapticsManager::poll()
{
  vtkPVHapticScene* scene = this->clientScene();
  const bool busy = this->View && this->View->getServer()->isProgressPending();
  if (scene && !busy) // a pipeline that is being computed is looked at when it is done
  {
    if (this->followActiveView())
    {
      this->engage("Touch", true); // another view releases the hand
      return;
    }
    this->followSurfaces();
    if (scene->Update() && this->View)
    {
      this->View->render(); // asks for one: many of them become one
    }
  }
  this->noticeState();
  this->proveAsked();
  emit this->updated();
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
      set(this->Scene, "Engaged", 0);
    }
  }
  else if (!this->Timer.isActive())
  {
    this->Timer.start();
  }
  if (engaged != this->Engaged)
  {
    this->Engaged = engaged;
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
