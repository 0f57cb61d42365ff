#include "vtkSMHapticSurfaceRepresentationProxy.h"

#include "vtkCollection.h"
#include "vtkCommand.h"
#include "vtkHapticPatchInformation.h"
#include "vtkHapticSurfaceRepresentation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkPVXMLElement.h"
#include "vtkPVXMLParser.h"
#include "vtkSMDoubleVectorProperty.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxyListDomain.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMSession.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMVectorProperty.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstring>
#include <sstream>

vtkStandardNewMacro(vtkSMHapticSurfaceRepresentationProxy);

namespace
{
constexpr int Digits = 17; // that a double needs

/// The properties that are the material, by name: those of the representation that begin with
/// Haptic, and all of its parts.
std::vector<std::string> NamesOf(vtkSMProxy* proxy)
{
  const bool isPart = !vtkSMRepresentationProxy::SafeDownCast(proxy);
  std::vector<std::string> names;
  const auto all = vtkSmartPointer<vtkSMPropertyIterator>::Take(proxy->NewPropertyIterator());
  for (all->Begin(); !all->IsAtEnd(); all->Next())
  {
    vtkSMProperty* const property = all->GetProperty();
    const bool isSet = !property->GetInformationOnly() && !property->GetIsInternal();
    if (isSet && (isPart || std::strncmp(all->GetKey(), "Haptic", 6) == 0))
    {
      names.emplace_back(all->GetKey());
    }
  }
  return names;
}

vtkSMProxy* PartOf(vtkSMProxy* proxy, const std::string& name)
{
  vtkSMProperty* const property = proxy->GetProperty(name.c_str());
  return vtkSMProxyProperty::SafeDownCast(property) ? vtkSMPropertyHelper(property).GetAsProxy()
                                                    : nullptr;
}

/// What the properties and those of their parts have, as <Property name><Element value/></Property>
/// and <Part name>...</Part>.
void Save(vtkSMProxy* proxy, vtkPVXMLElement* to)
{
  for (const std::string& name : NamesOf(proxy))
  {
    vtkSMProperty* const property = proxy->GetProperty(name.c_str());
    vtkNew<vtkPVXMLElement> saved;
    saved->AddAttribute("name", name.c_str());
    if (vtkSMProxy* part = PartOf(proxy, name))
    {
      saved->SetName("Part");
      Save(part, saved);
      to->AddNestedElement(saved);
    }
    else if (vtkSMVectorProperty::SafeDownCast(property))
    {
      saved->SetName("Property");
      const vtkSMPropertyHelper values(property);
      for (unsigned int i = 0; i < values.GetNumberOfElements(); ++i)
      {
        vtkNew<vtkPVXMLElement> element;
        element->SetName("Element");
        if (vtkSMStringVectorProperty::SafeDownCast(property))
        {
          element->AddAttribute("value", values.GetAsString(i));
        }
        else
        {
          element->AddAttribute("value", values.GetAsDouble(i), Digits);
        }
        saved->AddNestedElement(element);
      }
      to->AddNestedElement(saved);
    }
  }
}

void Load(vtkSMProxy* proxy, vtkPVXMLElement* from)
{
  for (unsigned int i = 0; i < from->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* const saved = from->GetNestedElement(i);
    const std::string name = saved->GetAttributeOrEmpty("name");
    vtkSMProperty* const property = proxy->GetProperty(name.c_str());
    if (vtkSMProxy* part = property ? PartOf(proxy, name) : nullptr)
    {
      Load(part, saved);
    }
    else if (vtkSMVectorProperty::SafeDownCast(property))
    {
      vtkSMPropertyHelper values(property);
      values.SetNumberOfElements(saved->GetNumberOfNestedElements());
      for (unsigned int k = 0; k < saved->GetNumberOfNestedElements(); ++k)
      {
        vtkPVXMLElement* const element = saved->GetNestedElement(k);
        double number = 0.0;
        if (vtkSMStringVectorProperty::SafeDownCast(property))
        {
          values.Set(k, element->GetAttributeOrEmpty("value"));
        }
        else if (element->GetScalarAttribute("value", &number) != 0)
        {
          vtkSMDoubleVectorProperty::SafeDownCast(property)
            ? values.Set(k, number)
            : values.Set(k, static_cast<int>(number));
        }
      }
    }
  }
}

/// A proxy's parts, theirs, and so on, each after its own.
void CollectParts(vtkSMProxy* proxy, std::vector<vtkSMProxy*>& parts)
{
  for (const std::string& name : NamesOf(proxy))
  {
    if (vtkSMProxy* part = PartOf(proxy, name))
    {
      CollectParts(part, parts);
      parts.push_back(part);
    }
  }
}

/// As ParaView registers what a property of `owner` has, so that state files have it.
void Register(vtkSMProxy* part, const std::string& name, vtkSMProxy* owner)
{
  if (part)
  {
    part->GetSessionProxyManager()->RegisterProxy(
      vtkSMParaViewPipelineController::GetHelperProxyGroupName(owner).c_str(), name.c_str(), part);
  }
}

/// Where undo makes proxies anew, nobody makes those that the domains of their properties propose,
/// as vtkSMParaViewPipelineController does otherwise. `owner` has the proxy's properties for
/// ParaView. Whether any was missing.
bool RestoreParts(vtkSMProxy* proxy, vtkSMProxy* owner)
{
  bool wasMissing = false;
  for (const std::string& name : NamesOf(proxy))
  {
    vtkSMProperty* const property = proxy->GetProperty(name.c_str());
    auto* const domain = property->FindDomain<vtkSMProxyListDomain>();
    if (domain && domain->GetNumberOfProxies() == 0 && !PartOf(proxy, name))
    {
      domain->CreateProxies(proxy->GetSessionProxyManager());
      vtkSMProxy* const part = domain->GetNumberOfProxies() > 0 ? domain->GetProxy(0) : nullptr;
      vtkNew<vtkSMParaViewPipelineController> controller;
      if (part && controller->InitializeProxy(part))
      {
        wasMissing = true;
        vtkSMPropertyHelper(property).Set(part);
        Register(part, name, owner);
        for (const std::string& inner : NamesOf(part))
        {
          Register(PartOf(part, inner), inner, part);
        }
      }
    }
    if (vtkSMProxy* part = PartOf(proxy, name))
    {
      if (RestoreParts(part, part))
      {
        part->UpdateVTKObjects();
      }
    }
  }
  return wasMissing;
}

bool IsDefault(vtkSMProxy* proxy)
{
  std::vector<vtkSMProxy*> all;
  CollectParts(proxy, all);
  all.push_back(proxy);
  return std::all_of(all.begin(), all.end(),
    [](vtkSMProxy* one)
    {
      const std::vector<std::string> names = NamesOf(one);
      return std::all_of(names.begin(), names.end(),
        [one](const std::string& name)
        {
          vtkSMProperty* const property = one->GetProperty(name.c_str());
          return !vtkSMVectorProperty::SafeDownCast(property) || property->IsValueDefault();
        });
    });
}
}

vtkSMHapticSurfaceRepresentationProxy::vtkSMHapticSurfaceRepresentationProxy() = default;

vtkSMHapticSurfaceRepresentationProxy::~vtkSMHapticSurfaceRepresentationProxy() = default;

void vtkSMHapticSurfaceRepresentationProxy::CreateVTKObjects()
{
  const bool isFirst = !this->ObjectsCreated;
  this->Superclass::CreateVTKObjects();
  auto* const representation = isFirst && this->ObjectsCreated
    ? vtkHapticSurfaceRepresentation::SafeDownCast(this->GetClientSideObject())
    : nullptr;
  if (representation)
  {
    // It may outlive this proxy, and this its session.
    const vtkWeakPointer<vtkSMProxy> self = this;
    representation->SetGather(
      [self](vtkHapticPatchInformation* question)
      {
        vtkSMSession* const session = self ? self->GetSession() : nullptr;
        if (session && session->GetIsAlive())
        {
          // What it returns is false also where all is well (ParaView 5.11).
          self->GatherInformation(question, vtkPVSession::DATA_SERVER);
        }
      });
  }
}

void vtkSMHapticSurfaceRepresentationProxy::UpdateVTKObjects()
{
  this->Superclass::UpdateVTKObjects();
  if (!this->ObjectsCreated)
  {
    return;
  }
  if (RestoreParts(this, this->GetTrueParentProxy()))
  {
    this->Superclass::UpdateVTKObjects();
  }
  // They come with the defaults, which would undo what is taken over before.
  if (PartOf(this, "HapticProperties"))
  {
    this->FollowParts();
    this->FollowSource();
  }
}

void vtkSMHapticSurfaceRepresentationProxy::FollowParts()
{
  std::vector<vtkSMProxy*> parts;
  CollectParts(this, parts);
  for (vtkSMProxy* part : parts)
  {
    if (std::find(this->Parts.begin(), this->Parts.end(), part) == this->Parts.end())
    {
      this->Parts.emplace_back(part);
      part->AddObserver(
        vtkCommand::UpdateEvent, this, &vtkSMHapticSurfaceRepresentationProxy::Share);
    }
  }
}

void vtkSMHapticSurfaceRepresentationProxy::FollowSource()
{
  const vtkSMPropertyHelper input(this, "Input");
  vtkSMProxy* const source = input.GetNumberOfElements() > 0 ? input.GetAsProxy() : nullptr;
  const std::string key = "HapticMaterial" + std::to_string(source ? input.GetOutputPort() : 0);
  if (source && (source != this->Source || key != this->Key))
  {
    this->Source = source;
    this->Key = key;
    if (source->HasAnnotation(key.c_str()))
    {
      this->TakeMaterial(source->GetAnnotation(key.c_str()));
    }
  }
  this->Share();
}

std::string vtkSMHapticSurfaceRepresentationProxy::GetMaterial()
{
  vtkNew<vtkPVXMLElement> material;
  material->SetName("HapticMaterial");
  Save(this, material);
  std::ostringstream text;
  material->PrintXML(text, vtkIndent());
  return text.str();
}

void vtkSMHapticSurfaceRepresentationProxy::TakeMaterial(const std::string& material)
{
  const vtkSmartPointer<vtkPVXMLElement> saved = vtkPVXMLParser::ParseXML(material.c_str(), true);
  if (saved && material != this->GetMaterial())
  {
    Load(this, saved);
    std::vector<vtkSMProxy*> parts;
    CollectParts(this, parts);
    for (vtkSMProxy* part : parts)
    {
      part->UpdateVTKObjects();
    }
    this->UpdateVTKObjects();
  }
}

/// The source and its other representations take over what has changed here.
void vtkSMHapticSurfaceRepresentationProxy::Share()
{
  if (!this->Source)
  {
    return;
  }
  const char* const key = this->Key.c_str();
  const std::string material = this->GetMaterial();
  const bool isKnown = this->Source->HasAnnotation(key);
  if (isKnown ? material == this->Source->GetAnnotation(key) : IsDefault(this))
  {
    return;
  }
  this->Source->SetAnnotation(key, material.c_str());
  vtkNew<vtkCollection> all;
  this->GetSessionProxyManager()->GetProxies("representations", all);
  for (int i = 0; i < all->GetNumberOfItems(); ++i)
  {
    auto* const shown = vtkSMProxy::SafeDownCast(all->GetItemAsObject(i));
    vtkSMProperty* const touchable = shown->GetProperty("Touchable"); // of one of its choices
    auto* const other = touchable
      ? vtkSMHapticSurfaceRepresentationProxy::SafeDownCast(touchable->GetParent())
      : nullptr;
    if (other && other != this && other->Source == this->Source && other->Key == this->Key)
    {
      other->TakeMaterial(material);
    }
  }
}

void vtkSMHapticSurfaceRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Source: " << this->Source.Get() << "\n";
}
