/**
 * @class   vtkGodObjectTrace
 * @brief   replays a path of haptic interface points over a surface, without a device
 *
 * Port 0: a vtkPolyData whose points, in the order of their ids, are the positions of the haptic
 * interface point (HIP), one a servo tick [world]. Its cells are not looked at. Port 1: the
 * surface, any vtkPolyData. Where that comes from a vtkGodObjectFilter, its surface is used as it
 * is, with that filter's side and engine; otherwise a vtkGodObjectFilter inside prepares it, with
 * the properties of this class. So it does where that filter has several blocks: each is followed
 * by itself.
 *
 * The output is the polyline of the god-object [world], one point for each HIP, with the point data
 * of the path and, of each tick (haptics::ContactTick, which a servo runs too, so that a
 * vtkHapticScene's trace has the same arrays with the same meaning):
 *
 * - `Time` [s]: the path's own where it has such an array, else by the tick period;
 * - `HapticInterfacePoint` (3): the HIP [world];
 * - `Force` (3): the force on the hand [N], along the world's axes; see haptics::SurfaceForce;
 * - `ActiveConstraints`: how many planes hold the god-object back, 0 to 3;
 * - `Surface`: 0, and -1 in free space;
 * - `OriginalCellId`: the cell touched, -1 in free space. Of several, the one that pushes most. It
 *   counts the cells of port 1, or of the input of the vtkGodObjectFilter that port 1 comes from;
 * - `PointIds` (3): the corners of the triangle that pushes most, -1 in free space; they count the
 *   points of what `OriginalCellId` counts the cells of;
 * - `BarycentricWeights` (3): how much each of them counts there, sum 1, 0 in free space;
 * - `Normal` (3): unit, of that surface, towards the god-object, 0 in free space;
 * - `Penetration`: distance from HIP to god-object [world unit];
 * - `Stiffness`: in effect [N/m], of the spring or of the surface where it has properties;
 * - `Energy`: what the hand has put in since the first HIP and not got out [J], with the force held
 *   from one HIP to the next;
 * - `EnergyTank`: what a surface with properties may still spend [J]; see haptics::SurfaceForce;
 * - every point and cell array of the surface, as it is where the god-object touches, NaN in free
 *   space (0 for whole numbers): see AddSurfaceArray(). One whose name is taken by those above, or
 *   by the path, comes as `Surface` and its name.
 *
 * Arrays have their unit in their information, as vtkDataArray::UNITS_LABEL(); lengths do where
 * SetUnitLength() says which it is.
 *
 * Where port 1 comes from a vtkHapticPatchAlgorithm, the surface need not fit in memory: patches of
 * it are made as the path goes on, and the trace is that over the whole surface.
 *
 * A surface without points and cells is nothing to touch: the whole path is in free space.
 *
 * The first HIP is taken as free space, whichever side of the surface it lies on. The same inputs
 * give the same output, bit for bit.
 *
 * Errors: a missing or empty path, a path point that is not finite, and all errors of
 * vtkGodObjectFilter give an error that says where and what to do, and an empty output. Not for
 * live devices: see vtkHapticServo. Neither the stiffness nor the damping of a surface is limited
 * here as a device limits it, but for a damping of 4 N s/m.
 *
 * All methods are for the GUI thread.
 *
 * @sa vtkGodObjectFilter
 */

#ifndef Haptics_vtkGodObjectTrace_h
#define Haptics_vtkGodObjectTrace_h

#include "vtkHapticsFiltersModule.h"
#include "vtkNew.h" // for vtkNew
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

class vtkGodObjectFilter;
class vtkHapticPatchAlgorithm;
class vtkHapticProperties;

namespace haptics
{
class GodObject;
}

class VTKHAPTICSFILTERS_EXPORT vtkGodObjectTrace : public vtkPolyDataAlgorithm
{
public:
  static vtkGodObjectTrace* New();
  vtkTypeMacro(vtkGodObjectTrace, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * @brief The surface, port 1.
   */
  void SetSurfaceConnection(vtkAlgorithmOutput* surface);
  void SetSurfaceData(vtkPolyData* surface);
  ///@}

  ///@{
  /**
   * @brief Stiffness of the spring between HIP and god-object, in the device frame [N/m].
   * Default 500; range 0 to 1e100, other values are clamped.
   */
  void SetStiffness(double value);
  vtkGetMacro(Stiffness, double);
  ///@}

  ///@{
  /**
   * @brief A longer force is shortened to this [N], its direction kept. Default 3.3, what common
   * desktop devices give; range 0 to 1e100, other values are clamped.
   */
  void SetMaximumForce(double value);
  vtkGetMacro(MaximumForce, double);
  ///@}

  ///@{
  /**
   * @brief Length of a world unit [m]: 0.001 for a surface in millimetres. Default 0: not known.
   * Then lengths in the output have no unit. Range 1e-100 to 1e100; anything else is an error, and
   * the last one stays.
   */
  void SetUnitLength(double metres);
  vtkGetMacro(UnitLength, double);
  ///@}

  ///@{
  /**
   * @brief Metres in the device frame for one world unit [m]. Default 0: the surface has its
   * true size, by UnitLength, or as if in metres where that is not known. Range as of UnitLength.
   *
   * A surface that is more than 2 m or less than 1 mm across by that default is a warning, once: a
   * device reaches some 0.1 m, and the force is that of metres.
   */
  void SetWorldToDeviceScale(double metres);
  vtkGetMacro(WorldToDeviceScale, double);
  ///@}

  ///@{
  /**
   * @brief Time from one HIP to the next [s], for surfaces with damping or force shading. Default
   * 0.001; range 1e-6 to 1, other values are clamped.
   */
  void SetTickPeriod(double value);
  vtkGetMacro(TickPeriod, double);
  ///@}

  ///@{
  /**
   * In how many substeps a tick may follow the HIP's straight way since the tick before: 1 to 16;
   * other values are clamped. Default 1: off; 4 are enough nearly everywhere. A tick has more than
   * one only where what holds the god-object changes on the way and leads it elsewhere, as on rough
   * ground and in folds: there one coarse step can end in another valley than a hand that moves
   * slowly. Each costs about as much as a tick; a ball goes in one. All guarantees of
   * haptics::GodObject hold, whatever the limit.
   */
  vtkSetClampMacro(SubstepLimit, int, 1, 16);
  vtkGetMacro(SubstepLimit, int);
  ///@}

  ///@{
  /**
   * @brief The radius of the tip in the device frame [m]: the god-object is a ball about the HIP,
   * see haptics::GodObject::SetTipRadius(). Default 0: a point. Finite and >= 0; any other value is
   * an error, and the last one stays. One larger than half of the surface in the hand is an error
   * of Update(), and the output is empty.
   *
   * The output's points are the ball's centres; `BarycentricWeights` and the surface's arrays are
   * those of the place that it touches. With a tip, SubstepLimit has no effect.
   */
  void SetTipRadius(double radius);
  vtkGetMacro(TipRadius, double);
  ///@}

  ///@{
  /**
   * @brief Which of the surface's point and cell arrays the trace has: by default all, which
   * PassSurfaceArraysOff() turns off; those of the names added here, where there are any. A name
   * that no array has is a warning.
   */
  vtkSetMacro(PassSurfaceArrays, bool);
  vtkGetMacro(PassSurfaceArrays, bool);
  vtkBooleanMacro(PassSurfaceArrays, bool);
  void AddSurfaceArray(const char* name);
  void ClearSurfaceArrays();
  ///@}

  /**
   * @brief Writes the output as a table of comma-separated values, a line a tick after one with the
   * columns' names: Time, GodObject_X, _Y, _Z, then the other arrays. The file is replaced once all
   * is written. False and an error where it cannot be, or there is no output yet.
   */
  bool WriteCSV(const char* file);

  /**
   * @brief The material of a surface that does not come from a vtkGodObjectFilter; one that does
   * has that filter's properties. Never null; none by default. The arrays that it maps are those of
   * port 1, chosen by SetInputArrayToProcess() of this class.
   */
  vtkHapticProperties* GetProperties();
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * @brief As in vtkGodObjectFilter, for surfaces that do not come from one. An array of sides is
   * chosen with vtkGodObjectFilter::SIDE_ARRAY, of port 1 too.
   */
  void SetSide(int side);
  int GetSide() const;
  void SetEngine(int engine);
  int GetEngine() const;
  ///@}

protected:
  vtkGodObjectTrace();
  ~vtkGodObjectTrace() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkGodObjectTrace(const vtkGodObjectTrace&) = delete;
  void operator=(const vtkGodObjectTrace&) = delete;

  void KeepSurfaceError(vtkObject* caller, unsigned long event, void* text);
  vtkGodObjectFilter* PrepareSurface(vtkPolyData* surface);
  bool CheckPath(vtkPolyData* path);
  bool CheckTip(vtkGodObjectFilter* prepared);
  double ScaleInUse() const;
  void WarnOfSize(double size);
  bool LoadPatch(const double position[3], const double hip[3]);
  bool FollowWithPatch(const double hip[3], std::unique_ptr<haptics::GodObject>& god);
  std::unique_ptr<haptics::GodObject> MakeGodObject(vtkGodObjectFilter* prepared);
  void Replay(vtkPolyData* path, vtkGodObjectFilter* prepared, vtkPolyData* output);

  vtkNew<vtkGodObjectFilter> Preparation;
  vtkHapticPatchAlgorithm* Source = nullptr; // of patches, while a path is followed; else null
  std::string SurfaceError; // of Preparation, which this class passes on as its own
  double Stiffness = 500.0;
  double MaximumForce = 3.3;
  double UnitLength = 0.0;
  double WorldToDeviceScale = 0.0;
  bool HasWarnedOfSize = false; // of the surface that is there
  double TickPeriod = 0.001;
  int SubstepLimit = 1; // haptics::GodObject::DefaultSubstepLimit
  double TipRadius = 0.0;
  bool PassSurfaceArrays = true;
  std::vector<std::string> SurfaceArrays; // empty: all
};

#endif
