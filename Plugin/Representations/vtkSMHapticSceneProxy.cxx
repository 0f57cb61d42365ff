#include "vtkSMHapticSceneProxy.h"

#include "PythonStates.h"
#include "vtkCollection.h"
#include "vtkCommand.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticScene.h"
#include "vtkHapticSurfaceRepresentation.h"
#include "vtkObjectFactory.h"
#include "vtkPVHapticPicture.h"
#include "vtkPVHapticRecords.h"
#include "vtkPVHapticScene.h"
#include "vtkPVHapticWorkspace.h"
#include "vtkPVSession.h"
#include "vtkPVXMLElement.h"
#include "vtkSMDoubleVectorProperty.h"
#include "vtkSMIntVectorProperty.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMSession.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkSMHapticSceneProxy);

namespace
{
/// The properties that vtkHapticSettings has too.
constexpr const char* SettingNames[] = { "Device", "Stiffness", "MaximumForce", "Side", "ShowForce",
  "ShowReadout", "ShowTrail", "ShowHand", "HandSize" };

constexpr const char* Landmarks = "LandmarkContents";
}

vtkSMHapticSceneProxy::vtkSMHapticSceneProxy()
{
  this->AddObserver(
    vtkCommand::PropertyModifiedEvent, this, &vtkSMHapticSceneProxy::OnPropertyModified);
}

vtkSMHapticSceneProxy::~vtkSMHapticSceneProxy() = default;

vtkPVHapticScene* vtkSMHapticSceneProxy::GetScene()
{
  return this->ObjectsCreated ? vtkPVHapticScene::SafeDownCast(this->GetClientSideObject())
                              : nullptr;
}

void vtkSMHapticSceneProxy::CreateVTKObjects()
{
  const bool first = !this->ObjectsCreated;
  this->Superclass::CreateVTKObjects();
  if (first && this->ObjectsCreated)
  {
    haptics::ExtendPython();
    this->GetScene()->SetInPieces(
      this->GetSession()->GetNumberOfProcesses(vtkPVSession::DATA_SERVER) > 1);
    // VTK drops these observers when this object goes.
    this->GetSessionProxyManager()->AddObserver(
      vtkCommand::UnRegisterEvent, this, &vtkSMHapticSceneProxy::OnUnregistered);
    this->GetSessionProxyManager()->AddObserver(
      vtkCommand::RegisterEvent, this, &vtkSMHapticSceneProxy::OnRegistered);
    auto views = vtkSmartPointer<vtkCollection>::New();
    this->GetSessionProxyManager()->GetProxies("views", views);
    for (int i = 0; i < views->GetNumberOfItems(); ++i)
    {
      this->FollowView(vtkSMProxy::SafeDownCast(views->GetItemAsObject(i)));
    }
    this->GetSession()->AddObserver(
      vtkPVSessionBase::ConnectionLost, this, &vtkSMHapticSceneProxy::OnConnectionLost);
  }
}

void vtkSMHapticSceneProxy::OnUnregistered(vtkObject*, unsigned long, void* information)
{
  auto* gone = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(information)->Proxy;
  bool concerned = false;
  for (const char* name : { "View", "Surfaces" })
  {
    vtkSMPropertyHelper held(this, name);
    for (unsigned int i = held.GetNumberOfElements(); gone && i > 0; --i)
    {
      if (held.GetAsProxy(i - 1) == gone)
      {
        held.Remove(gone);
        concerned = true;
      }
    }
  }
  if (concerned)
  {
    this->Untraced.clear(); // replaying the deletion does the same
    this->Superclass::UpdateVTKObjects();
    this->GetScene()->Update(); // the force goes now, not when somebody asks next
  }
}

void vtkSMHapticSceneProxy::FollowView(vtkSMProxy* proxy)
{
  const bool isFollowed = std::find(this->Views.begin(), this->Views.end(), proxy) != Views.end();
  if (vtkSMViewProxy::SafeDownCast(proxy) && !isFollowed)
  {
    this->Views.emplace_back(proxy);
    proxy->AddObserver(vtkCommand::StartEvent, this, &vtkSMHapticSceneProxy::OnViewStart);
  }
}

/// Before a view is rendered, by whomever: also for a screenshot, or a frame of an animation.
void vtkSMHapticSceneProxy::OnViewStart(vtkObject* caller, unsigned long, void*)
{
  vtkPVHapticScene* scene = this->GetScene();
  if (scene && scene->GetEngaged())
  {
    scene->Update();
  }
  this->ShowHandIn(vtkSMProxy::SafeDownCast(caller));
}

void vtkSMHapticSceneProxy::ShowHandIn(vtkSMProxy* view)
{
  vtkPVHapticScene* const scene = this->GetScene();
  vtkSMProperty* const property = view ? view->GetProperty("Representations") : nullptr;
  if (!scene || !property)
  {
    return;
  }
  const auto inputOf = [](vtkSMProxy* representation)
  {
    vtkSMProperty* const input = representation ? representation->GetProperty("Input") : nullptr;
    return input ? std::make_pair(vtkSMPropertyHelper(input).GetAsProxy(),
                     vtkSMPropertyHelper(input).GetOutputPort())
                 : std::make_pair(static_cast<vtkSMProxy*>(nullptr), 0u);
  };
  std::set<std::pair<vtkSMProxy*, unsigned int>> touched;
  vtkSMPropertyHelper surfaces(this, "Surfaces");
  for (unsigned int i = 0; i < surfaces.GetNumberOfElements(); ++i)
  {
    touched.insert(inputOf(surfaces.GetAsProxy(i)));
  }
  touched.erase({ nullptr, 0u });
  bool isShown = false;
  vtkSMPropertyHelper shown(property);
  for (unsigned int i = 0; i < shown.GetNumberOfElements() && !isShown; ++i)
  {
    vtkSMProxy* const representation = shown.GetAsProxy(i);
    isShown = touched.count(inputOf(representation)) > 0 &&
      vtkSMPropertyHelper(representation, "Visibility", true).GetAsInt() != 0;
  }
  scene->GetPicture()->ShowIn(vtkObject::SafeDownCast(view->GetClientSideObject()), isShown);
}

void vtkSMHapticSceneProxy::ShowHand()
{
  for (const vtkWeakPointer<vtkSMProxy>& view : this->Views)
  {
    this->ShowHandIn(view);
  }
}

void vtkSMHapticSceneProxy::OnConnectionLost()
{
  if (vtkPVHapticScene* scene = this->GetScene())
  {
    scene->ReleaseBecause("the connection to the server is lost");
  }
}

void vtkSMHapticSceneProxy::OnPropertyModified(vtkObject*, unsigned long, void* name)
{
  vtkSMProperty* property = name ? this->GetProperty(static_cast<const char*>(name)) : nullptr;
  if (property && property == this->GetProperty(Landmarks))
  {
    this->LandmarksTime = 0; // who has set it may be refused
  }
  // A trace would have all landmarks again with each.
  const bool isTraced =
    property && !property->GetInformationOnly() && property != this->GetProperty(Landmarks);
  if (isTraced && vtkSMTrace::GetActiveTracer())
  {
    this->Untraced.insert(static_cast<const char*>(name));
  }
}

void vtkSMHapticSceneProxy::UpdateVTKObjects()
{
  if (!this->Untraced.empty())
  {
    this->Trace();
  }
  if (this->GetScene())
  {
    this->UpdateProperty("Surfaces"); // named before anything engages
    this->NameSurfaces(nullptr, nullptr);
  }
  this->Superclass::UpdateVTKObjects();
  this->ShowHand();
  this->SyncWorkspace(); // else setting again what another device or view has undone does nothing
  this->SyncLandmarks();
}

void vtkSMHapticSceneProxy::TakeSettings(vtkSMProxy* settings)
{
  for (const char* name : SettingNames)
  {
    vtkSMProperty* chosen = settings->GetProperty(name);
    const bool isEmpty = vtkSMStringVectorProperty::SafeDownCast(chosen) &&
      *vtkSMPropertyHelper(chosen).GetAsString() == 0;
    if (!isEmpty)
    {
      this->GetProperty(name)->Copy(chosen);
    }
  }
}

/// A trace that begins now knows nothing of what was set before.
void vtkSMHapticSceneProxy::TraceFromHereOn()
{
  this->TracedTo = vtkSMTrace::GetActiveTracer();
  SM_SCOPED_TRACE(TraceText).arg("import vtkhaptics.paraview");
  for (const char* name : { "View", "Surfaces", "WorkspaceTransform" })
  {
    const bool isSet = name == std::string("WorkspaceTransform")
      ? !this->GetProperty(name)->IsValueDefault()
      : vtkSMPropertyHelper(this, name).GetNumberOfElements() > 0;
    if (isSet)
    {
      this->Untraced.insert(name);
    }
  }
  // Also where they are the defaults: another user's settings may differ.
  this->Untraced.insert(std::begin(SettingNames), std::end(SettingNames));
}

void vtkSMHapticSceneProxy::Trace()
{
  if (this->TracedTo != vtkSMTrace::GetActiveTracer())
  {
    this->TraceFromHereOn();
  }
  vtkSMTrace::TraceItemArgs values;
  vtkSMTrace::TraceItemArgs surfaces;
  values.arg("vtkhaptics.paraview.scene().set");
  surfaces.arg("vtkhaptics.paraview.scene().touch_only");
  bool hasValues = false;
  for (const std::string& name : this->Untraced)
  {
    const char* key = name.c_str();
    vtkSMProperty* property = this->GetProperty(key);
    vtkSMPropertyHelper value(property, true);
    if (value.GetNumberOfElements() == 1 && name != "Surfaces")
    {
      hasValues = true;
      if (vtkSMProxyProperty::SafeDownCast(property))
      {
        values.arg(key, value.GetAsProxy());
      }
      else if (vtkSMStringVectorProperty::SafeDownCast(property))
      {
        values.arg(key, value.GetAsString());
      }
      else if (vtkSMIntVectorProperty::SafeDownCast(property))
      {
        values.arg(key, value.GetAsInt());
      }
      else
      {
        values.arg(key, value.GetAsDouble());
      }
    }
    else if (vtkSMDoubleVectorProperty::SafeDownCast(property))
    {
      hasValues = true;
      values.arg(key, value.GetDoubleArray());
    }
    for (unsigned int i = 0; name == "Surfaces" && i < value.GetNumberOfElements(); ++i)
    {
      surfaces.arg(value.GetAsProxy(i));
    }
  }
  if (this->Untraced.count("Surfaces") > 0)
  {
    vtkSMTrace::TraceItem item("CallFunction");
    item = surfaces;
  }
  if (hasValues)
  {
    vtkSMTrace::TraceItem item("CallFunction");
    item = values;
  }
  this->Untraced.clear();
}

/// As the pipeline browser names their sources. `source`: one that just gets another `name`.
void vtkSMHapticSceneProxy::NameSurfaces(vtkSMProxy* source, const char* name)
{
  vtkPVHapticScene* const scene = this->GetScene();
  vtkSMPropertyHelper surfaces(this, "Surfaces");
  for (unsigned int i = 0; scene && i < surfaces.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* const representation = surfaces.GetAsProxy(i);
    vtkSMProxy* const shown = representation && representation->GetProperty("Input")
      ? vtkSMPropertyHelper(representation, "Input").GetAsProxy()
      : nullptr;
    const char* const its = !shown ? nullptr
      : shown == source            ? name
                                   : this->GetSessionProxyManager()->GetProxyName("sources", shown);
    // One of its choices has the property.
    vtkSMProperty* const touchable =
      representation ? representation->GetProperty("Touchable") : nullptr;
    vtkSMProxy* const haptic = touchable ? touchable->GetParent() : nullptr;
    if (its)
    {
      scene->SetSurfaceSource(vtkObject::SafeDownCast(representation->GetClientSideObject()), its,
        haptic ? vtkHapticSurfaceRepresentation::SafeDownCast(haptic->GetClientSideObject())
               : nullptr);
    }
  }
}

void vtkSMHapticSceneProxy::OnRegistered(vtkObject*, unsigned long, void* information)
{
  const auto* given = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(information);
  const std::string group = given->Proxy && given->GroupName ? given->GroupName : "";
  if (group == "sources")
  {
    this->NameSurfaces(given->Proxy, given->ProxyName);
  }
  else if (group == "views")
  {
    this->FollowView(given->Proxy);
  }
  else if (group == this->GetXMLGroup() && given->Proxy != this)
  {
    this->GiveWay();
  }
}

/// There is one hand a session: a scene that a state brings is the session's from then on.
void vtkSMHapticSceneProxy::GiveWay()
{
  const vtkSmartPointer<vtkSMHapticSceneProxy> self = this; // while it is unregistered
  vtkSMSessionProxyManager* const proxies = this->GetSessionProxyManager();
  this->GetScene()->SetEngaged(false);
  while (const char* name = proxies->GetProxyName(this->GetXMLGroup(), this))
  {
    proxies->UnRegisterProxy(this->GetXMLGroup(), std::string(name).c_str(), this);
  }
}

void vtkSMHapticSceneProxy::UpdatePropertyInformation()
{
  this->SyncWorkspace();
  this->SyncLandmarks();
  this->Superclass::UpdatePropertyInformation();
}

/// Of one alone: to make a text of all landmarks takes a while.
void vtkSMHapticSceneProxy::UpdatePropertyInformation(vtkSMProperty* property)
{
  if (property && property == this->GetProperty("WorkspaceTransform"))
  {
    this->SyncWorkspace();
  }
  else if (property && property == this->GetProperty(Landmarks))
  {
    this->SyncLandmarks();
  }
  else
  {
    this->Superclass::UpdatePropertyInformation(property);
  }
}

/// Fit(), the clutch, another device or view change the transform without this proxy's doing.
void vtkSMHapticSceneProxy::SyncWorkspace()
{
  if (vtkPVHapticScene* scene = this->GetScene())
  {
    double matrix[16];
    scene->GetWorkspace()->GetTransform(matrix);
    vtkSMPropertyHelper(this, "WorkspaceTransform").Set(matrix, 16);
    this->UpdateProperty("WorkspaceTransform"); // it is in force already
  }
}

/// They are dropped by commands, and by the device's button.
void vtkSMHapticSceneProxy::SyncLandmarks()
{
  vtkPVHapticScene* const scene = this->GetScene();
  vtkHapticLandmarks* const landmarks = scene ? scene->GetScene()->GetLandmarks() : nullptr;
  if (landmarks && this->LandmarksTime != landmarks->GetMTime())
  {
    const std::string contents = scene->GetRecords()->GetLandmarkContents();
    vtkSMPropertyHelper(this, Landmarks).Set(contents.c_str());
    this->UpdateProperty(Landmarks); // they are there already
    this->LandmarksTime = landmarks->GetMTime();
  }
}

vtkPVXMLElement* vtkSMHapticSceneProxy::SaveXMLState(
  vtkPVXMLElement* root, vtkSMPropertyIterator* iterator)
{
  this->SyncWorkspace();
  this->SyncLandmarks();
  vtkPVXMLElement* saved = this->Superclass::SaveXMLState(root, iterator);
  // What the hand does just now is no part of a state: above all nothing engages by being loaded.
  for (unsigned int i = saved ? saved->GetNumberOfNestedElements() : 0; i > 0; --i)
  {
    vtkPVXMLElement* element = saved->GetNestedElement(i - 1);
    vtkSMProperty* property = this->GetProperty(element->GetAttributeOrEmpty("name"));
    if (property && (property->GetInformationOnly() || property->IsStateIgnored()))
    {
      saved->RemoveNestedElement(element);
    }
  }
  return saved;
}

void vtkSMHapticSceneProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
