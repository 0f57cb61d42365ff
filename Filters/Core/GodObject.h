#ifndef GodObject_h
#define GodObject_h

#include "TriangleSurface.h"
#include "Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace haptics
{
/// One plane that held the god-object back at the end of an update.
struct Constraint
{
  Vec3 Normal{};              ///< unit, world frame, towards the god-object
  std::int32_t Surface = -1;  ///< index in the list given to GodObject
  std::int32_t Triangle = -1; ///< index in that surface
};

enum class UpdateStatus
{
  Free,       ///< the god-object is at the HIP
  Touching,   ///< constraints hold the god-object back
  InvalidHip, ///< the HIP is not finite or absurdly far: nothing moved, ask for no force
  Overloaded  ///< more triangles in one place than a tick may look at: held where it is safe
};

/// The outcome of one update.
struct Contact
{
  UpdateStatus Status = UpdateStatus::Free;
  Vec3 Hip{};          ///< world frame
  Vec3 Position{};     ///< the god-object, world frame
  Vec3 Displacement{}; ///< god-object minus HIP, world axes; keeps its digits far from the origin
  double Penetration = 0.0; ///< |Displacement| [world unit]
  int NumberOfConstraints = 0;
  std::array<Constraint, 3> Constraints;
};

/// @brief The constraint-based god-object of Zilles and Salisbury (1995), certified against leaks.
class VTKHAPTICSCORE_EXPORT GodObject
{
public:
  /// Allocates everything that an update needs. An empty list is free space.
  explicit GodObject(std::vector<std::shared_ptr<const TriangleSurface>> surfaces);
  ~GodObject();
  GodObject(const GodObject&) = delete;
  GodObject& operator=(const GodObject&) = delete;

  /// Puts the god-object at `hip` as in free space. Servo thread. [world]
  void Place(const Vec3& hip) noexcept;
  /// Starts where another god-object stands, when the surfaces have changed. Servo thread.
  void Continue(const GodObject& previous) noexcept;
  /// Moves the god-object towards the HIP, to where the surfaces let it go. Servo thread; no
  /// allocation, no lock, bounded work. The first update after construction places it.
  const Contact& Update(const Vec3& hip) noexcept;
  const Contact& Current() const noexcept;

  const std::vector<std::shared_ptr<const TriangleSurface>>& Surfaces() const noexcept;

private:
  class Implementation;
  std::unique_ptr<Implementation> Internal;
};
}

#endif
