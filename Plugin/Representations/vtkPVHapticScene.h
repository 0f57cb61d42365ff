/**
 * @class   vtkPVHapticScene
 * @brief   The haptic scene of a ParaView client: a vtkHapticScene fed with representations
 *
 * The object behind the proxy (haptics, HapticScene), which lives on the client only, wherever the
 * data are. It hands the surfaces of its representations to a vtkHapticScene, makes the device
 * that is asked for by name, and runs it. Its parts have proxies below that: where the device
 * reaches (GetWorkspace()), the hand in the views (GetPicture()), what it leaves (GetRecords()) and
 * what it does just now (GetReadings()). C++ reaches it through vtkSMProxy::GetClientSideObject(),
 * and the scene itself, with its events, through GetScene().
 *
 * Representations are weakly held, so is the view: what is deleted is touched no more. When the
 * view goes the scene is released.
 *
 * Nothing here renders a view. Call Update() about as often as the picture is drawn, and where it
 * returns true have the picture DrawHand() in each view that IsOutdated(), or render that.
 *
 * Errors go through vtkErrorMacro, hence to ParaView's output window, and to GetMessage().
 *
 * Frames and units are those of vtkHapticScene. GUI thread.
 *
 * @sa vtkHapticScene vtkHapticSurfaceRepresentation vtkPVHapticPart
 */
#ifndef Haptics_vtkPVHapticScene_h
#define Haptics_vtkPVHapticScene_h

#include "vtkHapticsRepresentationsModule.h"
#include "vtkObject.h"

#include <memory>
#include <string>

class vtkHapticScene;
class vtkHapticSurfaceRepresentation;
class vtkPVHapticPart;
class vtkPVHapticPicture;
class vtkPVHapticReadings;
class vtkPVHapticRecords;
class vtkPVHapticWorkspace;
class vtkPVRenderView;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticScene : public vtkObject
{
public:
  static vtkPVHapticScene* New();
  vtkTypeMacro(vtkPVHapticScene, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The scene itself. Its device and surfaces are this object's business. Never null. */
  vtkHapticScene* GetScene();
  ///@{
  /** Its parts. Never null; setting one replaces it, before anything else is done. */
  void SetPicture(vtkPVHapticPicture* picture);
  vtkPVHapticPicture* GetPicture();
  void SetReadings(vtkPVHapticReadings* readings);
  vtkPVHapticReadings* GetReadings();
  void SetRecords(vtkPVHapticRecords* records);
  vtkPVHapticRecords* GetRecords();
  void SetWorkspace(vtkPVHapticWorkspace* workspace);
  vtkPVHapticWorkspace* GetWorkspace();
  ///@}

  ///@{
  /**
   * The vtkPVRenderView that shows the hand and whose camera the device is aligned with. Null by
   * default. Any other kind of view is an error, and there is none then. Setting another view
   * releases the scene.
   */
  void SetView(vtkObject* view);
  vtkPVRenderView* GetView();
  ///@}

  ///@{
  /**
   * The representations to touch, as a view has them: each a vtkHapticSurfaceRepresentation or one
   * that has it among its choices. It is touched while that is chosen; with SetSurfaceSource() also
   * while it is touchable and another choice is drawn. One that is hidden is not touched.
   */
  void AddSurface(vtkObject* representation);
  void RemoveAllSurfaces();
  ///@}
  /**
   * What messages and the read-out call a representation's surface (no name by default), and which
   * of its choices brings the triangles (null: the one that is drawn).
   */
  void SetSurfaceSource(
    vtkObject* representation, const std::string& name, vtkHapticSurfaceRepresentation* source);
  /**
   * Whether the surfaces come from several processes, which may place the same point some units of
   * the last place apart: such points are merged, so that no seam gives a force. Default off.
   */
  void SetInPieces(bool inPieces);
  /** How many of them can be touched now. */
  int GetNumberOfTouchableSurfaces();

  /**
   * mouse (the default), simulated, falcon, or a file: a recording, or a .vtp with the path of a
   * hand in the world frame. Another one releases the scene. It is looked for when the scene is
   * engaged, stepped or fitted.
   */
  void SetDeviceName(const char* name);

  ///@{
  /**
   * Starts and stops the servo. Where it cannot start GetMessage() says why, and GetEngaged()
   * stays false. The workspace is fitted if it never was. A device that takes its time to open
   * (the Falcon) is engaged by Update() as soon as it is ready; so is one that follows a path as
   * soon as the surfaces are built.
   */
  void SetEngaged(bool engaged);
  bool GetEngaged();
  ///@}
  /**
   * Releases an engaged scene; GetState() has the reason, in a few words. No error: what a user
   * does with sources and views is not one.
   */
  void ReleaseBecause(const std::string& reason);

  /** Of the surfaces in the hand [N/m], device frame. Default 500; finite and >= 0. */
  void SetStiffness(double stiffness);
  /** A longer force is shortened to this [N]. Default 3.3; finite and >= 0. */
  void SetMaximumForce(double force);
  /** As vtkHapticServo::SetSubstepLimit(): 1 to 16, default 1: off. */
  void SetSubstepLimit(int limit);
  /** As vtkHapticScene::SetTipRadius(): of the tip [m], device frame; 0, the default: a point. */
  void SetTipRadius(double radius);
  /** The side of the surfaces that can be touched, a vtkGodObjectFilter::Side. Default Automatic.
   */
  void SetSide(int side);

  /**
   * Maps what the device reaches to the surfaces, or to the path that it follows, aligned with the
   * view's camera. False and an error where there is nothing to fit.
   */
  bool Fit();
  /**
   * Takes in what changed in ParaView and what the servo did. True where a picture has to be drawn
   * anew.
   */
  bool Update();
  ///@{
  /**
   * Changed surfaces are built in the background, see vtkHapticSurfaces::SetBackgroundBuilding():
   * whether one is now, its progress (0 to 1), and cancelling it.
   */
  bool GetBuilding();
  double GetBuildProgress();
  void CancelBuild();
  ///@}
  /** Runs ticks in virtual time, see vtkHapticScene::Step(). */
  void Step(int ticks);

  ///@{
  /** The state in words, and the fault; empty where there is none, or none any more. */
  const char* GetState();
  const char* GetMessage();
  ///@}

protected:
  vtkPVHapticScene();
  ~vtkPVHapticScene() override;

private:
  vtkPVHapticScene(const vtkPVHapticScene&) = delete;
  void operator=(const vtkPVHapticScene&) = delete;

  void Fail(const std::string& message);
  void FailWithoutSurface(const std::string& message);
  bool Prepare();
  bool ChooseDevice();
  bool ChoosePath();
  bool HasToWait();
  void EngageWhenReady();
  void ShowHand();
  void OnViewDeleted();
  void OnSurfaceError();
  void OnPartFailed(vtkObject* part, unsigned long event, void* message);

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
