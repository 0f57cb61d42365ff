#ifndef Haptics_ClippedGeometry_h
#define Haptics_ClippedGeometry_h

#include "haptics/Scene/ActorMatrix.h"
#include "vtkIdTypeArray.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"

#include <array>
#include <vector>

class vtkAlgorithmOutput;
class vtkMapper;

namespace haptics
{
/// @brief The part of a mapper's input that its clipping planes leave.
///
/// As the mapper draws it: a point is kept where every plane's function is >= 0, its normal
/// pointing to what is kept. The planes are in the world frame, the geometry in the actor's; they
/// are brought into that, so that the matrix counts. Runs again only where the input, a plane or
/// the actor's place has changed. An output without cells is no error. GUI thread.
class ClippedGeometry : public vtkPolyDataAlgorithm
{
public:
  static ClippedGeometry* New();
  vtkTypeMacro(ClippedGeometry, vtkPolyDataAlgorithm);

  /// Takes the planes of a mapper whose actor is at `matrix`, which maps to the world. Null where
  /// there are none, or the matrix is flat or not finite; else the port of what they leave.
  vtkAlgorithmOutput* Follow(
    vtkMapper* mapper, vtkAlgorithmOutput* geometry, const Matrix4& matrix);

  /// For each cell of the output the input's; another array after each run.
  vtkIdTypeArray* Cells() const { return this->OriginalCells; }

protected:
  ClippedGeometry() = default;
  ~ClippedGeometry() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  /// a x + b y + c z + d >= 0 is kept.
  using Equation = std::array<double, 4>;

  std::vector<Equation> Planes; ///< in the frame of the geometry
  vtkSmartPointer<vtkIdTypeArray> OriginalCells;
};
}

#endif
