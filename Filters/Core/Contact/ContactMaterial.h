#ifndef Haptics_ContactMaterial_h
#define Haptics_ContactMaterial_h

#include "haptics/Contact/GodObjectState.h"
#include "haptics/Material/MaterialBlend.h"

#include <vector>

namespace haptics
{
/// @brief The material of a contact, from those of the surfaces that hold the god-object.
class ContactMaterial
{
public:
  explicit ContactMaterial(GodObjectState& god)
    : God(god)
    , Along(god.Around.TouchableCount)
  {
  }

  /// Blends the materials of the surfaces that hold the god-object here, into the result.
  void Update()
  {
    if (this->God.Around.HasProperties)
    {
      this->Blend();
    }
  }

private:
  void Blend();
  void AddMaterials(const ActivePlane& plane, double push, MaterialBlend& blend);
  void AddMaterial(
    const FacetId& facet, double push, const Vector& normal, MaterialBlend& blend) const;

  GodObjectState& God;
  std::vector<FacetAlong> Along; ///< of each touchable surface, where a plane holds
};
}

#endif
