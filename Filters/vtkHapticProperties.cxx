#include "vtkHapticProperties.h"

#include "haptics/Filters/DataPoints.h"
#include "haptics/Filters/NumberSetting.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/PropertyArrays.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace
{
struct PropertyFacts
{
  const char* Name;
  const char* Unit;
  double Lowest;
  double Highest;
};
// No value is too much for what limits it in the hand; but squares of it have to stay finite.
const PropertyFacts Facts[vtkHapticProperties::NUMBER_OF_PROPERTIES] = {
  { "stiffness", " N/m", 0.0, 1e30 }, { "damping", " N s/m", 0.0, 1e30 },
  { "static friction", "", 0.0, 1e6 }, { "dynamic friction", "", 0.0, 1e6 },
  { "texture", "", -haptics::LargestTexture, haptics::LargestTexture }
};
constexpr int ProfileSteps = 256;
/// Of the depth of a button's click: over so much of it the force drops.
constexpr double ClickShare = 0.1;

static_assert(static_cast<int>(haptics::Property::Texture) == vtkHapticProperties::TEXTURE &&
    haptics::NumberOfProperties == vtkHapticProperties::NUMBER_OF_PROPERTIES,
  "both list the same properties");

void AddProblem(std::string& problems, const std::string& problem)
{
  problems += (problems.empty() ? "" : " ") + problem;
}
}

struct vtkHapticProperties::Source
{
  double Constant = 0.0;
  vtkSmartPointer<vtkPiecewiseFunction> Function;
  std::optional<std::array<double, 2>> Range;
  vtkSmartPointer<vtkPiecewiseFunction> Curve;
};

vtkStandardNewMacro(vtkHapticProperties);

vtkHapticProperties::vtkHapticProperties()
  : Sources(new std::array<Source, NUMBER_OF_PROPERTIES>)
{
}

vtkHapticProperties::~vtkHapticProperties() = default;

void vtkHapticProperties::SetTextureAmplitude(double value)
{
  haptics::SetNumber(this, "TextureAmplitude", this->TextureAmplitude, value, 0.0, 0.5);
}

void vtkHapticProperties::SetFeatureAngle(double value)
{
  haptics::SetNumber(this, "FeatureAngle", this->FeatureAngle, value, 0.0, 180.0);
}

const char* vtkHapticProperties::GetPropertyName(int property)
{
  return property >= 0 && property < NUMBER_OF_PROPERTIES ? Facts[property].Name : "";
}

bool vtkHapticProperties::IsProperty(int property)
{
  if (property >= 0 && property < NUMBER_OF_PROPERTIES)
  {
    return true;
  }
  vtkErrorMacro("There is no haptic property " << property << "; they go from 0 to "
                                               << NUMBER_OF_PROPERTIES - 1 << ".");
  return false;
}

void vtkHapticProperties::SetConstant(int property, double value)
{
  if (!this->IsProperty(property))
  {
    return;
  }
  const PropertyFacts& facts = Facts[property];
  double& constant = (*this->Sources)[property].Constant;
  if (!(value >= facts.Lowest && value <= facts.Highest))
  {
    vtkErrorMacro("The " << facts.Name << " has to be from " << facts.Lowest << " to "
                         << facts.Highest << facts.Unit << ", but is " << value << "; it stays "
                         << constant << ".");
    return;
  }
  if (constant != value)
  {
    constant = value;
    this->Modified();
  }
}

double vtkHapticProperties::GetConstant(int property)
{
  return this->IsProperty(property) ? (*this->Sources)[property].Constant : 0.0;
}

void vtkHapticProperties::SetFunction(int property, vtkPiecewiseFunction* function)
{
  if (this->IsProperty(property) && (*this->Sources)[property].Function != function)
  {
    (*this->Sources)[property].Function = function;
    this->Modified();
  }
}

vtkPiecewiseFunction* vtkHapticProperties::GetFunction(int property)
{
  return this->IsProperty(property) ? (*this->Sources)[property].Function.Get() : nullptr;
}

void vtkHapticProperties::SetRange(int property, double atLeast, double atGreatest)
{
  if (!this->IsProperty(property))
  {
    return;
  }
  const PropertyFacts& facts = Facts[property];
  if (!(std::min(atLeast, atGreatest) >= facts.Lowest &&
        std::max(atLeast, atGreatest) <= facts.Highest))
  {
    vtkErrorMacro("The range of the "
      << facts.Name << " has to be within " << facts.Lowest << " and " << facts.Highest
      << facts.Unit << ", but is " << atLeast << " to " << atGreatest << "; the last one stays.");
    return;
  }
  const std::array<double, 2> range{ atLeast, atGreatest };
  if ((*this->Sources)[property].Range != range)
  {
    (*this->Sources)[property].Range = range;
    this->Modified();
  }
}

bool vtkHapticProperties::HasRange(int property)
{
  return this->IsProperty(property) && (*this->Sources)[property].Range.has_value();
}

void vtkHapticProperties::GetRange(int property, double range[2])
{
  const bool hasRange = this->HasRange(property);
  range[0] = hasRange ? (*(*this->Sources)[property].Range)[0] : 0.0;
  range[1] = hasRange ? (*(*this->Sources)[property].Range)[1] : 0.0;
}

void vtkHapticProperties::ClearRange(int property)
{
  if (this->HasRange(property))
  {
    (*this->Sources)[property].Range.reset();
    this->Modified();
  }
}

void vtkHapticProperties::SetCurve(int property, vtkPiecewiseFunction* curve)
{
  if (this->IsProperty(property) && (*this->Sources)[property].Curve != curve)
  {
    (*this->Sources)[property].Curve = curve;
    this->Modified();
  }
}

vtkPiecewiseFunction* vtkHapticProperties::GetCurve(int property)
{
  return this->IsProperty(property) ? (*this->Sources)[property].Curve.Get() : nullptr;
}

void vtkHapticProperties::SetForceProfile(vtkPiecewiseFunction* profile)
{
  if (this->ForceProfile != profile)
  {
    this->ForceProfile = profile;
    this->Modified();
  }
}

vtkPiecewiseFunction* vtkHapticProperties::GetForceProfile()
{
  return this->ForceProfile;
}

void vtkHapticProperties::SetForceProfileToButton(double stiffness, double depth, double drop)
{
  if (!(stiffness > 0.0 && stiffness <= Facts[STIFFNESS].Highest && depth > 0.0 && depth < 1e6))
  {
    vtkErrorMacro("A button needs a stiffness above 0 N/m and a depth above 0 m, but has "
      << stiffness << " N/m and " << depth << " m; the last force profile stays.");
    return;
  }
  const double click = stiffness * depth;
  const double bottom = click * (drop > 0.0 ? std::min(drop, 1.0) : 0.0);
  vtkNew<vtkPiecewiseFunction> button;
  button->AddPoint(0.0, 0.0);
  button->AddPoint(depth, click);
  button->AddPoint((1.0 + ClickShare) * depth, bottom);
  button->AddPoint(2.0 * depth, bottom + stiffness * (1.0 - ClickShare) * depth);
  this->SetForceProfile(button);
}

void vtkHapticProperties::SetTextureImage(vtkImageData* image)
{
  if (this->TextureImage != image)
  {
    this->TextureImage = image;
    this->Modified();
  }
}

vtkImageData* vtkHapticProperties::GetTextureImage()
{
  return this->TextureImage;
}

vtkMTimeType vtkHapticProperties::GetMTime()
{
  vtkMTimeType latest = this->Superclass::GetMTime();
  const auto include = [&latest](vtkObject* object)
  { latest = std::max(latest, object ? object->GetMTime() : 0); };
  for (const Source& source : *this->Sources)
  {
    include(source.Function);
    include(source.Curve);
  }
  include(this->ForceProfile);
  include(this->TextureImage);
  return latest;
}

std::shared_ptr<const haptics::SurfaceProperties> vtkHapticProperties::Build(vtkPolyData* geometry,
  const haptics::TriangleSurface& surface, const ArrayChoice& choose,
  std::shared_ptr<const haptics::SurfaceProperties> previous, std::string& problems)
{
  bool isPlain = !this->ForceProfile && !this->TextureImage && !this->ForceShading;
  haptics::PropertyValues values;
  values.Corners = haptics::DataCorners(geometry, surface);
  values.NumberOfPointValues = static_cast<std::size_t>(geometry->GetNumberOfPoints());
  for (int i = 0; i < NUMBER_OF_PROPERTIES; ++i)
  {
    const Source& source = (*this->Sources)[i];
    haptics::PropertyField& field = values[static_cast<haptics::Property>(i)];
    if (i != STIFFNESS || source.Constant > 0.0)
    {
      field.Constant = source.Constant;
    }
    isPlain = isPlain && source.Constant == 0.0;
    const ChosenArray chosen = choose(i);
    if (chosen.Array)
    {
      field.IsPerTriangle = chosen.IsPerCell;
      const haptics::PropertyMapping mapping{ source.Function, source.Curve, source.Range,
        haptics::PatchRecord::RangeIn(
          geometry->GetFieldData(), chosen.IsPerCell, chosen.Array->GetName()),
        Facts[i].Lowest, Facts[i].Highest, i == TEXTURE };
      const std::size_t wanted =
        chosen.IsPerCell ? surface.Triangles().size() : values.NumberOfPointValues;
      const std::string problem = haptics::MapArray(
        chosen.Array, mapping, field.Constant, static_cast<vtkIdType>(wanted), field);
      if (!problem.empty())
      {
        const char* const name = chosen.Array->GetName();
        AddProblem(problems,
          std::string("The array ") + (name ? name : "without a name") + " for the " +
            Facts[i].Name + " " + problem + "; the constant is used there.");
      }
      isPlain = isPlain && field.Values.empty();
    }
    else if (!chosen.Missing.empty())
    {
      AddProblem(problems,
        "There is no array " + chosen.Missing + " for the " + Facts[i].Name +
          "; the constant is used.");
    }
  }
  this->AddProfile(values, problems);
  if (this->TextureImage)
  {
    this->AddImage(geometry, values, problems);
  }
  if (isPlain)
  {
    return nullptr;
  }
  values.Shading = this->ForceShading;
  values.FeatureAngle = this->FeatureAngle;
  haptics::RaiseStaticFriction(values, surface);
  if (previous && previous->HasSameArrays(values))
  {
    return previous;
  }
  std::string error;
  auto properties = haptics::SurfaceProperties::Build(std::move(values), surface, error);
  if (!properties)
  {
    AddProblem(problems, "The surface stays plain: " + error + ".");
  }
  return properties;
}

void vtkHapticProperties::AddProfile(haptics::PropertyValues& values, std::string& problems)
{
  if (!this->ForceProfile)
  {
    return;
  }
  const double* const range = this->ForceProfile->GetRange();
  std::vector<double> forces(ProfileSteps + 1);
  for (int i = 0; i <= ProfileSteps; ++i)
  {
    forces[i] = this->ForceProfile->GetValue(range[1] * i / ProfileSteps);
  }
  std::string error;
  if (range[0] != 0.0)
  {
    error = "it begins at " + std::to_string(range[0]) + " m, not at 0";
  }
  else
  {
    values.Profile = haptics::ForceProfile::Build(forces, range[1], error);
  }
  if (!values.Profile)
  {
    AddProblem(problems, "The force profile is left out: " + error + ".");
  }
}

void vtkHapticProperties::AddImage(
  vtkPolyData* geometry, haptics::PropertyValues& values, std::string& problems)
{
  vtkDataArray* const coordinates = geometry->GetPointData()->GetTCoords();
  vtkDataArray* const pixels = this->TextureImage->GetPointData()->GetScalars();
  int size[3];
  this->TextureImage->GetDimensions(size);
  if (!coordinates || coordinates->GetNumberOfComponents() < 2 || !pixels || size[2] != 1)
  {
    AddProblem(problems,
      coordinates ? "The texture image is left out: it is not flat, or has no scalars."
                  : "The texture image is left out: the surface has no texture coordinates.");
    return;
  }
  double range[2];
  pixels->GetFiniteRange(range, 0);
  auto image = std::make_shared<haptics::TextureImage>();
  image->Width = size[0];
  image->Height = size[1];
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    const double grey = pixels->GetComponent(i, 0);
    const double share =
      range[1] > range[0] && std::isfinite(grey) ? (grey - range[0]) / (range[1] - range[0]) : 0.5;
    image->Values.push_back(static_cast<float>(this->TextureAmplitude * (2.0 * share - 1.0)));
  }
  for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
  {
    image->Coordinates.push_back({ static_cast<float>(coordinates->GetComponent(i, 0)),
      static_cast<float>(coordinates->GetComponent(i, 1)) });
  }
  values.Image = image;
}

void vtkHapticProperties::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (int i = 0; i < NUMBER_OF_PROPERTIES; ++i)
  {
    const Source& source = (*this->Sources)[i];
    os << indent << Facts[i].Name << ": " << source.Constant << Facts[i].Unit;
    if (source.Range)
    {
      os << ", from an array: " << (*source.Range)[0] << " to " << (*source.Range)[1];
    }
    os << (source.Function ? ", by a function\n" : "\n");
  }
  os << indent << "ForceProfile: " << this->ForceProfile.Get() << "\n";
  os << indent << "TextureImage: " << this->TextureImage.Get() << "\n";
  os << indent << "TextureAmplitude: " << this->TextureAmplitude << "\n";
  os << indent << "ForceShading: " << (this->ForceShading ? "On\n" : "Off\n");
  os << indent << "FeatureAngle: " << this->FeatureAngle << " degrees\n";
}
