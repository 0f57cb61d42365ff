#ifndef Haptics_HandPicture_h
#define Haptics_HandPicture_h

#include "Backdrop.h"
#include "vtkHapticView.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkWeakPointer.h"

namespace haptics
{
/**
 * The hand of a scene in one view of ParaView: contact, force, what it left, and the bar. It is
 * drawn over what the view shows, here, wherever that is drawn, and hidden by nothing but what is
 * drawn here. GUI thread.
 */
class HandPicture
{
public:
  HandPicture() = default;
  ~HandPicture();
  HandPicture(const HandPicture&) = delete;
  HandPicture& operator=(const HandPicture&) = delete;

  /// The view that shows it; null, the default, for none.
  void SetView(vtkPVRenderView* view);
  vtkPVRenderView* GetView() const { return this->View; }

  /// What is shown: has a scene where it was given one. Never null.
  vtkHapticView* GetContents() const { return this->Contents; }

  ///@{
  /// Whether the picture is older than what is known; not after a render.
  void SetOutdated() { this->Outdated = true; }
  bool IsOutdated() const { return this->Outdated && this->View; }
  ///@}

  /// Draws the hand anew over what the view shows. False where the view has to be rendered.
  bool Draw();

private:
  void OnRender();

  vtkNew<vtkHapticView> Contents;
  vtkWeakPointer<vtkPVRenderView> View;
  unsigned long Observer = 0;
  Backdrop Behind;
  bool Outdated = false;
};
}

#endif
