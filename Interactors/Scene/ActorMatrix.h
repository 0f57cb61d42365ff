#ifndef Haptics_ActorMatrix_h
#define Haptics_ActorMatrix_h

#include "haptics/Math/RigidPose.h"
#include "haptics/Math/Vec3.h"

#include <array>
#include <optional>

namespace haptics
{
/// An affine matrix, row by row.
using Matrix4 = std::array<double, 16>;
constexpr Matrix4 IdentityMatrix{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

/// Whether two are the same bit for bit, which two that are not numbers can be.
bool AreSame(const Matrix4& a, const Matrix4& b);

Vec3 Transformed(const Matrix4& matrix, const Vec3& point);

/// Without the translation. A negative one is that of a mirror; 0 and what is not finite flatten or
/// tear.
double Determinant(const Matrix4& matrix);

/// The rigid part of `matrix` where it is `baked` moved as a rigid body, to within 1e-9 of its
/// size; nothing elsewhere. `baked`: not flat.
std::optional<RigidPose> FindPose(const Matrix4& matrix, const Matrix4& baked);
}

#endif
