/**
 * @class   vtkGodObjectFilter
 * @brief   turns any vtkPolyData into clean triangles that can be touched
 *
 * Takes polygons with any number of corners (convex or concave, planar or nearly so), triangle
 * strips, and mixtures of these; verts and lines among them are left out, and so are ghost and
 * blanked cells. Equal points become one, triangles without area and duplicates are dropped, and
 * where a triangle without area joined a corner to a longer edge, that edge is split there. The
 * output has triangles only, in the world frame and unit of the input, with:
 *
 * - the input's point and cell data, and the arrays `OriginalPointId` and `OriginalCellId`, which
 *   name the input point and cell that each output point and triangle came from;
 * - one field data array of one value for each count below, for example `BoundaryEdges`, and the
 *   string array `TouchedSide`.
 *
 * Equal points whose point data differ (creases, boxes, materials, seams of texture coordinates,
 * discontinuous Galerkin) are one for contact, and stay several in the output, so that each cell
 * keeps its own values; global ids, pedigree ids and ghost levels do not count. The points that are
 * so added come after the others.
 *
 * From the same triangles it builds the snapshot that a vtkHapticServo or a vtkGodObjectTrace
 * touches: GetSurface() (C++ only).
 *
 * Nothing is rebuilt while points, cells and this filter's properties stay as they are: a second
 * Update(), another colour array or a moved camera cost next to nothing. "As they are" goes by the
 * modification times of the vtkPoints and vtkCellArray objects; code that writes into their memory
 * has to call their Modified().
 *
 * Which side of each cell is touched, an array of the input can say: see SetSide().
 *
 * The material of the surface, by constants and by arrays of the input, is set by
 * GetProperties() and SetInputArrayToProcess().
 *
 * An input without points and cells (a contour of a value that does not occur, an empty threshold
 * or time step) is an ordinary state of a pipeline: an empty output, no surface, no error.
 *
 * Errors: an input of points or lines without polygons, a point that is not finite, a cell that
 * names a point that does not exist, and a surface without area each give an error that says where
 * and what to do, an empty output and no surface. A surface that was handed out earlier stays valid
 * for who holds it.
 *
 * Composite inputs are taken one block after the other: every block of the output is clean, and
 * GetSurface() is that of the last block. Not for surfaces of more than 2^31 - 1 corners, nor for
 * single concave polygons of many thousand: their time grows with the square, 2 s at 8,000.
 *
 * All methods are for the GUI thread. The surface may be read in any thread.
 *
 * The method: C. B. Zilles and J. K. Salisbury, "A Constraint-based God-object Method For Haptic
 * Display", 1995, which needs triangles.
 *
 * @sa vtkHapticProperties vtkGodObjectTrace vtkHapticScene
 */

#ifndef Haptics_vtkGodObjectFilter_h
#define Haptics_vtkGodObjectFilter_h

#include "vtkHapticsFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

#ifndef __VTK_WRAP__
#include "haptics/Filters/SurfacePreparation.h" // for haptics::SurfacePreparation
#include "haptics/Material/SurfaceProperties.h" // for haptics::SurfaceProperties
#include "haptics/Surface/TriangleSurface.h"    // for haptics::TriangleSurface

#include <memory> // for std::shared_ptr
#endif

class vtkHapticProperties;

class VTKHAPTICSFILTERS_EXPORT vtkGodObjectFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkGodObjectFilter* New();
  vtkTypeMacro(vtkGodObjectFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum SideType
  {
    FRONT = 0,          ///< only the side that the normals point to, as in the paper
    BOTH = 1,           ///< no path crosses any triangle, from either side
    AUTOMATIC_SIDE = 2, ///< FRONT where closed, oriented and not inside out; BOTH elsewhere
    MIXED_SIDES = 3     ///< returned by GetTouchedSide() where cells differ; not to be set
  };

  /// The index for SetInputArrayToProcess() besides those of vtkHapticProperties::PropertyType.
  enum ArrayType
  {
    SIDE_ARRAY = 5 ///< of cells: a SideType each, see SetSide()
  };

  enum EngineType
  {
    AUTOMATIC_ENGINE = 0, ///< by the number of triangles
    BRUTE_FORCE = 1,      ///< looks at every triangle
    EMBREE = 2,           ///< Embree's bounding volume hierarchy
    EXACT = 3             ///< CGAL's tree; an error in builds without it
  };

  ///@{
  /**
   * @brief Which side of the triangles can be touched. Default AUTOMATIC_SIDE; other values are
   * clamped. GetTouchedSide() returns what it came to.
   *
   * A cell array can choose for each cell, so that one mesh has closed solids that are touched from
   * their fronts, and open sheets that are touched from both sides:
   *
   *     filter->SetInputArrayToProcess(vtkGodObjectFilter::SIDE_ARRAY, 0, 0,
   *       vtkDataObject::FIELD_ASSOCIATION_CELLS, "sides");
   *
   * Its values are FRONT (0), BOTH (1) and AUTOMATIC_SIDE (2: what that comes to for the surface as
   * a whole). Where a value is none of these it is an error, and Side is used for that cell; for
   * all cells where the array is not there, is not of cells, or has another size. Of equal
   * triangles that face the same way one is kept, with the sides of all. Another array builds the
   * surface anew.
   */
  vtkSetClampMacro(Side, int, FRONT, AUTOMATIC_SIDE);
  vtkGetMacro(Side, int);
  void SetSideToFront() { this->SetSide(FRONT); }
  void SetSideToBoth() { this->SetSide(BOTH); }
  void SetSideToAutomatic() { this->SetSide(AUTOMATIC_SIDE); }
  ///@}

  ///@{
  /**
   * @brief What finds the triangles near the god-object; all give the same contact. Default
   * AUTOMATIC_ENGINE; other values are clamped.
   */
  vtkSetClampMacro(Engine, int, AUTOMATIC_ENGINE, EXACT);
  vtkGetMacro(Engine, int);
  void SetEngineToAutomatic() { this->SetEngine(AUTOMATIC_ENGINE); }
  void SetEngineToBruteForce() { this->SetEngine(BRUTE_FORCE); }
  void SetEngineToEmbree() { this->SetEngine(EMBREE); }
  void SetEngineToExact() { this->SetEngine(EXACT); }
  ///@}

  ///@{
  /**
   * @brief Points no farther apart than this become one. Default 0: only points whose float64
   * coordinates are equal. Range: 0 to 1e100; other values are clamped.
   * A fraction of the diagonal of the surface's bounds, or a length [world unit] where
   * MergeToleranceIsAbsolute is on (default off).
   */
  void SetMergeTolerance(double value);
  vtkGetMacro(MergeTolerance, double);
  vtkSetMacro(MergeToleranceIsAbsolute, bool);
  vtkGetMacro(MergeToleranceIsAbsolute, bool);
  vtkBooleanMacro(MergeToleranceIsAbsolute, bool);
  ///@}

  ///@{
  /**
   * @brief The widest gap between facets that still counts as closed [world unit].
   * With AutomaticCrackWidth (default on) it is 2^-21 of the largest absolute coordinate for points
   * stored as float32, which is eight times their rounding, and 0 for float64; CrackWidth is then
   * ignored. CrackWidth: default 0, range 0 to 1e100, other values are clamped.
   */
  vtkSetMacro(AutomaticCrackWidth, bool);
  vtkGetMacro(AutomaticCrackWidth, bool);
  vtkBooleanMacro(AutomaticCrackWidth, bool);
  void SetCrackWidth(double value);
  vtkGetMacro(CrackWidth, double);
  ///@}

  ///@{
  /**
   * @brief The material of the surface. Never null; none by default; null sets a new one. The
   * arrays that it maps are chosen by SetInputArrayToProcess(), with the indices of
   * vtkHapticProperties::PropertyType. A change does not build the surface anew.
   */
  void SetProperties(vtkHapticProperties* properties);
  vtkHapticProperties* GetProperties();
  ///@}
  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  /**
   * @brief Whether an array that was chosen for properties or sides was no good at the last
   * Update().
   */
  bool HasBadArray() const;
  /**
   * @brief The properties as of the last Update(); null where the surface is plain.
   */
  std::shared_ptr<const haptics::SurfaceProperties> GetSurfaceProperties() const;
  /**
   * @brief Properties for a surface of this geometry, which has the arrays, point for point and
   * triangle for triangle; null where it is plain. Reports errors as Update() does.
   */
  std::shared_ptr<const haptics::SurfaceProperties> MakeProperties(
    vtkPolyData* geometry, const std::shared_ptr<const haptics::TriangleSurface>& surface);

  /**
   * @brief The surface as of the last Update(); null before, for an empty input, and after an error
   * or an abort.
   */
  std::shared_ptr<const haptics::TriangleSurface> GetSurface() const;

  ///@{
  /**
   * @brief To build on another thread, in C++ only: make a haptics::SurfacePreparation with
   * GetOptions() for the geometry, Run() it elsewhere, and Take() it with its result. These two
   * report errors and warnings as Update() does. Take() returns whether there is a surface; the
   * output is not made.
   */
  haptics::PreparationOptions GetOptions(vtkPolyData* geometry);
  bool Take(
    const std::shared_ptr<haptics::SurfacePreparation>& prepared, haptics::CleaningResult result);
  /** @brief What Take() reports of the side array, for one that deforms and is not taken: once. */
  void TellOfSides(const haptics::SurfacePreparation& prepared);
  ///@}
#endif

  /**
   * @brief Whether an input has neither points nor cells, as a contour of a value that does not
   * occur: an ordinary state of a pipeline. There is nothing to touch, and no error.
   */
  static bool IsEmpty(vtkPolyData* input);

  /**
   * @brief How often a surface has been built, successfully or not, since this filter was made.
   */
  vtkGetMacro(NumberOfBuilds, vtkIdType);

  ///@{
  /**
   * @brief What the last Update() found and mended; all zero or false without a surface.
   * Each is also a field data array of the output, named without "GetNumberOf" or "Get".
   */
  vtkIdType GetNumberOfMergedPoints() const;        ///< points that another one now stands for
  vtkIdType GetNumberOfUnusedPoints() const;        ///< points of no triangle
  vtkIdType GetNumberOfDegenerateTriangles() const; ///< pieces of cells without area, dropped
  vtkIdType GetNumberOfDuplicateTriangles() const;  ///< same corners and orientation, dropped
  vtkIdType GetNumberOfFoldedPolygons() const;      ///< crossing themselves, split into a fan
  vtkIdType GetNumberOfGhostCells() const;          ///< ghosts and blanked cells, dropped
  vtkIdType GetNumberOfBoundaryEdges() const;       ///< edges of one triangle
  vtkIdType GetNumberOfNonManifoldEdges() const;    ///< edges of more than two triangles
  vtkIdType GetNumberOfFlippedEdges() const;        ///< between triangles of opposite orientation
  vtkIdType GetNumberOfComponents() const;          ///< pieces connected through edges
  vtkIdType GetNumberOfInsideOutComponents() const; ///< closed, with normals pointing inwards
  bool GetClosed() const;                           ///< no boundary and no non-manifold edge
  bool GetOriented() const;                         ///< no flipped and no non-manifold edge
  int GetTouchedSide() const;                       ///< FRONT, BOTH or MIXED_SIDES
  int GetEngineInUse() const;                       ///< what AUTOMATIC_ENGINE came to
  double GetCrackWidthInUse() const;                ///< [world unit]
  ///@}

  ///@{
  /**
   * @brief "Front", "Both", "Mixed"; "BruteForce", "Embree", "Exact"; empty without a surface.
   */
  const char* GetTouchedSideAsString() const;
  const char* GetEngineInUseAsString() const;
  ///@}

protected:
  vtkGodObjectFilter();
  ~vtkGodObjectFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkGodObjectFilter(const vtkGodObjectFilter&) = delete;
  void operator=(const vtkGodObjectFilter&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;

  void PassNothing(vtkPolyData* input, vtkPolyData* output);
  void AddReport(vtkPolyData* output) const;

  int Side = AUTOMATIC_SIDE;
  int Engine = AUTOMATIC_ENGINE;
  double MergeTolerance = 0.0;
  bool MergeToleranceIsAbsolute = false;
  bool AutomaticCrackWidth = true;
  double CrackWidth = 0.0;
  vtkIdType NumberOfBuilds = 0;
};

#endif
