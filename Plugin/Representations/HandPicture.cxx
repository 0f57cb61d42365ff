#include "HandPicture.h"

#include "vtkCommand.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticOverlay.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

namespace haptics
{
HandPicture::~HandPicture()
{
  this->SetView(nullptr);
}

void HandPicture::SetView(vtkPVRenderView* view)
{
  if (view == this->View)
  {
    return;
  }
  if (this
        ->View) // one that is deleted takes its window and renderers with it, and our props in them
  {
    vtkRenderer* const renderer = this->View->GetNonCompositedRenderer();
    renderer->RemoveViewProp(this->Contents->GetGodObjectActor());
    renderer->RemoveViewProp(this->Contents->GetOverlay());
    this->View->GetRenderWindow()->RemoveObserver(this->Observer);
  }
  this->View = view;
  this->Behind.SetRenderer(view ? view->GetNonCompositedRenderer() : nullptr);
  if (view)
  {
    vtkRenderer* const renderer = view->GetNonCompositedRenderer();
    renderer->AddViewProp(this->Contents->GetGodObjectActor());
    renderer->AddViewProp(this->Contents->GetOverlay());
    this->Observer =
      view->GetRenderWindow()->AddObserver(vtkCommand::StartEvent, this, &HandPicture::OnRender);
  }
}

void HandPicture::OnRender()
{
  this->Outdated = false;
  if (this->View)
  {
    this->Contents->GetGodObjectActor()->IncludeInClippingRange(
      this->View->GetNonCompositedRenderer());
  }
}

bool HandPicture::Draw()
{
  if (!this->View)
  {
    return true;
  }
  this->Contents->GetGodObjectActor()->IncludeInClippingRange(
    this->View->GetNonCompositedRenderer());
  return this->Behind.DrawFront();
}
}
