#ifndef Haptics_Material_h
#define Haptics_Material_h

#include "haptics/Math/Vec3.h"

namespace haptics
{
class ForceProfile;

/// Texture changes a force by at most this share of it, either way.
constexpr double LargestTexture = 0.5;

/// @brief The material at a contact: the properties of the surfaces that hold the god-object, where
/// it stands, each by its share of the push. Device frame.
struct Material
{
  /// No surface has properties: nothing below counts, and nothing was looked up.
  bool IsPlain = true;
  bool IsShaded = false; ///< Contact::Shaded is not Contact::Displacement

  /// [N/m] of the surfaces that have a stiffness of their own, times their share of the push.
  double Stiffness = 0.0;
  /// Share of the push on surfaces without: what the servo's stiffness counts.
  double PlainShare = 1.0;
  double Damping = 0.0;         ///< [N s/m]
  double StaticFriction = 0.0;  ///< pull over push at which the god-object breaks away
  double DynamicFriction = 0.0; ///< pull over push while it slides
  double Texture = 0.0;         ///< by so much of itself the force is changed, +-LargestTexture
  ///@{
  /// How stiffness, plain share and texture rise along the surface, each facet by its share of the
  /// push: gradients over one metre of the hand's way. Zero where a value is the same all over, or
  /// over a triangle.
  Vec3 StiffnessGradient{};  ///< [N/m^2]
  Vec3 PlainShareGradient{}; ///< [1/m]
  Vec3 TextureGradient{};    ///< [1/m]
  ///@}
  ///@{
  /// The largest that these surfaces have anywhere.
  double LargestStiffness = 0.0;  ///< [N/m] of their own
  double LargestPlainShare = 1.0; ///< 0 or 1
  double LargestTexture = 0.0;    ///< >= 0
  ///@}
  /// In place of the stiffness; null: none. Of the surface that is pushed most, of several
  /// pushed as much the steepest; it lives as long as the god-object.
  const ForceProfile* Profile = nullptr;
};
}

#endif
