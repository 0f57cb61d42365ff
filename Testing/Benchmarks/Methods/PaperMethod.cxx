#include "PaperMethod.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace haptics::testing
{
namespace
{
/// "At the intersection of more than three surfaces, only three will be active at any one time."
constexpr std::size_t MostConstraints = 3;
/// "The maximum number of iterations is equal to the maximum number of possible simultaneous
/// constraints", and one to see that there are no more.
constexpr int MostIterations = 4;
}

template <class Real>
typename PaperMethod<Real>::Vector PaperMethod<Real>::Cross(const Vector& a, const Vector& b)
{
  return { a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X };
}

template <class Real>
PaperMethod<Real>::PaperMethod(const TriangleMesh& mesh, const PaperOptions& options)
  : Options(options)
{
  for (const Triangle& triangle : mesh.Triangles)
  {
    Facet facet;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3& p = mesh.Points[triangle[k]];
      facet.Corners[k] = { static_cast<Real>(p[0]), static_cast<Real>(p[1]),
        static_cast<Real>(p[2]) };
    }
    const Vector normal =
      Cross(facet.Corners[1] - facet.Corners[0], facet.Corners[2] - facet.Corners[0]);
    const Real length = std::sqrt(Dot(normal, normal));
    if (length > 0)
    {
      facet.Normal = normal * (1 / length);
      facet.Offset = Dot(facet.Normal, facet.Corners[0]);
      this->Facets.push_back(facet);
    }
  }
}

template <class Real>
void PaperMethod<Real>::Place(const Vec3& p)
{
  this->Position = { static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2]) };
}

template <class Real>
bool PaperMethod<Real>::IsMet(
  const Facet& facet, const Vector& from, const Vector& to, Real& fraction) const
{
  const Real lowered = facet.Offset - static_cast<Real>(this->Options.Lowered);
  const Real before = Dot(facet.Normal, from) - lowered;
  const Real after = Dot(facet.Normal, to) - lowered;
  if (!(before >= 0 && after < 0))
  {
    return false;
  }
  fraction = before / (before - after);
  const Vector at = from + (to - from) * fraction;
  for (int k = 0; k < 3; ++k)
  {
    const Vector& corner = facet.Corners[k];
    const Vector edge = facet.Corners[(k + 1) % 3] - corner;
    const Real reach = static_cast<Real>(this->Options.Grown) * std::sqrt(Dot(edge, edge));
    if (Dot(facet.Normal, Cross(edge, at - corner)) < -reach)
    {
      return false;
    }
  }
  return true;
}

/// Adds the facets that the line passes, nearest first, as far as there is room.
template <class Real>
void PaperMethod<Real>::FindActive(const Vector& from, const Vector& to)
{
  this->Hits.clear();
  for (const Facet& facet : this->Facets)
  {
    Real fraction;
    if (this->IsMet(facet, from, to, fraction))
    {
      this->Hits.push_back({ fraction, &facet });
    }
  }
  std::sort(this->Hits.begin(), this->Hits.end(),
    [](const Hit& a, const Hit& b) { return a.Fraction < b.Fraction; });
  const Real rounding = 16 * std::numeric_limits<Real>::epsilon();
  for (const Hit& hit : this->Hits)
  {
    const bool isThere = std::any_of(this->Active.begin(), this->Active.end(),
      [&](const Facet* active)
      {
        return Dot(active->Normal, hit.Met->Normal) > 1 - rounding &&
          std::abs(Dot(active->Normal, hit.Met->Corners[0]) - active->Offset) <=
          rounding * (1 + std::abs(active->Offset));
      });
    if (!isThere && this->Active.size() < MostConstraints)
    {
      this->Active.push_back(hit.Met);
    }
  }
}

/// Equation (4), reduced to its multipliers and solved by elimination with pivots. False where
/// it is singular.
template <class Real>
bool PaperMethod<Real>::Solve(const Vector& hip, Vector& position) const
{
  const int count = static_cast<int>(this->Active.size());
  Real system[3][4];
  for (int i = 0; i < count; ++i)
  {
    for (int j = 0; j < count; ++j)
    {
      system[i][j] = Dot(this->Active[i]->Normal, this->Active[j]->Normal);
    }
    system[i][count] = this->Active[i]->Offset - Dot(this->Active[i]->Normal, hip);
  }
  for (int column = 0; column < count; ++column)
  {
    int pivot = column;
    for (int row = column + 1; row < count; ++row)
    {
      if (std::abs(system[row][column]) > std::abs(system[pivot][column]))
      {
        pivot = row;
      }
    }
    if (std::abs(system[pivot][column]) < 16 * std::numeric_limits<Real>::epsilon())
    {
      return false;
    }
    std::swap(system[pivot], system[column]);
    for (int row = column + 1; row < count; ++row)
    {
      const Real factor = system[row][column] / system[column][column];
      for (int k = column; k <= count; ++k)
      {
        system[row][k] -= factor * system[column][k];
      }
    }
  }
  Real multipliers[3];
  position = hip;
  for (int i = count - 1; i >= 0; --i)
  {
    multipliers[i] = system[i][count];
    for (int j = i + 1; j < count; ++j)
    {
      multipliers[i] -= system[i][j] * multipliers[j];
    }
    multipliers[i] /= system[i][i];
    position = position + this->Active[i]->Normal * multipliers[i];
  }
  return std::isfinite(position.X + position.Y + position.Z);
}

template <class Real>
Vec3 PaperMethod<Real>::Update(const Vec3& hip)
{
  const Vector h{ static_cast<Real>(hip[0]), static_cast<Real>(hip[1]), static_cast<Real>(hip[2]) };
  this->Active.clear();
  Vector goal = h;
  const int iterations = this->Options.Iterates ? MostIterations : 1;
  for (int i = 0; i < iterations; ++i)
  {
    const std::size_t before = this->Active.size();
    this->FindActive(this->Position, goal);
    if (this->Active.size() == before)
    {
      break;
    }
    if (!this->Solve(h, goal))
    {
      ++this->Singular;
      goal = this->Position;
      break;
    }
  }
  this->Position = goal;
  // In free space the god-object is the HIP; do not make a force of rounding.
  return this->Active.empty() ? hip : Vec3{ this->Position.X, this->Position.Y, this->Position.Z };
}

template class PaperMethod<float>;
template class PaperMethod<double>;
}
