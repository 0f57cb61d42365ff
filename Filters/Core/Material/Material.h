#ifndef Haptics_Material_h
#define Haptics_Material_h

namespace haptics
{
class ForceProfile;

/// Texture changes a force by at most this share of it, either way.
constexpr double LargestTexture = 0.5;

/// @brief What a contact feels like: the properties of the surfaces that hold the god-object, where
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
  /// In place of the stiffness; null: none. Of the surface that is pushed most; it lives as long
  /// as the god-object.
  const ForceProfile* Profile = nullptr;
};
}

#endif
