/**
 * @class   vtkHapticView
 * @brief   Shows a vtkHapticScene: the hand, the force, what is touched.
 *
 * Observes a scene and keeps two props up to date with it, which the caller adds to a renderer:
 * GetGodObjectActor() in the scene, GetOverlay() over it. They change with each Update() and Step()
 * of the scene; who calls these renders where they return that something has changed, as
 * vtkInteractorStyleHaptic does. Several views may show one scene.
 *
 * Needs VTK's rendering back end (VTK::RenderingOpenGL2, and VTK::RenderingFreeType for text) in
 * the program as soon as a prop is asked for, and not before. GUI thread.
 *
 * @sa vtkHapticScene vtkGodObjectActor vtkHapticOverlay vtkInteractorStyleHaptic
 */
#ifndef Haptics_vtkHapticView_h
#define Haptics_vtkHapticView_h

#include "vtkHapticsViewModule.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <string>

class vtkCallbackCommand;
class vtkGodObjectActor;
class vtkHapticOverlay;
class vtkHapticScene;

class VTKHAPTICSVIEW_EXPORT vtkHapticView : public vtkObject
{
public:
  static vtkHapticView* New();
  vtkTypeMacro(vtkHapticView, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The scene that is shown, which the view keeps alive. Default null: the props rest. */
  void SetScene(vtkHapticScene* scene);
  vtkHapticScene* GetScene();
  ///@}

  /**
   * God-object, HIP, force, trail and landmarks. Made by the first call; never null. Its
   * ReferenceForce and the overlay's MaximumForce are the largest force that the hand can meet
   * (vtkHapticServo::GetEffectiveMaximumForce()), and are set where that changes.
   */
  vtkGodObjectActor* GetGodObjectActor();
  /** The force as bar and number, the read-out and the help. Made by the first call; never null. */
  vtkHapticOverlay* GetOverlay();

protected:
  vtkHapticView();
  ~vtkHapticView() override;

private:
  vtkHapticView(const vtkHapticView&) = delete;
  void operator=(const vtkHapticView&) = delete;

  static void OnSceneState(
    vtkObject* caller, unsigned long event, void* clientData, void* callData);
  static void OnServo(vtkObject* caller, unsigned long event, void* clientData, void* callData);
  static void OnLandmarks(vtkObject* caller, unsigned long event, void* clientData, void* callData);
  void ShowLandmarks();
  void ShowTrail();
  void ShowScale();
  void Show();
  std::string DescribeContact();
  std::string DescribeLandmarks();

  vtkSmartPointer<vtkHapticScene> Scene;
  vtkNew<vtkCallbackCommand> Callback;
  vtkNew<vtkCallbackCommand> ServoCallback;
  vtkNew<vtkCallbackCommand> LandmarksCallback;
  vtkSmartPointer<vtkGodObjectActor> Actor;
  vtkSmartPointer<vtkHapticOverlay> Overlay;
  vtkMTimeType LandmarksShown = 0;
  double StrongestShown = 0.0; ///< [N]; 0: none yet
};

#endif
