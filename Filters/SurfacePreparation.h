#ifndef Haptics_SurfacePreparation_h
#define Haptics_SurfacePreparation_h

#include "haptics/Filters/BuildKey.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/SurfaceCleaner.h"
#include "haptics/Surface/TriangleSurface.h"

#include "vtkHapticsFiltersModule.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkIdTypeArray;
class vtkPoints;
class vtkPolyData;

namespace haptics
{
/// What a vtkGodObjectFilter is set to.
struct PreparationOptions
{
  CleaningOptions Cleaning;
  Side TouchedSide = Side::Automatic;
  /// The side of each cell, as the number of one of the first three Sides, from CheckSideArray();
  /// null: TouchedSide for all. It is read, and let go of, when a SurfacePreparation is made.
  vtkSmartPointer<vtkDataArray> CellSides;
  EngineKind Engine = EngineKind::Automatic;
  bool AutomaticCrackWidth = true;
  double CrackWidth = 0.0; ///< [world unit]; ignored where it is automatic
};

/// What keeps an array from giving the sides of an input's cells, as the end of a sentence; empty
/// where nothing does.
std::string CheckSideArray(vtkDataArray* array, bool isOfCells, vtkPolyData* input);

/// @brief What a vtkGodObjectFilter makes of one geometry, without its pipeline.
///
/// Made, read and destroyed on the GUI thread; Run() may be on any thread, once. Meanwhile the GUI
/// thread leaves the object alone. Run() reads the input's points, cells and ghost array, and
/// makes VTK objects of its own; it neither keeps nor lets go of any that another thread knows.
///
/// Where the input is a patch of a surface, which its field data say (PatchRecord), so is the
/// result, and its ids count the whole surface's cells and points.
class VTKHAPTICSFILTERS_EXPORT SurfacePreparation
{
public:
  /// Shares the input's points and cells; takes its state for the key now.
  SurfacePreparation(vtkPolyData* input, const PreparationOptions& options);
  ~SurfacePreparation();
  SurfacePreparation(const SurfacePreparation&) = delete;
  SurfacePreparation& operator=(const SurfacePreparation&) = delete;

  /// Takes a copy of the points, so that whoever owns them may write into them while Run() is on
  /// another thread. Cells are still shared.
  void CopyPoints();

  /// Lets Follow() look whether this is an earlier geometry in another shape. GUI thread.
  void FollowOn(std::shared_ptr<const SurfacePreparation> earlier);
  /// Instead of Run(): where the geometry given to FollowOn() has the same cells, and its clean
  /// points are still those of this one, moved, gives where they are now, and is then as after
  /// Run() but for Surface(), which is null. False elsewhere, also where a coordinate is not
  /// finite: call Run(), which reports it. On any thread, once.
  bool Follow(std::vector<Vec3>& points);

  /// Before Run(): of a patch whose surface is that of an earlier patch in another shape, its
  /// points come from there within `duration` [s], where that can be: no triangle has lost its
  /// area, no points have come to be one, and the engine is not the exact one.
  void DeformOver(double duration) { this->DeformDuration = duration; }
  /// The record of a patch; null where it is none.
  const PatchRecord* PatchOf() const { return this->Patch.get(); }

  CleaningResult Run(const ProgressCall& progress);
  /// Lets go of the input's points, and of the geometry given to FollowOn().
  void Finish();

  /// Gives `output` the clean points and triangles, and the attributes of `input`, a geometry with
  /// the key above; points that were merged but have other data come again after the others, see
  /// DataPoints. Returns how many arrays were left out, having too few tuples. GUI thread.
  int Fill(vtkPolyData* input, vtkPolyData* output) const;

  /// What the result depends on: equal keys, equal results.
  const BuildKey& Key() const { return this->InputKey; }
  static BuildKey MakeKey(vtkPolyData* input, const PreparationOptions& options);

  /// Why Run() failed; empty otherwise.
  const std::string& Error() const { return this->ErrorText; }
  /// What is wrong with single values of the side array, where TouchedSide is in their place; empty
  /// otherwise. Known from the start.
  const std::string& SideError() const { return this->SideErrorText; }
  /// What is odd about the input, though it was good enough; empty otherwise.
  const std::string& Warning() const { return this->WarningText; }

  ///@{
  /// Results, once Run() is done; null or zero before, and where it was not.
  std::shared_ptr<const TriangleSurface> Surface() const { return this->Built; }
  const CleaningReport& Report() const { return this->Found; }
  double CrackWidth() const { return this->CrackWidthInUse; } ///< [world unit]
  /// For each triangle the input's cell; of a patch the cell of the whole surface.
  vtkIdTypeArray* OriginalCells() const;
  ///@}

private:
  /// The clean triangles, and for each of their corners the input's point.
  struct CleanedCorners
  {
    std::vector<Triangle> Triangles;
    std::vector<Triangle> Originals;
  };
  std::string NumberTriangles(CleanedMesh& cleaned) const;
  bool FindStarts(const CleanedMesh& cleaned, std::vector<Vec3>& starts) const;

  enum class Cells
  {
    Unknown,
    Same,
    Other
  };
  void ReadSides();
  void AddCollapseWarning(const CleanedMesh& cleaned);
  int FillPoints(vtkPolyData* input, vtkPolyData* output) const;
  bool HasSameCells() const;
  bool MovePoints(std::vector<Vec3>& points) const;

  PreparationOptions Options;
  vtkNew<vtkPolyData> Input;
  BuildKey InputKey;
  std::string ErrorText;
  std::string WarningText;
  std::string SideErrorText;
  std::vector<Side> CellSides; ///< one a cell of the input; empty where none was given
  std::shared_ptr<const TriangleSurface> Built;
  CleaningReport Found;
  double CrackWidthInUse = 0.0;
  vtkSmartPointer<vtkPoints> CleanPoints;
  vtkSmartPointer<vtkCellArray> CleanTriangles;
  vtkSmartPointer<vtkIdTypeArray> PointIds;
  vtkSmartPointer<vtkIdTypeArray> CellIds;
  std::shared_ptr<const CleanedCorners> Corners; ///< null where no points were merged
  std::shared_ptr<const std::vector<std::int32_t>>
    PointMap;                ///< for each input point, as CleanedMesh
  double MergedWithin = 0.0; ///< [world unit]
  ///@{
  /// Of a patch; null elsewhere.
  std::shared_ptr<const PatchRecord> Patch;
  vtkSmartPointer<vtkIdTypeArray> WholeCells;   ///< of the input's cells
  vtkSmartPointer<vtkIdTypeArray> WholeCellIds; ///< of the triangles
  vtkSmartPointer<vtkDataArray> StartPoints;    ///< PatchRecord::StartPoints
  std::optional<double> DeformDuration;
  ///@}
  std::shared_ptr<const SurfacePreparation> Earlier;
  Cells CellsOfEarlier = Cells::Other;
};
}

#endif
