/**
 * @class   vtkHapticScene
 * @brief   Couples a haptic device, any number of surfaces and the servo loop: touch a picture.
 *
 * Add surfaces (actors as a view shows them, or geometry), give a device, Engage(): from then on
 * the servo thread renders their forces at 1 kHz. Call Update() about as often as the picture is
 * drawn; it takes in changed surfaces, drains the servo's records and reports whether anything
 * moved. vtkInteractorStyleHaptic calls it from a timer. The scene does not draw: a vtkHapticView
 * shows it, and a program without one links no rendering library.
 *
 * The scene itself keeps what is touched, the run, and the state after the last tick. The rest is
 * done by its parts, which it hands out: see vtkHapticSceneParts.
 *
 * Frames: surfaces, HIP and god-object are in the world frame [world unit]; device positions,
 * forces and stiffness in the device frame [m, N, N/m]. The workspace transform maps device to
 * world. Forces are also given along the world's axes, in newtons, for drawing.
 *
 * Errors: a surface that turns out empty, without polygons or with coordinates that are not finite
 * is reported through vtkErrorMacro and GetErrorMessage(), once for each change; what was touched
 * before stays in force. What the servo, the workspace, the grip and the trace recorder report is
 * reported by the scene too, so that it is enough to observe the scene.
 *
 * Memory: a snapshot of each surface, and that of the trace.
 *
 * Every method is for the GUI thread.
 *
 * @sa vtkHapticSceneParts vtkHapticDevice vtkGodObjectFilter vtkHapticView vtkInteractorStyleHaptic
 */
#ifndef Haptics_vtkHapticScene_h
#define Haptics_vtkHapticScene_h

#include "haptics/Math/Vec3.h"
#include "vtkCommand.h"
#include "vtkHapticSceneParts.h"
#include "vtkHapticsSceneModule.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

namespace haptics
{
struct TickRecord;
}

class vtkActor;
class vtkAlgorithmOutput;
class vtkCallbackCommand;
class vtkCamera;
class vtkHapticDevice;
class vtkHapticProbe;
class vtkPolyData;
class vtkProp3D;

class VTKHAPTICSSCENE_EXPORT vtkHapticScene : public vtkHapticSceneParts
{
public:
  static vtkHapticScene* New();
  vtkTypeMacro(vtkHapticScene, vtkHapticSceneParts);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Invoked on the GUI thread, from Update(), Step(), Engage() and Release(), when the scene has
   * taken in everything: the getters return the state after the last tick, the call data what was
   * at the event's own tick. In the order of the ticks; within one tick buttons, then contact, then
   * overload or squeeze. What happened between two updates is not lost, but for slides, of which
   * each update reports one at most, last. Probes are made only for events that have an observer.
   *
   * Python: decorate the observer with vtkmodules.util.misc.calldata_type, VTK_OBJECT (of
   * vtkmodules.util.vtkConstants) for a probe and VTK_INT for a number.
   */
  enum SceneEvents
  {
    ContactBeginEvent = vtkCommand::UserEvent + 4200, ///< vtkHapticProbe: a surface holds the hand
    ContactEndEvent,    ///< vtkHapticProbe: none does any more; it has the free place
    SurfaceErrorEvent,  ///< no data; a surface was refused, or too fast: see GetErrorMessage()
    FaultEvent,         ///< no data; the servo stopped by itself: see GetErrorMessage()
    ContactSlideEvent,  ///< vtkHapticProbe: the god-object has moved along a surface
    ButtonPressEvent,   ///< int*: the device's button, from 0
    ButtonReleaseEvent, ///< int*: the device's button, from 0
    DeviceStateEvent,   ///< int*: a vtkHapticDevice::DeviceState
    OverloadEvent,      ///< vtkHapticProbe: too many triangles in one place; held where it is safe
    LandmarkEvent,      ///< int*: how many landmarks there are, after one came by a button
    BuildEvent,         ///< no data; a background build began, got on or ended: see GetSurfaces()
    GripEvent,          ///< int*: the id of the surface that the hand carries now
    LetGoEvent,         ///< int*: the id of the surface that it does not carry any more
    SqueezeEvent, ///< vtkHapticProbe: surfaces have closed in and leave the hand no place: no force
    /// No data; the state has been taken in, before the events of what has happened in it. For
    /// views, which see with it every tick once: GetNewTicks().
    StateEvent
  };

  ///@{
  /**
   * Adds a surface and returns its id, which is never given twice; -1 and an error where the
   * argument is null, or a prop that is neither a vtkActor nor a vtkAssembly. The geometry is taken
   * in by the next Update(), Step() or Engage().
   *
   * An actor is followed: geometry, matrix (mirrored and scaled ones too), visibility and
   * pickability; one that is hidden or not pickable is not touched. Adding it again returns the id
   * that it has. What its mapper's clipping planes cut away is not touched; they are in the world
   * frame, as the mapper has them. Geometry given directly is in the world frame.
   *
   * One that is dragged or turned gets to its new place over the time between two updates, at most
   * 0.1 s, and takes the hand along or pushes it. What would have to be faster than 5 m/s in the
   * device's frame takes longer; what would take more than 0.1 s is an error, and is put there
   * without pushing anything. The same holds for geometry whose points move while its cells stay.
   *
   * Of an assembly every actor becomes a surface, with an id of its own, at the place where the
   * assembly has it; parts that come, go, move, are shown or hidden are followed. The id returned
   * is the assembly's as a whole, to remove it.
   */
  int AddSurface(vtkProp3D* prop);
  int AddSurface(vtkAlgorithmOutput* geometry);
  int AddSurface(vtkPolyData* geometry);
  ///@}
  /**
   * As AddSurface(), for Python: VTK's choice between overloads there does not know an actor of a
   * class that Python has derived from vtkActor and others, as PyVista's is.
   */
  int AddSurfaceActor(vtkActor* actor);

  ///@{
  /**
   * Removes a surface, or a whole assembly. False where it is not in the scene, or only a part of
   * an assembly: hide that. Takes effect at the next Update(); what comes or goes while a surface
   * is on its way to other points waits for that, 0.1 s at most.
   */
  bool RemoveSurface(int id);
  bool RemoveSurface(vtkProp3D* prop);
  void RemoveAllSurfaces();
  ///@}

  ///@{
  /** The device, null by default. Changing it releases the scene first. */
  void SetDevice(vtkHapticDevice* device);
  vtkHapticDevice* GetDevice();
  ///@}

  ///@{
  /** Stiffness of the surfaces in the hand [N/m], device frame. Default 500; finite and >= 0. */
  void SetStiffness(double stiffness);
  double GetStiffness();
  ///@}
  ///@{
  /**
   * The radius of the tip [m], device frame: the hand is a ball about the HIP, which stays outside
   * of the surfaces, rounds edges and comes into no gap narrower than itself. 0, the default: a
   * point. Finite and >= 0; any other value is an error, and the last one stays. GetGodObject() is
   * the ball's centre; probe, events and landmarks are where it touches.
   *
   * One larger than half of what the device reaches, or than half of the largest surface in the
   * hand, is an error, once until it fits: meanwhile the hand is a point, and
   * GetEffectiveTipRadius() is 0. Takes effect with the next Update(), Step() or Engage(). A ball
   * that overlaps a surface, because it starts there or has grown, is smaller at first: it may
   * leave, comes no deeper, and is pushed out as it grows to its size, within 0.13 s.
   *
   * With a tip each tick is made in one step, whatever the SubstepLimit.
   */
  void SetTipRadius(double radius);
  vtkGetMacro(TipRadius, double);
  double GetEffectiveTipRadius();
  ///@}
  ///@{
  /**
   * Fits the workspace to the bounds of the surfaces that can be touched, or to `bounds` (xmin,
   * xmax, ymin, ymax, zmin, zmax; world frame): see vtkHapticWorkspace::Fit(). One that is built
   * for the first time in the background counts already. False and an error where no surface can be
   * touched or there is no device.
   *
   * While it was never set nor fitted, surfaces the largest of which has more than 30 times the
   * size of what the device then reaches, in millimetres for instance, or less than a hundredth of
   * it are a warning, once, when the scene engages or steps.
   */
  bool FitWorkspace(vtkCamera* camera = nullptr);
  bool FitWorkspace(const double bounds[6], vtkCamera* camera = nullptr);
  ///@}

  ///@{
  /**
   * Starts and stops the servo thread; the device is opened where it is not, and opened again where
   * its settings have changed since (vtkHapticDevice::HasChanged()). Engage() returns
   * whether it runs; where not, GetErrorMessage() says why. Release() asks for zero force and
   * takes in the last ticks; the device stays open.
   */
  bool Engage();
  /**
   * Engages as a view does: where the workspace was never set nor fitted it is fitted first to the
   * surfaces, aligned with the camera (the world's axes where it is null).
   */
  bool EngageInView(vtkCamera* camera);
  void Release();
  bool IsEngaged();
  ///@}

  /**
   * Takes in what has changed and what the servo did since the last call. True where anything that
   * a picture shows has changed: render only then.
   */
  bool Update();

  /**
   * Runs ticks in virtual time on this thread, for scripts and tests, then does what Update()
   * does. Returns the ticks done; 0 and an error while engaged, without a device, or n < 1. A
   * device that is not open, or whose path or other settings have changed since it was
   * (vtkHapticDevice::HasChanged()), is opened first, and begins at time 0: to stroke again with
   * another path, set it and step.
   */
  int Step(int n);

  ///@{
  /**
   * State after the last Update() or Step(); zeros before the first. Of the latest tick, or of one
   * that differs from it by rounding: by under 1e-12 m in the hand and 1e-9 N.
   */
  vtkGetVector3Macro(HapticInterfacePoint, double); ///< world frame [world unit]
  vtkGetVector3Macro(GodObject, double);            ///< world frame [world unit]
  vtkGetVector3Macro(Force, double);   ///< on the hand, the world's axes [N]; 0 when released
  vtkGetMacro(Penetration, double);    ///< of the HIP below the god-object [world unit]
  vtkGetMacro(Touching, bool);         ///< false when released
  vtkGetMacro(TouchedSurface, int);    ///< id of the surface touched, else -1
  vtkGetMacro(TouchedCell, vtkIdType); ///< id of its cell as it was given, else -1
  ///@}
  /**
   * The contact after the last Update() or Step(): ids, barycentric position, the values of every
   * array. Another object after each change; never null. Made when asked for.
   */
  vtkHapticProbe* GetProbe();

  /** Drops a landmark where the hand touches; its number, or -1 and an error in free space. */
  int DropLandmark();

  /** The ticks that the last look at the servo has taken in, oldest first. C++ only. */
  const std::vector<haptics::TickRecord>& GetNewTicks();
  /**
   * The corners of the triangles that hold the god-object after the last Update() or Step(), three
   * each; world frame. C++ only.
   */
  std::vector<haptics::Vec3> GetActiveCorners();
  /**
   * What went wrong last; empty where nothing has. A call that can fail (Engage(), Step(),
   * FitWorkspace() and so on) begins with none, so that it is empty after one that succeeds; but
   * what was wrong with a surface stays until something else is.
   */
  const char* GetErrorMessage() { return this->ErrorMessage.c_str(); }

protected:
  vtkHapticScene();
  ~vtkHapticScene() override;

  void ForgetMessage() override; // unless it is of a surface

private:
  vtkHapticScene(const vtkHapticScene&) = delete;
  void operator=(const vtkHapticScene&) = delete;

  class Internals;
  std::unique_ptr<Internals> Internal;

  void Fail(const std::string& message);
  void FollowParts();
  void NoticePart(vtkObject* part, unsigned long event, const char* report);
  bool OpenDevice(vtkHapticDevice* device);
  bool PullSurfaces();
  void FinishBuilds();
  void ReportBuilds();
  bool PullTip();
  void WarnOfReach();
  bool PullState();
  void PullRecords();
  bool TakeState();
  void NoticeDevice();
  void OnButtons();
  void UpdateProbe(bool touching);

  vtkNew<vtkCallbackCommand> Follower;   // of the parts
  vtkSmartPointer<vtkHapticProbe> Probe; // null until asked for
  std::string ErrorMessage;
  bool IsMessageOfSurface = false;
  bool HasFaultySurface = false; ///< as of the last look at them

  double TipRadius = 0.0; // as it was set

  double HapticInterfacePoint[3] = { 0.0, 0.0, 0.0 };
  double GodObject[3] = { 0.0, 0.0, 0.0 };
  double Force[3] = { 0.0, 0.0, 0.0 };
  double Penetration = 0.0;
  bool Touching = false;
  int TouchedSurface = -1;
  vtkIdType TouchedCell = -1;
  bool Engaged = false;
};

#endif
