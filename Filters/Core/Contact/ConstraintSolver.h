#ifndef Haptics_ConstraintSolver_h
#define Haptics_ConstraintSolver_h

namespace haptics
{
/// @brief Equation (4) of Zilles and Salisbury (1995): the point nearest to w on up to three
/// planes.
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

/// Moves y to the point nearest to it on all of `count` planes (0 to 3), and gives the multipliers:
/// the move is the sum of multiplier times normal, so a negative one means that its plane pulls.
/// False, with y undefined, when planes are parallel: `parallel` is the smallest squared sine, of
/// the second plane with the first and of the third with the line of the two.
template <class Real>
inline bool ProjectOnto(const Plane<Real>* const planes[3], int count, const Real& parallel,
  Real y[3], Real multipliers[3])
{
  if (count == 0)
  {
    return true;
  }
  const Real* const a = planes[0]->Normal;
  multipliers[0] = planes[0]->Offset - Dot(a, y);
  for (int k = 0; k < 3; ++k)
  {
    y[k] = y[k] + multipliers[0] * a[k];
  }
  if (count == 1)
  {
    return true;
  }

  // Along the part of b that lies in a's plane; b's rate along it is its squared length.
  const Real* const b = planes[1]->Normal;
  const Real cosine = Dot(a, b);
  const Real inA[3] = { b[0] - cosine * a[0], b[1] - cosine * a[1], b[2] - cosine * a[2] };
  const Real squaredSine = Dot(inA, inA);
  if (!(squaredSine > parallel))
  {
    return false;
  }
  multipliers[1] = (planes[1]->Offset - Dot(b, y)) / squaredSine;
  multipliers[0] = multipliers[0] - multipliers[1] * cosine;
  for (int k = 0; k < 3; ++k)
  {
    y[k] = y[k] + multipliers[1] * inA[k];
  }
  if (count == 2)
  {
    return true;
  }

  // Along the line of a and b.
  const Real* const c = planes[2]->Normal;
  const Real line[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0] };
  const Real rate = Dot(line, c);
  if (!(rate * rate > parallel * squaredSine))
  {
    return false;
  }
  const Real step = (planes[2]->Offset - Dot(c, y)) / rate;
  for (int k = 0; k < 3; ++k)
  {
    y[k] = y[k] + step * line[k];
  }
  // step·line = m c - (what a and b have to give back): split along inA, then along a.
  multipliers[2] = step * squaredSine / rate;
  const Real back = multipliers[2] * Dot(c, inA) / squaredSine;
  multipliers[1] = multipliers[1] - back;
  multipliers[0] = multipliers[0] - multipliers[2] * Dot(c, a) + back * cosine;
  return true;
}
}

#endif
