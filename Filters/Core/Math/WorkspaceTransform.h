#ifndef Haptics_WorkspaceTransform_h
#define Haptics_WorkspaceTransform_h

#include "haptics/Math/Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <array>
#include <string>

namespace haptics
{
/// @brief Maps the device frame [m] to the world frame: rotation, uniform scale, translation.
///
/// Plain memory, so that it can be handed to the servo thread. The identity by default.
struct VTKHAPTICSCORE_EXPORT WorkspaceTransform
{
  std::array<double, 9> Rotation{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< row by row
  double Scale = 1.0;                                          ///< [world unit / m], > 0
  Vec3 Translation{};                                          ///< [world unit]

  /// Takes a 4x4 matrix, row by row, device to world. False, with the cause in `error` and nothing
  /// changed, where an element is not finite or it is not a similarity without mirror (to 1e-6 of
  /// its scale).
  bool SetMatrix(const double elements[16], std::string& error);
  /// The 4x4 matrix, row by row, device to world.
  void GetMatrix(double elements[16]) const;

  /// A device position [m] in the world frame.
  Vec3 PointToWorld(const Vec3& point) const noexcept;
  /// A world vector [world unit] in the device frame [m].
  Vec3 VectorToDevice(const Vec3& vector) const noexcept;
  /// A world vector along the device's axes, its length kept: for normals.
  Vec3 DirectionToDevice(const Vec3& vector) const noexcept;
  /// A device vector along the world's axes, its length kept: for forces [N].
  Vec3 DirectionToWorld(const Vec3& vector) const noexcept;

  bool operator!=(const WorkspaceTransform& other) const noexcept
  {
    return this->Rotation != other.Rotation || this->Scale != other.Scale ||
      this->Translation != other.Translation;
  }
};
}

#endif
