#include "haptics/Math/WorkspaceTransform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace haptics
{
bool WorkspaceTransform::SetMatrix(const double elements[16], std::string& error)
{
  if (!std::all_of(elements, elements + 16, [](double x) { return std::isfinite(x); }))
  {
    error = "The workspace transform has an element that is not finite.";
    return false;
  }
  if (elements[12] != 0.0 || elements[13] != 0.0 || elements[14] != 0.0 || elements[15] != 1.0)
  {
    error = "The last row of the workspace transform must be 0 0 0 1.";
    return false;
  }
  const auto m = [elements](int row, int column) { return elements[4 * row + column]; };
  const double determinant = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
    m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
    m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
  if (!std::isnormal(determinant) || determinant < 0.0)
  {
    error = "The workspace transform is singular or a mirror (its determinant is " +
      std::to_string(determinant) + "). It must rotate, scale and translate.";
    return false;
  }

  WorkspaceTransform made;
  made.Scale = std::cbrt(determinant);
  for (int row = 0; row < 3; ++row)
  {
    made.Translation[row] = m(row, 3);
    for (int column = 0; column < 3; ++column)
    {
      made.Rotation[3 * row + column] = m(row, column) / made.Scale;
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    for (int b = a; b < 3; ++b)
    {
      const double* r = made.Rotation.data();
      const double dot = r[a] * r[b] + r[3 + a] * r[3 + b] + r[6 + a] * r[6 + b];
      if (std::abs(dot - (a == b ? 1.0 : 0.0)) > 1e-6)
      {
        error = "The workspace transform shears or scales its axes differently. Scale all three "
                "alike and keep them at right angles.";
        return false;
      }
    }
  }
  *this = made;
  return true;
}

void WorkspaceTransform::GetMatrix(double elements[16]) const
{
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      elements[4 * row + column] = this->Scale * this->Rotation[3 * row + column];
    }
    elements[4 * row + 3] = this->Translation[row];
    elements[12 + row] = 0.0;
  }
  elements[15] = 1.0;
}

Vec3 WorkspaceTransform::PointToWorld(const Vec3& point) const noexcept
{
  const Vec3 turned = this->DirectionToWorld(point);
  return { this->Scale * turned[0] + this->Translation[0],
    this->Scale * turned[1] + this->Translation[1],
    this->Scale * turned[2] + this->Translation[2] };
}

Vec3 WorkspaceTransform::DirectionToDevice(const Vec3& vector) const noexcept
{
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i)
  {
    result[i] = this->Rotation[i] * vector[0] + this->Rotation[3 + i] * vector[1] +
      this->Rotation[6 + i] * vector[2];
  }
  return result;
}

Vec3 WorkspaceTransform::VectorToDevice(const Vec3& vector) const noexcept
{
  const Vec3 turned = this->DirectionToDevice(vector);
  return { turned[0] / this->Scale, turned[1] / this->Scale, turned[2] / this->Scale };
}

Vec3 WorkspaceTransform::DirectionToWorld(const Vec3& vector) const noexcept
{
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i)
  {
    result[i] = this->Rotation[3 * i] * vector[0] + this->Rotation[3 * i + 1] * vector[1] +
      this->Rotation[3 * i + 2] * vector[2];
  }
  return result;
}
}
