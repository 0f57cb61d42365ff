#include "haptics/Contact/FacetBatch.h"

#include "haptics/Math/VectorClones.h"

#include <cmath>

namespace haptics
{
namespace
{
// By value and without std::min's references, so that loops over them become vector instructions.
inline double Less(double x, double y)
{
  return x < y ? x : y;
}
inline double More(double x, double y)
{
  return x > y ? x : y;
}
inline double Choose(bool first, double x, double y)
{
  return first ? x : y;
}
/// How far x lies outside of a range, squared.
inline double SquaredGap(double x, double low, double high)
{
  const double gap = More(More(low - x, x - high), 0.0);
  return gap * gap;
}
}

HAPTICS_VECTOR_CLONES
void FacetBatch::Answer(std::int32_t count, const Question& question)
{
  const double* const ax = this->A[0].data();
  const double* const ay = this->A[1].data();
  const double* const az = this->A[2].data();
  const double* const bx = this->B[0].data();
  const double* const by = this->B[1].data();
  const double* const bz = this->B[2].data();
  const double* const cx = this->C[0].data();
  const double* const cy = this->C[1].data();
  const double* const cz = this->C[2].data();
  double* const __restrict normalX = this->N[0].data();
  double* const __restrict normalY = this->N[1].data();
  double* const __restrict normalZ = this->N[2].data();
  double* const __restrict lowX = this->Lows[0].data();
  double* const __restrict lowY = this->Lows[1].data();
  double* const __restrict lowZ = this->Lows[2].data();
  double* const __restrict highX = this->Highs[0].data();
  double* const __restrict highY = this->Highs[1].data();
  double* const __restrict highZ = this->Highs[2].data();
  double* const __restrict offsets = this->Offsets.data();
  double* const __restrict errors = this->Errors.data();
  double* const __restrict clearances = this->Clearances.data();
  double* const __restrict conditions = this->Conditions.data();
  double* const __restrict squaredDistances = this->SquaredDistances.data();
  const Vector middle = question.Middle;
  const Vector centre = question.Centre;
  const Vector position = question.Position;
  const double radius = question.Radius;
  const double farthest = question.Farthest;
  const double minimum = question.MinimumClearance;

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep // all arrays are apart
#endif
  for (std::int32_t i = 0; i < count; ++i)
  {
    const double aX = ax[i], aY = ay[i], aZ = az[i];
    const double bX = bx[i], bY = by[i], bZ = bz[i];
    const double cX = cx[i], cY = cy[i], cZ = cz[i];
    const double abX = bX - aX, abY = bY - aY, abZ = bZ - aZ;
    const double bcX = cX - bX, bcY = cY - bY, bcZ = cZ - bZ;
    const double caX = aX - cX, caY = aY - cY, caZ = aZ - cZ;
    const double ab = abX * abX + abY * abY + abZ * abZ;
    const double bc = bcX * bcX + bcY * bcY + bcZ * bcZ;
    const double ca = caX * caX + caY * caY + caZ * caZ;

    // The corner opposite the longest edge is the anchor: its angle has the largest sine.
    const double longest = More(bc, More(ca, ab));
    const bool fromA = bc == longest;
    const bool fromB = ca == longest;
    const double vX = Choose(fromA, aX, Choose(fromB, bX, cX));
    const double vY = Choose(fromA, aY, Choose(fromB, bY, cY));
    const double vZ = Choose(fromA, aZ, Choose(fromB, bZ, cZ));
    const double nextX = Choose(fromA, abX, Choose(fromB, bcX, caX));
    const double nextY = Choose(fromA, abY, Choose(fromB, bcY, caY));
    const double nextZ = Choose(fromA, abZ, Choose(fromB, bcZ, caZ));
    const double lastX = Choose(fromA, caX, Choose(fromB, abX, bcX)); // towards the anchor
    const double lastY = Choose(fromA, caY, Choose(fromB, abY, bcY));
    const double lastZ = Choose(fromA, caZ, Choose(fromB, abZ, bcZ));
    const double others = Choose(fromA, ca + ab, Choose(fromB, ab + bc, bc + ca));
    double nX = lastY * nextZ - lastZ * nextY;
    double nY = lastZ * nextX - lastX * nextZ;
    double nZ = lastX * nextY - lastY * nextX;
    const double squared = nX * nX + nY * nY + nZ * nZ;
    const double inverse = 1.0 / std::sqrt(squared);
    nX *= inverse;
    nY *= inverse;
    nZ *= inverse;
    const double condition = 0.5 * others * inverse;

    const double fromX = vX - centre.x, fromY = vY - centre.y, fromZ = vZ - centre.z;
    const double reach = std::sqrt(fromX * fromX + fromY * fromY + fromZ * fromZ) + farthest;
    const double error = 32.0 * UnitRoundoff * condition * reach;
    const double lX = Less(aX, Less(bX, cX)), hX = More(aX, More(bX, cX));
    const double lY = Less(aY, Less(bY, cY)), hY = More(aY, More(bY, cY));
    const double lZ = Less(aZ, Less(bZ, cZ)), hZ = More(aZ, More(bZ, cZ));
    lowX[i] = lX;
    lowY[i] = lY;
    lowZ[i] = lZ;
    highX[i] = hX;
    highY[i] = hY;
    highZ[i] = hZ;
    normalX[i] = nX;
    normalY[i] = nY;
    normalZ[i] = nZ;
    offsets[i] = nX * fromX + nY * fromY + nZ * fromZ;
    errors[i] = error;
    conditions[i] = condition;
    clearances[i] = More(minimum, Less(4.0 * error, 1e-6 * std::sqrt(longest)));

    // Apart from the ball: outside its box, or beyond the triangle's plane or one of its edges.
    const double reached = radius + error;
    const double squaredReach = reached * reached;
    const double height = nX * (middle.x - vX) + nY * (middle.y - vY) + nZ * (middle.z - vZ);
    const double inAb = (nY * abZ - nZ * abY) * (middle.x - aX) +
      (nZ * abX - nX * abZ) * (middle.y - aY) + (nX * abY - nY * abX) * (middle.z - aZ);
    const double inBc = (nY * bcZ - nZ * bcY) * (middle.x - bX) +
      (nZ * bcX - nX * bcZ) * (middle.y - bY) + (nX * bcY - nY * bcX) * (middle.z - bZ);
    const double inCa = (nY * caZ - nZ * caY) * (middle.x - cX) +
      (nZ * caX - nX * caZ) * (middle.y - cY) + (nX * caY - nY * caX) * (middle.z - cZ);
    const double outAb = Less(inAb, 0.0), outBc = Less(inBc, 0.0), outCa = Less(inCa, 0.0);
    const double toBox =
      SquaredGap(middle.x, lX, hX) + SquaredGap(middle.y, lY, hY) + SquaredGap(middle.z, lZ, hZ);
    // Bitwise, so that there is no branch. Of a plane that is not known nothing is concluded.
    const bool isUnknown = !(condition < HUGE_VAL);
    const bool meets = (toBox <= radius * radius) &
      (isUnknown |
        ((height * height <= squaredReach) & (outAb * outAb <= squaredReach * ab) &
          (outBc * outBc <= squaredReach * bc) & (outCa * outCa <= squaredReach * ca)));
    const double squaredDistance = SquaredGap(position.x, lX, hX) + SquaredGap(position.y, lY, hY) +
      SquaredGap(position.z, lZ, hZ);
    squaredDistances[i] = meets ? squaredDistance : -1.0;
  }
}
}
