#include "haptics/Material/SurfaceProperties.h"

#include "haptics/Surface/ShadingNormals.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace haptics
{
namespace
{
const char* const Names[NumberOfProperties] = { "stiffness", "damping", "static friction",
  "dynamic friction", "texture" };

bool IsGood(Property property, double value)
{
  switch (property)
  {
    case Property::Stiffness:
      return std::isnan(value) || (std::isfinite(value) && value >= 0.0);
    case Property::Texture:
      return std::abs(value) <= LargestTexture; // false for NaN
    default:
      return std::isfinite(value) && value >= 0.0;
  }
}

std::string FindFault(
  Property property, const PropertyField& field, std::size_t triangles, std::size_t points)
{
  const std::string name = Names[static_cast<int>(property)];
  if (!IsGood(property, field.Constant))
  {
    return "the constant " + name + " is " + std::to_string(field.Constant);
  }
  if (field.Values.empty())
  {
    return {};
  }
  const std::size_t wanted = field.IsPerTriangle ? triangles : points;
  const char* const places = field.IsPerTriangle ? "triangles" : "points";
  if (field.Values.size() != wanted)
  {
    return "there are " + std::to_string(field.Values.size()) + " values of " + name + " for " +
      std::to_string(wanted) + " " + places;
  }
  const auto bad = std::find_if(field.Values.begin(), field.Values.end(),
    [property](float value) { return !IsGood(property, value); });
  if (bad != field.Values.end())
  {
    return "the " + name + " of number " + std::to_string(bad - field.Values.begin()) + " of the " +
      places + " is " + std::to_string(*bad);
  }
  return {};
}

std::string FindFault(const TextureImage& image, std::size_t points)
{
  if (image.Width <= 0 || image.Height <= 0 ||
    image.Values.size() != static_cast<std::size_t>(image.Width) * image.Height)
  {
    return "the texture image says " + std::to_string(image.Width) + " x " +
      std::to_string(image.Height) + " pixels and has " + std::to_string(image.Values.size());
  }
  if (image.Coordinates.size() != points)
  {
    return "the texture image has coordinates for " + std::to_string(image.Coordinates.size()) +
      " of " + std::to_string(points) + " points";
  }
  if (!std::all_of(image.Values.begin(), image.Values.end(),
        [](float value) { return IsGood(Property::Texture, value); }))
  {
    return "the texture image has a value that is not finite or beyond half the force";
  }
  // Larger ones have no digits left for a place within the picture.
  if (!std::all_of(image.Coordinates.begin(), image.Coordinates.end(),
        [](const auto& c) { return std::abs(c[0]) < 1e6 && std::abs(c[1]) < 1e6; }))
  {
    return "a texture coordinate is not finite, or beyond 1e6";
  }
  return {};
}

std::string FindFault(const PropertyValues& values, const TriangleSurface& surface)
{
  if (values.Corners.empty())
  {
    return {};
  }
  if (values.Corners.size() != surface.Triangles().size())
  {
    return "there are corners of " + std::to_string(values.Corners.size()) + " for " +
      std::to_string(surface.Triangles().size()) + " triangles";
  }
  const auto count = static_cast<std::int32_t>(values.NumberOfPointValues);
  const bool isGood = std::all_of(values.Corners.begin(), values.Corners.end(),
    [count](const Triangle& t)
    {
      return std::all_of(
        t.begin(), t.end(), [count](std::int32_t corner) { return corner >= 0 && corner < count; });
    });
  return isGood ? "" : "a corner has a number beyond the values";
}

/// The dynamic friction may not be above the static one at any place: it is enough that it is not
/// at the corners, as both are interpolated alike.
std::string FindFrictionFault(const PropertyValues& values, const TriangleSurface& surface)
{
  const PropertyField& hold = values.Fields[static_cast<int>(Property::StaticFriction)];
  const PropertyField& slide = values.Fields[static_cast<int>(Property::DynamicFriction)];
  const auto at = [](const PropertyField& field, std::size_t point, std::size_t triangle)
  {
    return field.Values.empty() ? field.Constant
                                : field.Values[field.IsPerTriangle ? triangle : point];
  };
  for (std::size_t i = 0; i < surface.Triangles().size(); ++i)
  {
    for (const std::int32_t corner : values.CornersOf(surface, i))
    {
      const double s = at(hold, corner, i);
      const double d = at(slide, corner, i);
      if (d > s * (1.0 + 1e-6))
      {
        return "the dynamic friction at point " + std::to_string(corner) + " is " +
          std::to_string(d) + ", above the static one, which is " + std::to_string(s);
      }
    }
    if (hold.Values.empty() && slide.Values.empty())
    {
      break; // the same everywhere
    }
  }
  return {};
}
}

PropertyValues::PropertyValues()
{
  (*this)[Property::Stiffness].Constant = std::numeric_limits<double>::quiet_NaN();
}

std::shared_ptr<const SurfaceProperties> SurfaceProperties::Build(
  PropertyValues values, const TriangleSurface& surface, std::string& error)
{
  error = FindFault(values, surface);
  const std::size_t points =
    values.Corners.empty() ? surface.Points().size() : values.NumberOfPointValues;
  for (int i = 0; i < NumberOfProperties && error.empty(); ++i)
  {
    error =
      FindFault(static_cast<Property>(i), values.Fields[i], surface.Triangles().size(), points);
  }
  if (error.empty())
  {
    error = FindFrictionFault(values, surface);
  }
  if (error.empty() && values.Image)
  {
    error = FindFault(*values.Image, points);
  }
  if (error.empty() && !(values.FeatureAngle >= 0.0 && values.FeatureAngle <= 180.0))
  {
    error =
      "the feature angle is " + std::to_string(values.FeatureAngle) + " degrees, not 0 to 180";
  }
  if (!error.empty())
  {
    return nullptr;
  }
  std::shared_ptr<SurfaceProperties> properties(new SurfaceProperties);
  properties->Values = std::move(values);
  properties->FindLargest();
  if (properties->Values.Shading)
  {
    properties->Normals = ShadingNormals(surface, properties->Values.FeatureAngle);
  }
  return properties;
}

bool SurfaceProperties::HasSameArrays(const PropertyValues& values) const
{
  // Bit for bit, as NaN counts.
  const auto isSame = [](const auto& a, const auto& b)
  {
    return a.size() == b.size() &&
      (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
  };
  for (int i = 0; i < NumberOfProperties; ++i)
  {
    const PropertyField& a = this->Values.Fields[i];
    const PropertyField& b = values.Fields[i];
    if (a.IsPerTriangle != b.IsPerTriangle || !isSame(a.Values, b.Values))
    {
      return false;
    }
  }
  if (!isSame(this->Values.Corners, values.Corners))
  {
    return false;
  }
  const bool hasImage = this->Values.Image != nullptr;
  return hasImage == (values.Image != nullptr) &&
    (!hasImage || isSame(this->Values.Image->Coordinates, values.Image->Coordinates));
}

double SurfaceProperties::Value(Property property, const Triangle& corners, std::int32_t triangle,
  const Corners& weights) const noexcept
{
  const PropertyField& field = this->Values.Fields[static_cast<int>(property)];
  if (field.Values.empty())
  {
    return field.Constant;
  }
  if (field.IsPerTriangle)
  {
    return field.Values[triangle];
  }
  return weights[0] * field.Values[corners[0]] + weights[1] * field.Values[corners[1]] +
    weights[2] * field.Values[corners[2]];
}

Material SurfaceProperties::At(
  const Triangle& points, std::int32_t triangle, const Corners& weights) const noexcept
{
  const Triangle& corners = this->CornersOf(points, triangle);
  Material material;
  material.IsPlain = false;
  const PropertyField& stiffness = this->Values.Fields[static_cast<int>(Property::Stiffness)];
  if (stiffness.Values.empty() || stiffness.IsPerTriangle)
  {
    const double value = stiffness.IsPerTriangle && !stiffness.Values.empty()
      ? stiffness.Values[triangle]
      : stiffness.Constant;
    material.PlainShare = std::isnan(value) ? 1.0 : 0.0;
    material.Stiffness = std::isnan(value) ? 0.0 : value;
  }
  else
  {
    // A corner without a stiffness of its own counts with the servo's.
    material.PlainShare = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const float value = stiffness.Values[corners[k]];
      (std::isnan(value) ? material.PlainShare : material.Stiffness) +=
        std::isnan(value) ? weights[k] : weights[k] * value;
    }
  }
  material.Damping = this->Value(Property::Damping, corners, triangle, weights);
  material.StaticFriction = this->Value(Property::StaticFriction, corners, triangle, weights);
  material.DynamicFriction = this->Value(Property::DynamicFriction, corners, triangle, weights);
  material.Texture = this->Value(Property::Texture, corners, triangle, weights);
  if (this->Values.Image)
  {
    double rises[2];
    material.Texture = std::clamp(material.Texture + this->Grey(corners, weights, rises),
      -haptics::LargestTexture, haptics::LargestTexture);
  }
  material.LargestStiffness = this->LargestStiffness;
  material.LargestPlainShare = this->LargestPlainShare;
  material.LargestTexture = this->LargestTexture;
  material.Profile = this->Values.Profile.get();
  return material;
}

void SurfaceProperties::AddGradients(const Triangle& points, std::int32_t triangle,
  const Corners& weights, const std::array<Vec3, 2>& rises, Material& material) const noexcept
{
  const Triangle& corners = this->CornersOf(points, triangle);
  const auto add = [&rises](Vec3& gradient, const double slopes[2])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] += slopes[0] * rises[0][axis] + slopes[1] * rises[1][axis];
    }
  };
  const auto varies = [this](Property property)
  {
    const PropertyField& field = this->Values.Fields[static_cast<int>(property)];
    return !field.Values.empty() && !field.IsPerTriangle;
  };
  if (varies(Property::Stiffness))
  {
    const auto& values = this->Values.Fields[static_cast<int>(Property::Stiffness)].Values;
    double own[3];
    double plain[3];
    for (int k = 0; k < 3; ++k)
    {
      const float value = values[corners[k]];
      own[k] = std::isnan(value) ? 0.0 : value;
      plain[k] = std::isnan(value) ? 1.0 : 0.0;
    }
    const double ofOwn[2] = { own[1] - own[0], own[2] - own[0] };
    const double ofPlain[2] = { plain[1] - plain[0], plain[2] - plain[0] };
    add(material.StiffnessGradient, ofOwn);
    add(material.PlainShareGradient, ofPlain);
  }
  double texture = this->Value(Property::Texture, corners, triangle, weights);
  double slopes[2] = { 0.0, 0.0 };
  if (this->Values.Image)
  {
    texture += this->Grey(corners, weights, slopes);
  }
  if (std::abs(texture) > haptics::LargestTexture)
  {
    return; // cut off
  }
  if (varies(Property::Texture))
  {
    const auto& values = this->Values.Fields[static_cast<int>(Property::Texture)].Values;
    slopes[0] += values[corners[1]] - values[corners[0]];
    slopes[1] += values[corners[2]] - values[corners[0]];
  }
  add(material.TextureGradient, slopes);
}

void SurfaceProperties::FindLargest()
{
  const PropertyField& stiffness = this->Values[Property::Stiffness];
  const PropertyField& texture = this->Values[Property::Texture];
  const auto add = [this](double value)
  {
    std::isnan(value) ? this->LargestPlainShare = 1.0
                      : this->LargestStiffness = std::max(this->LargestStiffness, value);
  };
  if (stiffness.Values.empty())
  {
    add(stiffness.Constant);
  }
  std::for_each(stiffness.Values.begin(), stiffness.Values.end(), add);
  double largest = texture.Values.empty()
    ? texture.Constant
    : *std::max_element(texture.Values.begin(), texture.Values.end());
  if (this->Values.Image)
  {
    largest +=
      *std::max_element(this->Values.Image->Values.begin(), this->Values.Image->Values.end());
  }
  this->LargestTexture = std::clamp(largest, 0.0, haptics::LargestTexture);
  const auto varies = [](const PropertyField& field)
  { return !field.Values.empty() && !field.IsPerTriangle; };
  this->HasSlopes = varies(stiffness) || varies(texture) || this->Values.Image;
}

double SurfaceProperties::Grey(
  const Triangle& corners, const Corners& weights, double rises[2]) const noexcept
{
  const TextureImage& image = *this->Values.Image;
  double place[2];
  for (int axis = 0; axis < 2; ++axis)
  {
    double at = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      at += weights[k] * image.Coordinates[corners[k]][axis];
    }
    place[axis] = at - std::floor(at);
  }
  // Values are those of the pixels' middles.
  const auto pixels = [](double at, int size, int& low, int& high)
  {
    const double x = at * size - 0.5;
    const int floor = static_cast<int>(std::floor(x));
    low = (floor + size) % size;
    high = (floor + 1) % size;
    return x - floor;
  };
  int left, right, below, above;
  const double across = pixels(place[0], image.Width, left, right);
  const double up = pixels(place[1], image.Height, below, above);
  const auto grey = [&image](int column, int row) {
    return static_cast<double>(image.Values[static_cast<std::size_t>(row) * image.Width + column]);
  };
  const double low = grey(left, below) + across * (grey(right, below) - grey(left, below));
  const double high = grey(left, above) + across * (grey(right, above) - grey(left, above));
  // Along the picture's axes, and from there along the triangle's sides.
  const double alongX = image.Width *
    ((1.0 - up) * (grey(right, below) - grey(left, below)) +
      up * (grey(right, above) - grey(left, above)));
  const double alongY = image.Height * (high - low);
  const auto& first = image.Coordinates[corners[0]];
  for (int k = 0; k < 2; ++k)
  {
    const auto& other = image.Coordinates[corners[k + 1]];
    rises[k] = alongX * (other[0] - first[0]) + alongY * (other[1] - first[1]);
  }
  return low + up * (high - low);
}

Vec3 SurfaceProperties::NormalAt(std::int32_t triangle, const Corners& weights) const noexcept
{
  Vec3 normal{};
  for (int k = 0; k < 3; ++k)
  {
    const auto& corner = this->Normals[3 * static_cast<std::size_t>(triangle) + k];
    for (int axis = 0; axis < 3; ++axis)
    {
      normal[axis] += weights[k] * corner[axis];
    }
  }
  return normal;
}
}
