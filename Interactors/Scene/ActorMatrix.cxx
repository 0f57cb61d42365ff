#include "haptics/Scene/ActorMatrix.h"

#include "vtkMath.h"
#include "vtkMatrix4x4.h"

#include <cmath>
#include <cstring>

namespace haptics
{
namespace
{
/// How far a matrix may be from a rotation: rounding adds up while an actor is dragged, and a
/// surface's clearance is a thousand times more than what this makes of its size.
constexpr double LargestDeviation = 1e-9;

bool IsRotation(const double m[3][3])
{
  double transposed[3][3];
  double product[3][3];
  vtkMath::Transpose3x3(m, transposed);
  vtkMath::Multiply3x3(m, transposed, product);
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      // Not less is also how NaN answers.
      if (!(std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) < LargestDeviation))
      {
        return false;
      }
    }
  }
  return vtkMath::Determinant3x3(m) > 0.0;
}
}

bool AreSame(const Matrix4& a, const Matrix4& b)
{
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): what is not a number is the same again
  return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
}

Vec3 Transformed(const Matrix4& m, const Vec3& p)
{
  return { m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3],
    m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
    m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11] };
}

double Determinant(const Matrix4& m)
{
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
    m[2] * (m[4] * m[9] - m[5] * m[8]);
}

std::optional<RigidPose> FindPose(const Matrix4& matrix, const Matrix4& baked)
{
  Matrix4 moved = matrix;
  if (baked != IdentityMatrix)
  {
    Matrix4 inverse;
    vtkMatrix4x4::Invert(baked.data(), inverse.data());
    vtkMatrix4x4::Multiply4x4(matrix.data(), inverse.data(), moved.data());
  }
  double rotation[3][3];
  bool isTurned = false;
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      rotation[i][j] = moved[4 * i + j];
      isTurned = isTurned ||
        matrix[4 * i + j] != (baked == IdentityMatrix ? IdentityMatrix : baked)[4 * i + j];
    }
  }
  if (!IsRotation(rotation) || !std::isfinite(moved[3] + moved[7] + moved[11]))
  {
    return std::nullopt;
  }
  RigidPose pose;
  if (isTurned)
  {
    vtkMath::Matrix3x3ToQuaternion(rotation, pose.Rotation.data());
    pose.Translation = { moved[3], moved[7], moved[11] };
  }
  else // exactly, whatever the rounding of the inverse
  {
    pose.Translation = { matrix[3] - baked[3], matrix[7] - baked[7], matrix[11] - baked[11] };
  }
  return pose;
}
}
