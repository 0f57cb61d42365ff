/**
 * @class   vtkPVHapticScene
 * @brief   The haptic scene of a ParaView client: a vtkHapticScene fed with representations
 *
 * The object behind the proxy (haptics, HapticScene), which lives on the client only, wherever the
 * data are. It hands the surfaces of its representations to a vtkHapticScene, makes the device
 * that is asked for by name, shows the hand in the view, and puts what the proxy's properties
 * tell. C++ reaches it through vtkSMProxy::GetClientSideObject(), and the scene itself, with its
 * events, through GetScene().
 *
 * Representations are weakly held, so is the view: what is deleted is touched no more. When the
 * view goes the scene is released.
 *
 * Nothing here renders. Call Update() about as often as the picture is drawn, and render the view
 * when it returns true.
 *
 * Errors go through vtkErrorMacro, hence to ParaView's output window, and to GetMessage().
 *
 * Frames and units are those of vtkHapticScene. GUI thread.
 *
 * @sa vtkHapticScene vtkHapticSurfaceRepresentation
 */
#ifndef Haptics_vtkPVHapticScene_h
#define Haptics_vtkPVHapticScene_h

#include "vtkHapticsRepresentationsModule.h"
#include "vtkObject.h"

#include <memory>
#include <string>

class vtkHapticScene;
class vtkHapticSurfaceRepresentation;
class vtkHapticView;
class vtkPVRenderView;
class vtkStringArray;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticScene : public vtkObject
{
public:
  static vtkPVHapticScene* New();
  vtkTypeMacro(vtkPVHapticScene, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The scene itself. Its device and surfaces are this object's business. Never null. */
  vtkHapticScene* GetScene();
  /** What shows it in the view: god-object and overlay. Never null. */
  vtkHapticView* GetPicture();

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
   * while it is touchable beside another choice. One that is hidden is not touched.
   */
  void AddSurface(vtkObject* representation);
  void RemoveAllSurfaces();
  ///@}
  /**
   * What messages and the read-out call a representation's surface (no name by default), and which
   * of its choices brings the triangles (null: the one that is drawn).
   */
  void SetSurfaceSource(
    vtkObject* representation, const std::string& name, vtkHapticSurfaceRepresentation* beside);
  /**
   * Whether the surfaces come from several processes, which may place the same point some units of
   * the last place apart: such points are merged, so that no seam is felt. Default off.
   */
  void SetInPieces(bool inPieces);
  /** How many of them can be touched now. */
  int GetNumberOfTouchableSurfaces();

  ///@{
  /**
   * mouse (the default), simulated, falcon, or a file: a recording, or a .vtp with the path of a
   * hand in the world frame. Another one releases the scene. It is looked for when the scene is
   * engaged, stepped or fitted.
   */
  void SetDeviceName(const char* name);
  const char* GetDeviceName();
  ///@}

  ///@{
  /**
   * Starts and stops the servo. Where it cannot start GetMessage() tells why, and GetEngaged()
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

  ///@{
  /** Of the surfaces in the hand [N/m], device frame. Default 500; finite and >= 0. */
  void SetStiffness(double stiffness);
  double GetStiffness();
  ///@}
  /** What the device can hold of it [N/m]. */
  double GetEffectiveStiffness();
  ///@{
  /** A longer force is shortened to this [N]. Default 3.3; finite and >= 0. */
  void SetMaximumForce(double force);
  double GetMaximumForce();
  ///@}
  ///@{
  /** The side of the surfaces that can be touched, a vtkGodObjectFilter::Side. Default Automatic.
   */
  void SetSide(int side);
  int GetSide();
  ///@}

  ///@{
  /**
   * Device to world, row by row, as vtkHapticWorkspace::SetTransform(). All zeros, the
   * default, until it was set or fitted; set to zeros it is fitted anew when it is needed.
   */
  void SetWorkspaceTransform(const double matrix[16]);
  void GetWorkspaceTransform(double matrix[16]);
  ///@}
  /**
   * Maps what the device reaches to the surfaces, or to the path that it follows, aligned with the
   * view's camera. False and an error where there is nothing to fit.
   */
  bool Fit();
  /** Magnifies what the device reaches, as vtkHapticWorkspace::Scale(). */
  void ScaleWorkspace(double factor);
  ///@{
  /** The clutch, as vtkHapticWorkspace::SetClutched(). */
  void SetClutched(bool clutched);
  bool GetClutched();
  ///@}

  /**
   * Takes in what changed in ParaView and what the servo did. True where a picture has to be drawn
   * anew.
   */
  bool Update();
  ///@{
  /**
   * Changed surfaces are built beside, see vtkHapticScene::SetBackgroundBuilding(): whether one is
   * now, how far it is (0 to 1), and giving it up.
   */
  bool GetBuilding();
  double GetBuildProgress();
  void CancelBuild();
  ///@}
  ///@{
  /**
   * What the view shows beside the hand: the force as bar and number (default on), what lies at
   * the contact (default off), where the hand went (default off).
   */
  void SetShowForce(bool show);
  void SetShowReadout(bool show);
  void SetShowTrail(bool show);
  ///@}
  /** Runs ticks in virtual time, see vtkHapticScene::Step(). */
  void Step(int ticks);

  /** The file that the next run records to, see vtkHapticServo; empty (the default) for none. */
  void SetRecordingFileName(const char* name);
  ///@{
  /**
   * Whether a trace is kept of every tick, with the arrays that the surfaces have when it is turned
   * on. Default off; turning it on forgets the last one.
   */
  void SetRecordTrace(bool record);
  bool GetRecordTrace();
  ///@}

  ///@{
  /** Landmarks: one where the hand touches, an error in free space; the last one away; all away. */
  void DropLandmark();
  void RemoveLastLandmark();
  void ClearLandmarks();
  int GetNumberOfLandmarks();
  ///@}
  /**
   * The distance to the one before that is written beside each, a vtkHapticLandmarks::DistanceType.
   * Default straight.
   */
  void SetLandmarkDistance(int distance);

  ///@{
  /** What goes on, in words, and what is wrong; empty where nothing is, or no longer. */
  const char* GetState();
  const char* GetMessage();
  ///@}
  ///@{
  /** As the scene tells them. */
  double GetRate(); ///< [Hz]; 0 when released
  vtkTypeInt64 GetMissedTicks();
  double* GetForce() VTK_SIZEHINT(3);                ///< [N], world axes
  double GetForceMagnitude();                        ///< [N]
  double GetPenetration();                           ///< [world unit]
  double* GetHapticInterfacePoint() VTK_SIZEHINT(3); ///< [world unit]
  double* GetGodObject() VTK_SIZEHINT(3);            ///< [world unit]
  bool GetTouching();
  vtkIdType GetTouchedCell(); ///< id of the cell in the source's data where known; else -1
  ///@}
  /** Which of the representations is touched, by the order they were added in; else -1. */
  int GetTouchedRepresentation();
  /** What it is called; empty where nothing is touched, or without a name. */
  const char* GetTouchedName();
  /** For each array its name and its value at the contact, as text. */
  vtkStringArray* GetProbedValues();

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
  void SyncSurfaces();
  bool HasBadSurface();
  void ShowHand();
  void OnViewDeleted();
  void OnSurfaceError();

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
