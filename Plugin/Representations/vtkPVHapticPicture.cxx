#include "vtkPVHapticPicture.h"

#include "HandPicture.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticScene.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkPVHapticPicture);

class vtkPVHapticPicture::Internals
{
public:
  haptics::HandPicture Own;                                  // in the scene's own view
  std::vector<std::unique_ptr<haptics::HandPicture>> Others; // in other views
  bool IsHandShown = true;                                   // where there is one
  Hand Shown;

  /// Does the same with all pictures of the hand.
  template <class Action>
  void ForAll(Action action)
  {
    action(this->Own);
    for (const auto& picture : this->Others)
    {
      action(*picture);
    }
  }
};

vtkPVHapticPicture::vtkPVHapticPicture()
  : Internal(std::make_unique<Internals>())
{
}

vtkPVHapticPicture::~vtkPVHapticPicture() = default;

void vtkPVHapticPicture::SetScene(vtkHapticScene* scene, haptics::RepresentedSurfaces* surfaces)
{
  this->Superclass::SetScene(scene, surfaces);
  this->Internal->ForAll(
    [scene](haptics::HandPicture& picture) { picture.GetContents()->SetScene(scene); });
}

vtkHapticView* vtkPVHapticPicture::GetContents()
{
  return this->Internal->Own.GetContents();
}

void vtkPVHapticPicture::SetView(vtkPVRenderView* view)
{
  this->ShowIn(view, false); // as another one
  this->Internal->Own.SetView(view);
}

void vtkPVHapticPicture::ShowIn(vtkObject* object, bool show)
{
  Internals& self = *this->Internal;
  auto* view = vtkPVRenderView::SafeDownCast(object);
  auto& others = self.Others;
  const auto found = std::find_if(
    others.begin(), others.end(), [view](const auto& other) { return other->GetView() == view; });
  if (!view || (view == self.Own.GetView() && show) || show == (found != others.end()))
  {
    return;
  }
  if (!show)
  {
    others.erase(found);
    return;
  }
  // Looks as the first one.
  others.push_back(std::make_unique<haptics::HandPicture>());
  vtkHapticView* const first = self.Own.GetContents();
  vtkHapticView* const added = others.back()->GetContents();
  added->SetScene(this->Scene);
  added->GetOverlay()->SetShowForce(first->GetOverlay()->GetShowForce());
  added->GetOverlay()->SetShowReadout(first->GetOverlay()->GetShowReadout());
  added->GetGodObjectActor()->SetShowTrail(first->GetGodObjectActor()->GetShowTrail());
  added->GetGodObjectActor()->SetSize(first->GetGodObjectActor()->GetSize());
  others.back()->SetView(view);
  this->Show(self.Shown);
}

bool vtkPVHapticPicture::IsShownIn(vtkObject* view)
{
  bool isShown = false;
  this->Internal->ForAll([view, &isShown](haptics::HandPicture& picture)
    { isShown = isShown || (view && picture.GetView() == view); });
  return isShown;
}

bool vtkPVHapticPicture::IsOutdated(vtkObject* view)
{
  bool isOutdated = false;
  this->Internal->ForAll([view, &isOutdated](haptics::HandPicture& picture)
    { isOutdated = isOutdated || (picture.GetView() == view && picture.IsOutdated()); });
  return isOutdated;
}

bool vtkPVHapticPicture::IsAnyOutdated()
{
  bool isOutdated = false;
  this->Internal->ForAll([&isOutdated](haptics::HandPicture& picture)
    { isOutdated = isOutdated || picture.IsOutdated(); });
  return isOutdated;
}

void vtkPVHapticPicture::SetOutdated()
{
  this->Internal->ForAll([](haptics::HandPicture& picture) { picture.SetOutdated(); });
}

bool vtkPVHapticPicture::DrawHand(vtkObject* view)
{
  bool drawn = false;
  this->Internal->ForAll([view, &drawn](haptics::HandPicture& picture)
    { drawn = drawn || (view && picture.GetView() == view && picture.Draw()); });
  return drawn;
}

void vtkPVHapticPicture::Show(const Hand& hand)
{
  Internals& self = *this->Internal;
  self.Shown = hand;
  self.ForAll(
    [&self](haptics::HandPicture& picture)
    {
      const Hand& shown = self.Shown;
      vtkHapticOverlay* overlay = picture.GetContents()->GetOverlay();
      overlay->SetHint(&picture == &self.Own ? shown.Hint : std::string());
      overlay->SetStatus(shown.Status);
      if (shown.IsShown != (overlay->GetVisibility() != 0))
      {
        overlay->SetVisibility(shown.IsShown);
        picture.SetOutdated();
      }
      picture.GetContents()->GetGodObjectActor()->SetShowHand(shown.IsThere && self.IsHandShown);
    });
}

void vtkPVHapticPicture::SetShowForce(bool show)
{
  this->Internal->ForAll([show](haptics::HandPicture& picture)
    { picture.GetContents()->GetOverlay()->SetShowForce(show); });
}

void vtkPVHapticPicture::SetShowReadout(bool show)
{
  this->Internal->ForAll([show](haptics::HandPicture& picture)
    { picture.GetContents()->GetOverlay()->SetShowReadout(show); });
}

void vtkPVHapticPicture::SetShowTrail(bool show)
{
  this->Internal->ForAll([show](haptics::HandPicture& picture)
    { picture.GetContents()->GetGodObjectActor()->SetShowTrail(show); });
}

void vtkPVHapticPicture::SetShowHand(bool show)
{
  this->Internal->IsHandShown = show;
  this->Show(this->Internal->Shown);
}

void vtkPVHapticPicture::SetHandSize(double size)
{
  this->Internal->ForAll([size](haptics::HandPicture& picture)
    { picture.GetContents()->GetGodObjectActor()->SetSize(size); });
}
