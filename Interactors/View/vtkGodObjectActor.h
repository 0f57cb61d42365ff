/**
 * @class   vtkGodObjectActor
 * @brief   Shows where the hand is, where the surface holds it back, and how strongly.
 *
 * The parts, all in the world frame:
 * - the god-object, a sphere on the surface;
 * - the haptic interface point (HIP), a paler and smaller sphere where the device is;
 * - the spring, a thin bar between the two;
 * - the force, an arrow at the god-object;
 * - the contact, a ring on the surface around the god-object, the wider the stronger the force: it
 *   shows how strong that is where the arrow points at the viewer;
 * - the trail (off by default), the last points that the god-object went through;
 * - on request the triangles that hold it, landmarks, and a legend of the force's colours.
 *
 * While it touches, god-object and ring have the colour of the force's strength, from pale gold to
 * crimson at ReferenceForce; the god-object is pale while it does not.
 *
 * The HIP is usually inside the surface, so all these are drawn through whatever lies in front,
 * unless SeeThrough is off. Keep them opaque.
 *
 * Sizes are fractions of the view's height, so that a terrain of 30 km and a gear of 3 mm look
 * alike and zooming in does not hide the surface, and at least some pixels, for small views; see
 * SetSizeInWorld() for the other way. A picture at a multiple of the window's size
 * (vtkWindowToImageFilter::SetScale()) has them in the same proportion.
 *
 * The prop is not pickable, takes no part in the bounds of a scene (so that ResetCamera() frames
 * the surfaces, not the hand) and is never touched. Because of that the renderer's clipping range
 * does not know it: call IncludeInClippingRange() after each reset of the range.
 * vtkInteractorStyleHaptic does so.
 *
 * A vtkHapticScene keeps one up to date; it can be driven by hand as well. GUI thread.
 *
 * @sa vtkHapticScene
 */
#ifndef Haptics_vtkGodObjectActor_h
#define Haptics_vtkGodObjectActor_h

#include "vtkBoundingBox.h"
#include "vtkHapticsViewModule.h"
#include "vtkNew.h"
#include "vtkProp3D.h"
#include "vtkProperty.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkBillboardTextActor3D;
class vtkColorTransferFunction;
class vtkPolyData;
class vtkRenderer;
class vtkScalarBarActor;

class VTKHAPTICSVIEW_EXPORT vtkGodObjectActor : public vtkProp3D
{
public:
  static vtkGodObjectActor* New();
  vtkTypeMacro(vtkGodObjectActor, vtkProp3D);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where the device is, in the world frame [world unit]. Default the origin. A coordinate that is
   * not finite is refused with an error and changes nothing.
   */
  void SetHapticInterfacePoint(double x, double y, double z);
  void SetHapticInterfacePoint(const double point[3]);
  vtkGetVector3Macro(HapticInterfacePoint, double);
  ///@}

  ///@{
  /**
   * Where the surface holds the hand back, in the world frame [world unit]. Default the origin.
   * Refuses what is not finite, as SetHapticInterfacePoint() does.
   */
  void SetGodObject(double x, double y, double z);
  void SetGodObject(const double point[3]);
  vtkGetVector3Macro(GodObject, double);
  ///@}

  ///@{
  /**
   * Force on the hand [N] along the world's axes. Default none, which hides the arrow. Refuses what
   * is not finite.
   */
  void SetForce(double x, double y, double z);
  void SetForce(const double force[3]);
  vtkGetVector3Macro(Force, double);
  ///@}

  ///@{
  /**
   * Whether a surface holds the god-object back. Spring and HIP are only shown when it is. Default
   * off.
   */
  vtkSetMacro(Touching, bool);
  vtkGetMacro(Touching, bool);
  vtkBooleanMacro(Touching, bool);
  ///@}

  ///@{
  /**
   * Radius of the god-object's sphere; the other parts are in proportion. A fraction of the view's
   * height, or, with SizeInWorld, a length [world unit]. Default 0.012; greater than 0.
   */
  void SetSize(double value);
  vtkGetMacro(Size, double);
  ///@}

  ///@{
  /**
   * Off (the default): Size is a fraction of the view's height. On: it is a length in the world,
   * so that things grow when the camera comes closer.
   */
  vtkSetMacro(SizeInWorld, bool);
  vtkGetMacro(SizeInWorld, bool);
  vtkBooleanMacro(SizeInWorld, bool);
  ///@}

  ///@{
  /**
   * The radius of the tip in the world [world unit]: the god-object's sphere is then drawn at that
   * size, and ring and arrow are where it touches. 0, the default: a point, drawn by Size. Finite
   * and >= 0; any other value is an error and changes nothing.
   */
  void SetTipRadius(double radius);
  vtkGetMacro(TipRadius, double);
  ///@}

  ///@{
  /**
   * Force whose arrow is 12 times as long as Size [N]; arrows are proportional to the force.
   * Default 3.3, the limit of common devices; greater than 0. A vtkHapticView sets it to the
   * largest force that the hand can meet.
   */
  void SetReferenceForce(double value);
  vtkGetMacro(ReferenceForce, double);
  ///@}
  /**
   * The colours of forces [N], from pale gold at 0 over orange to crimson at ReferenceForce, as
   * arrow, god-object, ring and legend have them. Not to be changed; never null.
   */
  vtkColorTransferFunction* GetForceColors() { return this->ForceColors; }

  ///@{
  /**
   * Whether the hand is shown at all: god-object, HIP, spring, force, contact and active triangles.
   * Off where there is none, what it left (trail and landmarks) stays. Default on.
   */
  vtkSetMacro(ShowHand, bool);
  vtkGetMacro(ShowHand, bool);
  vtkBooleanMacro(ShowHand, bool);
  ///@}

  ///@{
  /** Whether each part is shown. All on by default but the trail. */
  vtkSetMacro(ShowHapticInterfacePoint, bool);
  vtkGetMacro(ShowHapticInterfacePoint, bool);
  vtkBooleanMacro(ShowHapticInterfacePoint, bool);
  vtkSetMacro(ShowForce, bool);
  vtkGetMacro(ShowForce, bool);
  vtkBooleanMacro(ShowForce, bool);
  vtkSetMacro(ShowContact, bool);
  vtkGetMacro(ShowContact, bool);
  vtkBooleanMacro(ShowContact, bool);
  vtkSetMacro(ShowTrail, bool);
  vtkGetMacro(ShowTrail, bool);
  vtkBooleanMacro(ShowTrail, bool);
  ///@}

  ///@{
  /**
   * Points that the trail keeps; when full the oldest half is forgotten. Default 4000; 2 to
   * 1,000,000.
   */
  vtkSetClampMacro(MaximumTrailPoints, int, 2, 1000000);
  vtkGetMacro(MaximumTrailPoints, int);
  ///@}

  ///@{
  /**
   * The triangles that hold the god-object, highlighted where ShowActiveTriangles is on (default
   * off): nine world coordinates each [world unit]. A scene gives them while they are shown.
   */
  void SetActiveTriangles(const double* corners, int numberOfTriangles);
  vtkSetMacro(ShowActiveTriangles, bool);
  vtkGetMacro(ShowActiveTriangles, bool);
  vtkBooleanMacro(ShowActiveTriangles, bool);
  ///@}
  ///@{
  /**
   * Points to mark by small balls, for example vtkHapticLandmarks::GetOutput(); null for none. The
   * strings of their point array Text, where they have one, are written next to them while
   * ShowLandmarkTexts is on (the default; needs VTK::RenderingFreeType in the program). Ball and
   * text are hidden by what lies in front of them.
   */
  void SetLandmarks(vtkPolyData* points);
  vtkSetMacro(ShowLandmarkTexts, bool);
  vtkGetMacro(ShowLandmarkTexts, bool);
  vtkBooleanMacro(ShowLandmarkTexts, bool);
  ///@}

  ///@{
  /**
   * Whether the force's colour shows its strength, from pale gold to crimson at ReferenceForce
   * (default off: the colour of GetForceProperty()), and whether a legend of these colours is shown
   * (default off; its text needs VTK::RenderingFreeType in the program).
   */
  vtkSetMacro(ColorForceByMagnitude, bool);
  vtkGetMacro(ColorForceByMagnitude, bool);
  vtkBooleanMacro(ColorForceByMagnitude, bool);
  vtkSetMacro(ShowLegend, bool);
  vtkGetMacro(ShowLegend, bool);
  vtkBooleanMacro(ShowLegend, bool);
  ///@}

  ///@{
  /**
   * On (the default): god-object, HIP, spring, force and contact are drawn through whatever lies in
   * front. Off: they are occluded as anything else.
   */
  void SetSeeThrough(bool through);
  vtkGetMacro(SeeThrough, bool);
  vtkBooleanMacro(SeeThrough, bool);
  ///@}

  /**
   * Adds a point to the trail [world unit]; `touching` false leaves a gap, so that lines are drawn
   * only where the surface was touched. Does nothing while ShowTrail is off. Refuses what is not
   * finite.
   */
  void AddTrailPoint(const double point[3], bool touching);
  void ClearTrail();

  ///@{
  /**
   * How each part looks. The god-object's colour is that of free space; while it touches it has the
   * colour of the force, unless ShowContact is off.
   */
  vtkProperty* GetGodObjectProperty();
  vtkProperty* GetHapticInterfacePointProperty();
  vtkProperty* GetSpringProperty();
  vtkProperty* GetForceProperty();
  vtkProperty* GetTrailProperty();
  vtkProperty* GetActiveTrianglesProperty();
  vtkProperty* GetLandmarksProperty();
  ///@}

  /** Widens the clipping range of the renderer's camera to hold the HIP, god-object and force. */
  void IncludeInClippingRange(vtkRenderer* renderer);

  /**
   * Bounds of the HIP, the god-object, the landmarks and the trail where it is shown, in the world
   * frame [world unit]. UseBounds is off, so that ResetCamera() ignores them; a renderer leaves out
   * what has them out of its view.
   */
  double* GetBounds() override;

  ///@{
  /** The rendering protocol of vtkProp. */
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  ///@}

protected:
  vtkGodObjectActor();
  ~vtkGodObjectActor() override;

private:
  vtkGodObjectActor(const vtkGodObjectActor&) = delete;
  void operator=(const vtkGodObjectActor&) = delete;

  void SetFinite(double target[3], const double value[3], const char* name);
  double RadiusInWorld(vtkViewport* viewport) const;
  void Arrange(vtkViewport* viewport);
  void ArrangeForce(double radius);
  void ArrangeContact(vtkViewport* viewport, double radius);
  void MakeRing();
  void ColorRing(const double color[3]);
  void KeepRingOnSurface();
  void LiftRing(vtkViewport* viewport);
  void BuildTrail();
  void ShowThrough();
  void MakeMarks();
  void ArrangeMarks(vtkViewport* viewport);
  void ArrangeLegend(vtkViewport* viewport);
  void ArrangeTexts(vtkViewport* viewport, double ball);
  std::vector<vtkProp3D*> Parts() const;

  double HapticInterfacePoint[3] = { 0.0, 0.0, 0.0 };
  double GodObject[3] = { 0.0, 0.0, 0.0 };
  double Force[3] = { 0.0, 0.0, 0.0 };
  bool Touching = false;
  double Size = 0.012;
  double TipRadius = 0.0;
  bool SizeInWorld = false;
  double ReferenceForce = 3.3;
  vtkNew<vtkColorTransferFunction> ForceColors;
  bool ShowHand = true;
  bool ShowHapticInterfacePoint = true;
  bool ShowForce = true;
  bool ShowContact = true;
  bool ShowTrail = false;
  bool ShowActiveTriangles = false;
  bool ShowLandmarkTexts = true;
  bool ColorForceByMagnitude = false;
  bool ShowLegend = false;
  bool SeeThrough = true;
  int MaximumTrailPoints = 4000;

  vtkNew<vtkActor> GodObjectPart;
  vtkNew<vtkActor> HapticInterfacePointPart;
  vtkNew<vtkActor> SpringPart;
  vtkNew<vtkActor> ForceShaftPart;
  vtkNew<vtkActor> ForceTipPart;
  vtkNew<vtkActor> ContactPart;
  vtkNew<vtkActor> TrailPart;
  vtkNew<vtkActor> TrianglesPart;
  vtkNew<vtkActor> LandmarksPart;
  std::vector<vtkSmartPointer<vtkBillboardTextActor3D>> LandmarkTexts;
  vtkSmartPointer<vtkScalarBarActor> Legend; // made when first shown
  vtkNew<vtkProperty> GodObjectLook;
  vtkNew<vtkProperty> TouchingLook;
  vtkNew<vtkPolyData> Ring;
  vtkNew<vtkPolyData> Trail;
  vtkNew<vtkPolyData> Triangles;
  vtkNew<vtkPolyData> Landmarks;
  struct TrailPoint
  {
    double Position[3];
    bool Touching;
  };
  std::vector<TrailPoint> TrailPoints;
  vtkBoundingBox TrailBounds;
  bool TrailChanged = false;
};

#endif
