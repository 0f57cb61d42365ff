#ifndef Haptics_PropertyArrays_h
#define Haptics_PropertyArrays_h

#include "haptics/Material/SurfaceProperties.h"

#include "vtkType.h"

#include <array>
#include <optional>
#include <string>

class vtkDataArray;
class vtkPiecewiseFunction;

namespace haptics
{
/// How the values of an array become those of a property.
struct PropertyMapping
{
  vtkPiecewiseFunction* Function = nullptr;   ///< goes first
  vtkPiecewiseFunction* Curve = nullptr;      ///< through the range, both from 0 to 1
  std::optional<std::array<double, 2>> Range; ///< of the property, over the array's own
  const double* WholeRange = nullptr;         ///< of a patch: the array's in the whole surface
  double Lowest = 0.0;                        ///< what the property may be
  double Highest = 0.0;
  bool CutsOff = false; ///< to Lowest and Highest, in place of the constant
};

/// @brief One value of a property for each of an array's. Where one is no good it is `constant`.
///
/// Returns what is wrong, with the first place; empty where nothing is. Where the array as a whole
/// is no good (more than one component, another number of values than `wanted`) the field has none.
std::string MapArray(vtkDataArray* array, const PropertyMapping& mapping, double constant,
  vtkIdType wanted, PropertyField& field);

/// Where the dynamic friction is above the static one, the static one becomes that.
void RaiseStaticFriction(PropertyValues& values, const TriangleSurface& surface);
}

#endif
