#ifndef Haptics_ServedSurface_h
#define Haptics_ServedSurface_h

#include "haptics/Filters/PatchCropper.h"
#include "haptics/Filters/PatchRecord.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <string>

class vtkMultiProcessController;
class vtkPoints;

namespace haptics
{
/// @brief Where the points of a part were in a version that a client has touched.
struct ServedShape
{
  vtkTypeUInt64 Version = 0;
  vtkSmartPointer<vtkPolyData> Part; ///< points and cells; null: there is none
};

/// @brief A surface that several processes have a part of each, to give a client what is near its
/// hand.
///
/// What belongs to the whole is worked out once, by a reduction over the processes; after that each
/// crops its own part, and none waits for another. Cells and points of the whole are counted from
/// the first process on.
class ServedSurface
{
public:
  /// How many triangles all processes have together. Collective.
  static vtkIdType Count(vtkIdType own, vtkMultiProcessController* processes);

  /// `part`: of this process, triangles without ghost cells; it is kept. `before`: what the client
  /// touches; where all processes have the same cells now, the surface is that one in another
  /// shape (WholeSurface::Before). Collective. Where it fails, in whichever process, the first one
  /// has the reason in Error().
  ServedSurface(vtkPolyData* part, vtkTypeUInt64 version, const ServedShape& before,
    vtkMultiProcessController* processes);

  /// In the first process: what belongs to the whole, and the box of its points. Null elsewhere,
  /// and where it cannot be touched.
  const PatchRecord* Whole() const { return this->Record.get(); }
  const PartBox& Box() const { return this->All; }
  const std::string& Error() const { return this->ErrorText; }

  /// The client touches this version from now on.
  void SetTouched() { this->IsTouched = true; }
  /// The version that it touches: this one, or one before in another shape, or none.
  ServedShape Touched() const;

  /// What this process has of a region, as CropPart() gives it.
  vtkSmartPointer<vtkPolyData> Crop(const PatchRegion& region) const;
  /// The triangle of this process that is nearest to a place, as CropNearest() gives it.
  vtkSmartPointer<vtkPolyData> Nearest(const Vec3& place) const;
  /// A few triangles, to see which arrays there are; no cells where this process has none.
  vtkSmartPointer<vtkPolyData> Sample() const;

private:
  vtkPoints* StartPoints() const;

  vtkSmartPointer<vtkPolyData> Part;
  vtkTypeUInt64 Version;
  ServedShape Before;
  bool IsTouched = false;
  std::unique_ptr<PolygonRuns> Runs;
  PartOffset Offset;
  PartBox All;
  std::unique_ptr<PatchRecord> Record;
  std::string ErrorText;
};
}

#endif
