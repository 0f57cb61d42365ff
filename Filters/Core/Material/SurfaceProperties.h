#ifndef Haptics_SurfaceProperties_h
#define Haptics_SurfaceProperties_h

#include "haptics/Material/ForceProfile.h"
#include "haptics/Material/Material.h"
#include "haptics/Surface/TriangleSurface.h"
#include "vtkHapticsCoreModule.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace haptics
{
/// What may differ from place to place on a surface.
enum class Property
{
  Stiffness,       ///< [N/m], device frame; NaN: the servo's
  Damping,         ///< [N s/m], device frame, against the hand's motion in contact
  StaticFriction,  ///< pull over push
  DynamicFriction, ///< pull over push; not above the static one
  Texture          ///< share of the force, +-LargestTexture
};
constexpr int NumberOfProperties = 5;

/// One property over a surface: the same everywhere, or a value a point or a triangle.
struct PropertyField
{
  double Constant = 0.0;     ///< where Values is empty
  std::vector<float> Values; ///< between points they are interpolated over the triangle
  bool IsPerTriangle = false;
};

/// A picture laid over a surface, whose grey is texture. Between pixels it is interpolated; beyond
/// its borders it repeats.
struct TextureImage
{
  int Width = 0;  ///< pixels, > 0
  int Height = 0; ///< pixels, > 0
  /// Row after row from below, shares of the force: +-LargestTexture.
  std::vector<float> Values;
  /// For each point where it lies in the picture: 0 to 1 across and up.
  std::vector<std::array<float, 2>> Coordinates;
};

/// What SurfaceProperties are built from.
struct PropertyValues
{
  std::array<PropertyField, NumberOfProperties> Fields;
  /// For each triangle the numbers of the values at its corners, in fields and image; empty: they
  /// are those of the surface's points. So cells that share a point may have values of their own.
  std::vector<Triangle> Corners;
  std::size_t NumberOfPointValues = 0; ///< that Corners go up to; unused where they are empty
  std::shared_ptr<const ForceProfile> Profile; ///< null: a linear spring
  std::shared_ptr<const TextureImage> Image;   ///< null: none; adds to the field's texture
  /// Force shading: interpolated normals. Default off.
  bool Shading = false;
  /// Edges between facets that turn by more than this stay sharp under shading [degrees], 0 to 180.
  double FeatureAngle = 30.0;

  const Triangle& CornersOf(const TriangleSurface& surface, std::size_t triangle) const
  {
    return this->Corners.empty() ? surface.Triangles()[triangle] : this->Corners[triangle];
  }
  PropertyField& operator[](Property property) { return this->Fields[static_cast<int>(property)]; }

  /// The servo's stiffness and nothing else.
  PropertyValues();
};

/// @brief The material of a surface: immutable, shared, read from any thread.
///
/// Built once off the servo thread for one surface. A look-up takes a triangle and a place in it,
/// allocates nothing and costs a few dozen nanoseconds.
class VTKHAPTICSCORE_EXPORT SurfaceProperties
{
public:
  /// Null, and in `error` what is wrong and where: a value that is not finite, below 0 (texture:
  /// beyond LargestTexture), another number of values than points or triangles, a dynamic friction
  /// above the static one, an image of another size than it says.
  static std::shared_ptr<const SurfaceProperties> Build(
    PropertyValues values, const TriangleSurface& surface, std::string& error);

  /// Whether these were built from the same values at points, triangles and texture coordinates;
  /// constants, profile and picture are not looked at.
  bool HasSameArrays(const PropertyValues& values) const;

  using Corners = std::array<double, 3>; ///< weights of a triangle's corners, sum 1

  /// The properties at a place of a triangle of the surface, as if it were all of the contact.
  /// `points`: the triangle's corners. Without gradients.
  Material At(const Triangle& points, std::int32_t triangle, const Corners& weights) const noexcept;
  /// Whether stiffness or texture varies over triangles.
  bool HasGradients() const noexcept { return this->HasSlopes; }
  /// Adds the gradients there to what At() gave. `rises`: the gradients of the weights of the
  /// second and third corner; what comes out has their frame and unit.
  void AddGradients(const Triangle& points, std::int32_t triangle, const Corners& weights,
    const std::array<Vec3, 2>& rises, Material& material) const noexcept;
  bool IsShaded() const noexcept { return !this->Normals.empty(); }
  /// The interpolated normal there, surface frame, not of unit length. Only where IsShaded().
  Vec3 NormalAt(std::int32_t triangle, const Corners& weights) const noexcept;

private:
  SurfaceProperties() = default;

  double Value(Property property, const Triangle& corners, std::int32_t triangle,
    const Corners& weights) const noexcept;
  /// The image's grey there, and how it rises with the weights of the second and third corner.
  double Grey(const Triangle& corners, const Corners& weights, double rises[2]) const noexcept;
  void FindLargest();
  const Triangle& CornersOf(const Triangle& points, std::int32_t triangle) const noexcept
  {
    return this->Values.Corners.empty() ? points
                                        : this->Values.Corners[static_cast<std::size_t>(triangle)];
  }

  PropertyValues Values;
  bool HasSlopes = false;
  double LargestStiffness = 0.0;
  double LargestPlainShare = 0.0;
  double LargestTexture = 0.0;
  std::vector<std::array<float, 3>> Normals; ///< three a triangle; empty without shading
};
}

#endif
