#include "vtkHapticProbe.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

vtkStandardNewMacro(vtkHapticProbe);

namespace
{
constexpr int MostLines = 8;
/// Places this share of a surface's size apart have different digits.
constexpr double Resolution = 1e-4;

constexpr int MostDecimals = 9; // that are written out
constexpr double LargestWritten = 1e9;

/// How many digits a coordinate takes for that, five at least.
int DigitsOf(double coordinate, double step)
{
  if (!(step > 0.0) || !(std::abs(coordinate) > step))
  {
    return 5;
  }
  const double digits =
    1.0 + std::floor(std::log10(std::abs(coordinate))) - std::floor(std::log10(step));
  return static_cast<int>(std::clamp(digits, 5.0, 17.0));
}

/// As many decimals wherever the hand is on a surface, so that the text does not jump; what
/// rounding has left of zero is zero.
void WritePlace(std::ostream& text, const double place[3], double size)
{
  const double step = Resolution * size;
  const double power = step > 0.0 ? std::floor(std::log10(step)) : 0.0;
  const double least = step > 0.0 ? 0.05 * std::pow(10.0, power) : 0.0;
  const double largest = std::max({ std::abs(place[0]), std::abs(place[1]), std::abs(place[2]) });
  const bool isWrittenOut = step > 0.0 && 1.0 - power <= MostDecimals && largest < LargestWritten;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double coordinate = std::abs(place[axis]) < least ? 0.0 : place[axis];
    text << (axis > 0 ? ", " : "");
    if (isWrittenOut)
    {
      text << std::fixed << std::setprecision(static_cast<int>(std::max(0.0, 1.0 - power)));
    }
    else
    {
      text << std::setprecision(DigitsOf(coordinate, step));
    }
    text << coordinate << std::defaultfloat;
  }
}

/// The id of the touched cell in the data that its surface is the outside of, where the filter that
/// extracted it has kept that.
vtkIdType OriginalCell(vtkDataSetAttributes* values, vtkIdType cell)
{
  vtkDataArray* ids = values->GetArray("vtkOriginalCellIds");
  return ids && ids->GetNumberOfTuples() > 0 ? static_cast<vtkIdType>(ids->GetComponent(0, 0))
                                             : cell;
}

void WriteValues(std::ostream& text, vtkDataSetAttributes* values, int& lines)
{
  for (int i = 0; i < values->GetNumberOfArrays() && lines < MostLines; ++i)
  {
    vtkAbstractArray* array = values->GetAbstractArray(i);
    const int components = array->GetNumberOfComponents();
    if (array->GetName() && std::string(array->GetName()).rfind("vtk", 0) == 0)
    {
      continue; // the bookkeeping of filters
    }
    text << "\n" << (array->GetName() ? array->GetName() : "(unnamed)") << "  ";
    for (int c = 0; c < components && c < 3; ++c)
    {
      text << (c ? ", " : "") << array->GetVariantValue(c).ToString();
    }
    text << (components > 3 ? ", ..." : "");
    ++lines;
  }
}
}

vtkHapticProbe::vtkHapticProbe() = default;
vtkHapticProbe::~vtkHapticProbe() = default;

vtkIdType vtkHapticProbe::GetPointId(int corner)
{
  return corner >= 0 && corner < 3 ? this->PointIds[corner] : -1;
}

double vtkHapticProbe::GetWeight(int corner)
{
  return corner >= 0 && corner < 3 ? this->Weights[corner] : 0.0;
}

vtkPointData* vtkHapticProbe::GetPointValues()
{
  return this->PointValues;
}

vtkCellData* vtkHapticProbe::GetCellValues()
{
  return this->CellValues;
}

double vtkHapticProbe::GetValue(const char* array)
{
  vtkDataArray* values = array ? this->PointValues->GetArray(array) : nullptr;
  if (array && !values)
  {
    values = this->CellValues->GetArray(array);
  }
  return values && values->GetNumberOfTuples() > 0 ? values->GetComponent(0, 0) : vtkMath::Nan();
}

std::string vtkHapticProbe::GetSurfaceName()
{
  return this->SurfaceName.empty() && this->Surface >= 0
    ? "surface " + std::to_string(this->Surface)
    : this->SurfaceName;
}

std::string vtkHapticProbe::GetText()
{
  if (!this->Touching)
  {
    return {};
  }
  std::ostringstream text;
  text << this->GetSurfaceName() << "   cell " << OriginalCell(this->CellValues, this->Cell)
       << "\n";
  const double size = this->Where.Surface ? this->Where.Surface->Diagonal() : 0.0;
  WritePlace(text, this->Position, size);
  int lines = 0;
  WriteValues(text, this->PointValues, lines);
  WriteValues(text, this->CellValues, lines);
  return text.str();
}

void vtkHapticProbe::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const double v[3])
  { os << indent << name << ": (" << v[0] << ", " << v[1] << ", " << v[2] << ")\n"; };
  os << indent << "Touching: " << (this->Touching ? "yes" : "no") << "\n";
  os << indent << "Time [s]: " << this->Time << "\n";
  os << indent << "Surface: " << this->Surface << "\n";
  os << indent << "Cell: " << this->Cell << "\n";
  os << indent << "PointIds: " << this->PointIds[0] << ", " << this->PointIds[1] << ", "
     << this->PointIds[2] << "\n";
  print("Weights", this->Weights);
  print("Position [world unit]", this->Position);
  print("Normal", this->Normal);
  print("Force [N]", this->Force);
  print("HapticInterfacePoint [world unit]", this->HapticInterfacePoint);
  os << indent << "Penetration [world unit]: " << this->Penetration << "\n";
}
