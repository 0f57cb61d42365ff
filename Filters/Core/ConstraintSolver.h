#ifndef ConstraintSolver_h
#define ConstraintSolver_h

namespace haptics
{
/// @brief Equation (4) of Zilles and Salisbury (1995): the point nearest to w on up to three planes.
///
/// The planes n·y = d have unit normals. The 6x6 system's identity and zero blocks leave a chain of
/// projections once the normals are orthonormalised (Gram-Schmidt), which keeps its digits on
/// nearly parallel planes where elimination of the Gram matrix squares their condition.
/// `Real` is double; a test counts multiplications with a type of its own.
template <class Real>
struct Plane
{
  Real Normal[3];
  Real Offset;
};

template <class Real>
inline Real Dot(const Real a[3], const Real b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Moves y, which lies on the planes of an orthonormal basis already, along `direction` (unit, in
/// their intersection) onto one plane more. `rate` is normal·direction.
template <class Real>
inline void MoveOnto(const Plane<Real>& plane, const Real direction[3], const Real& rate, Real y[3])
{
  const Real step = (plane.Offset - Dot(plane.Normal, y)) / rate;
  for (int k = 0; k < 3; ++k)
  {
    y[k] = y[k] + step * direction[k];
  }
}

/// The nearest point to y on one plane. Six multiplications.
template <class Real>
inline void ProjectOnto(const Plane<Real>& a, Real y[3])
{
  const Real step = a.Offset - Dot(a.Normal, y);
  for (int k = 0; k < 3; ++k)
  {
    y[k] = y[k] + step * a.Normal[k];
  }
}

/// The nearest point to y on the line of two planes; false when they are parallel to within
/// `parallel`, the smallest squared sine of their angle.
template <class Real>
inline bool ProjectOnto(const Plane<Real>& a, const Plane<Real>& b, const Real& parallel, Real y[3])
{
  const Real cosine = Dot(a.Normal, b.Normal);
  Real direction[3]; // of b's normal, in a's plane
  for (int k = 0; k < 3; ++k)
  {
    direction[k] = b.Normal[k] - cosine * a.Normal[k];
  }
  // normal·direction is |direction|², so the direction needs no root.
  const Real rate = Dot(direction, direction);
  if (!(rate > parallel))
  {
    return false;
  }
  ProjectOnto(a, y);
  MoveOnto(b, direction, rate, y);
  return true;
}

/// The common point of three planes; false when they have none or it is not well defined.
template <class Real>
inline bool ProjectOnto(const Plane<Real>& a, const Plane<Real>& b, const Plane<Real>& c,
  const Real& parallel, Real y[3])
{
  if (!ProjectOnto(a, b, parallel, y))
  {
    return false;
  }
  const Real* const m = a.Normal;
  const Real* const n = b.Normal;
  const Real direction[3] = { m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2],
    m[0] * n[1] - m[1] * n[0] };
  const Real rate = Dot(direction, c.Normal);
  if (!(rate * rate > parallel * Dot(direction, direction)))
  {
    return false;
  }
  MoveOnto(c, direction, rate, y);
  return true;
}
}

#endif
