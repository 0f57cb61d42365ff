#ifndef Haptics_ConstraintSolver_h
#define Haptics_ConstraintSolver_h

namespace haptics
{
/// @brief The plane n·y = d, with a unit normal n and an offset d.
///
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

/// @brief Equation (4) of Zilles and Salisbury (1995): the points nearest to others on up to three
/// planes.
///
/// The 6x6 system's identity and zero blocks leave a chain of projections once the normals are
/// orthonormalised (Gram-Schmidt), which keeps its digits on nearly parallel planes where
/// elimination of the Gram matrix squares their condition. That is done once for all points.
template <class Real>
class PlaneProjection
{
public:
  /// False where planes are parallel: `parallel` is the smallest squared sine, of the second plane
  /// with the first and of the third with the line of the two.
  bool Prepare(const Plane<Real>* const planes[3], int count, const Real& parallel)
  {
    this->Count = count;
    this->Planes[0] = planes[0];
    this->Planes[1] = planes[1];
    this->Planes[2] = planes[2];
    if (count <= 1)
    {
      return true;
    }
    // The part of b that lies in a's plane; b's rate along it is its squared length.
    const Real* const a = planes[0]->Normal;
    const Real* const b = planes[1]->Normal;
    this->Cosine = Dot(a, b);
    for (int k = 0; k < 3; ++k)
    {
      this->InA[k] = b[k] - this->Cosine * a[k];
    }
    this->SquaredSine = Dot(this->InA, this->InA);
    if (!(this->SquaredSine > parallel))
    {
      return false;
    }
    if (count == 2)
    {
      return true;
    }
    const Real* const c = planes[2]->Normal;
    this->Line[0] = a[1] * b[2] - a[2] * b[1];
    this->Line[1] = a[2] * b[0] - a[0] * b[2];
    this->Line[2] = a[0] * b[1] - a[1] * b[0];
    this->Rate = Dot(this->Line, c);
    this->AlongInA = Dot(c, this->InA);
    this->AlongA = Dot(c, a);
    return this->Rate * this->Rate > parallel * this->SquaredSine;
  }

  /// Moves y to the point nearest to it on all of the planes (none to three), and gives the
  /// multipliers: the move is the sum of multiplier times normal, so a negative one means that its
  /// plane pulls.
  void Project(Real y[3], Real multipliers[3]) const
  {
    if (this->Count == 0)
    {
      return;
    }
    const Plane<Real>& a = *this->Planes[0];
    multipliers[0] = a.Offset - Dot(a.Normal, y);
    Step(y, multipliers[0], a.Normal);
    if (this->Count == 1)
    {
      return;
    }
    const Plane<Real>& b = *this->Planes[1];
    multipliers[1] = (b.Offset - Dot(b.Normal, y)) / this->SquaredSine;
    multipliers[0] = multipliers[0] - multipliers[1] * this->Cosine;
    Step(y, multipliers[1], this->InA);
    if (this->Count == 2)
    {
      return;
    }
    const Plane<Real>& c = *this->Planes[2];
    const Real step = (c.Offset - Dot(c.Normal, y)) / this->Rate;
    Step(y, step, this->Line);
    // step line = m c - (what a and b have to give back): split along inA, then along a.
    multipliers[2] = step * this->SquaredSine / this->Rate;
    const Real back = multipliers[2] * this->AlongInA / this->SquaredSine;
    multipliers[1] = multipliers[1] - back;
    multipliers[0] = multipliers[0] - multipliers[2] * this->AlongA + back * this->Cosine;
  }

private:
  static void Step(Real y[3], const Real& length, const Real along[3])
  {
    for (int k = 0; k < 3; ++k)
    {
      y[k] = y[k] + length * along[k];
    }
  }

  int Count = 0;
  const Plane<Real>* Planes[3];
  Real Cosine;           ///< between the first two normals
  Real InA[3];           ///< the part of the second normal in the first plane
  Real SquaredSine;      ///< between the first two planes
  Real Line[3];          ///< that the first two have in common
  Real Rate;             ///< of the third normal along it
  Real AlongInA, AlongA; ///< of the third normal
};
}

#endif
