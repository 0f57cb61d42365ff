/**
 * @class   vtkPVHapticPicture
 * @brief   The hand of a vtkPVHapticScene in the views that show it
 *
 * It looks the same in all. GUI thread.
 *
 * @sa vtkHapticView vtkPVHapticScene
 */
#ifndef Haptics_vtkPVHapticPicture_h
#define Haptics_vtkPVHapticPicture_h

#include "vtkPVHapticPart.h"

#include <memory>
#include <string>

class vtkHapticView;
class vtkPVRenderView;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticPicture : public vtkPVHapticPart
{
public:
  static vtkPVHapticPicture* New();
  vtkTypeMacro(vtkPVHapticPicture, vtkPVHapticPart);

  /** What is shown in the scene's own view: god-object and overlay. Never null. */
  vtkHapticView* GetContents();

  ///@{
  /**
   * What the views show in addition to the hand: the force as bar and number (default on), what
   * lies at the contact (default off), where the hand went (default off).
   */
  void SetShowForce(bool show);
  void SetShowReadout(bool show);
  void SetShowTrail(bool show);
  ///@}
  ///@{
  /**
   * Whether the views show the hand itself while there is one (default on), and the radius of its
   * ball as a share of their height: default 0.012, greater than 0.
   */
  void SetShowHand(bool show);
  void SetHandSize(double size);
  ///@}

  /**
   * Shows the hand in another view too, or no more there. Null, and another kind of view: nothing
   * is done. Default: in the scene's own view alone.
   */
  void ShowIn(vtkObject* view, bool show);
  /** Whether the hand is among what a view shows, where there is one. */
  bool IsShownIn(vtkObject* view);
  ///@{
  /**
   * Whether what a view shows of the hand is older than the scene's last Update(); and draws the
   * hand anew there, over the rest of the picture as it was rendered last, which takes as long
   * however large that is. False where this view has to be rendered instead: the hand is not shown
   * there, or the camera has moved since.
   */
  bool IsOutdated(vtkObject* view);
  bool DrawHand(vtkObject* view);
  ///@}

#ifndef __VTK_WRAP__
  void SetScene(vtkHapticScene* scene, haptics::RepresentedSurfaces* surfaces) override;
  /** For vtkPVHapticScene, C++ only, as all below: its own view, or null. */
  void SetView(vtkPVRenderView* view);
  /// What the views are to show.
  struct Hand
  {
    bool IsThere = false; ///< there is one
    bool IsShown = false; ///< there is one, or is about to be
    std::string Status;   ///< what the scene does or waits for
    std::string Hint;     ///< what to do, in the scene's own view
  };
  void Show(const Hand& hand);
  /** All pictures are older than what is known. */
  void SetOutdated();
  /** Whether one of them is. */
  bool IsAnyOutdated();
#endif

protected:
  vtkPVHapticPicture();
  ~vtkPVHapticPicture() override;

private:
  vtkPVHapticPicture(const vtkPVHapticPicture&) = delete;
  void operator=(const vtkPVHapticPicture&) = delete;

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
