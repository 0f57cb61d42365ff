/**
 * @class   vtkHapticPatchAlgorithm
 * @brief   gives of a surface that is elsewhere what is near the hand
 *
 * What all sources of patches have in common. The surface is too large to be here: on disk
 * (vtkHapticPatchSource), or on the ranks of a server (ParaView). The output is a patch: the
 * polygons and strips that come near a region, with their point and cell arrays, and in field data
 * what belongs to the surface as a whole: the frame in which it is touched, whether it is closed,
 * the ranges of its arrays. A vtkGodObjectFilter, vtkGodObjectTrace or vtkHapticScene that gets it
 * touches it as it would the whole surface, to within rounding, wherever the hand is well inside.
 * `OriginalCellId` and `OriginalPointId` count the cells and points of the whole surface.
 *
 * A vtkGodObjectTrace and a vtkHapticScene with this as their surface ask for patches by
 * themselves, as the hand goes on. So does a script with SetRegion().
 *
 * Lengths and places are in the frame and unit of the surface's points. All methods are for one
 * thread.
 *
 * @sa vtkHapticPatchSource vtkGodObjectTrace vtkGodObjectFilter
 */
#ifndef Haptics_vtkHapticPatchAlgorithm_h
#define Haptics_vtkHapticPatchAlgorithm_h

#include "vtkHapticsFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#ifndef __VTK_WRAP__
#include "haptics/Math/Vec3.h" // for haptics::Vec3

#include <optional> // for std::optional
#endif

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

namespace haptics
{
struct PartBox;
struct PatchEnclosure;
struct PatchRecord;
struct PatchRegion;
}

class VTKHAPTICSFILTERS_EXPORT vtkHapticPatchAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkHapticPatchAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The radius of the patches that are asked for [world unit]: what is known around the hand,
   * beyond the way by which the god-object lags behind it. Default 0: a hundredth of the surface's
   * diagonal. Finite and >= 0; any other value is an error, and the last one stays. It does not
   * change the forces, but how often a patch is made, and how large it is.
   */
  void SetPatchRadius(double radius);
  vtkGetMacro(PatchRadius, double);
  ///@}
  /** The same as it is used, after Survey(); 0 before where it is the default. [world unit] */
  double GetPatchRadiusInUse();

  /**
   * What the output is to hold: all that comes within `radius` of the straight line between two
   * points, which may be one [world]. Default none: no cell, with the surface's arrays. Where that
   * fails, which is an error, the output stays what it was for the region before, and says so.
   */
  void SetRegion(const double from[3], const double to[3], double radius);
  /**
   * The same, and of a closed surface also what is around its nearest place to `from`, however far
   * that is, and around the straight line between: for a god-object that the surface has gone over.
   */
  void SetRegionUpToSurface(const double from[3], const double to[3], double radius);

  /**
   * Finds out what belongs to the whole surface, unless that is known. False and an error where
   * that fails.
   */
  virtual bool Survey() = 0;
  ///@{
  /** Of the whole surface, after Survey(); zeros before, of no surface bounds as VTK has them. */
  vtkIdType GetNumberOfTriangles();
  void GetSurfaceBounds(double bounds[6]);
  bool GetClosed();
  ///@}
  /** Another number after each change of the surface; 0 before Survey(). */
  vtkTypeUInt64 GetVersion();

#ifndef __VTK_WRAP__
  /**
   * C++ only: the patch of a region, which encloses nothing: for where the surface does not change.
   * False and an error where that fails.
   */
  bool MakePatch(const haptics::PatchRegion& region, vtkPolyData* output);

  /** C++ only: whether Fetch() gets what a region needs while its caller does something else. */
  virtual bool GetsInBackground() const
  {
    return false;
  }
  /**
   * C++ only: begins to get what the region needs, after Survey(), and says whether that is at
   * hand, so that an Update() for it does not wait: ask again until it is. Another region than last
   * time takes its place. True where nothing is got in the background.
   */
  virtual bool Fetch(const haptics::PatchRegion& region);
#endif

protected:
  vtkHapticPatchAlgorithm();
  ~vtkHapticPatchAlgorithm() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

#ifndef __VTK_WRAP__
  /** What cells are asked for. */
  enum class Use
  {
    Look, ///< to see what is there
    Touch ///< for the hand, which a later version may deform on from there
  };
  /**
   * The cells that come near a region, in parts, which may have none; false and an error where that
   * fails. After Survey(). Where the record has a version before, with
   * haptics::PatchRecord::StartPoints, and what comes near anywhere on the way from there.
   */
  virtual bool Crop(const haptics::PatchRegion& region, Use use,
    std::vector<vtkSmartPointer<vtkPolyData>>& parts) = 0;
  /**
   * In parts, cells among which is the one that comes nearest to a place; false and an error where
   * that fails. After Survey().
   */
  virtual bool CropNearest(
    const haptics::Vec3& place, std::vector<vtkSmartPointer<vtkPolyData>>& parts) = 0;
  /**
   * Survey() has found this, and it gets a version of its own. `box`: of the points used. `sample`:
   * a part of it that has cells, to see which arrays it has. Where the record says of which version
   * it is another shape (WholeSurface::Before, a GetVersion(), and LongestWay), that has to be the
   * last of which the output has had a patch; else it is another surface.
   */
  void SetWhole(
    const haptics::PatchRecord& record, const haptics::PartBox& box, vtkPolyData* sample);
  void ForgetWhole();
  bool HasWhole() const;
#endif

private:
  vtkHapticPatchAlgorithm(const vtkHapticPatchAlgorithm&) = delete;
  void operator=(const vtkHapticPatchAlgorithm&) = delete;

#ifndef __VTK_WRAP__
  void SetRegion(const haptics::PatchRegion& region, bool isUpToSurface);
  bool MakeEnclosedPatch(vtkPolyData* output);
  bool MakePatchOfVersion(vtkPolyData* output);
  bool Gather(const haptics::PatchRegion& region, Use use, vtkPolyData* output);
  void DeformFromTouched();
  void WriteRecord(const haptics::PatchRegion& region, const haptics::PatchEnclosure& enclosure,
    vtkPolyData* output) const;
  bool ReachSurface(haptics::PatchRegion& region, haptics::PatchEnclosure& enclosure);
  bool CountEnclosing(
    const haptics::PatchRegion& region, vtkPolyData* patch, haptics::PatchEnclosure& enclosure);
  bool CountAtQuietPlace(const haptics::PatchRegion& region, vtkPolyData* patch,
    haptics::PatchEnclosure& enclosure) const;
  std::optional<int> CountAt(const haptics::Vec3& place, double tilt, bool& isDone);
#endif

  class WholeInternals;
  std::unique_ptr<WholeInternals> Whole;
  double PatchRadius = 0.0;
};

#endif
