#ifndef Haptics_PaperMethod_h
#define Haptics_PaperMethod_h

#include "ContactMethod.h"
#include "haptics/Surface/TriangleSurface.h"

#include <vector>

namespace haptics::testing
{
struct PaperOptions
{
  /// Footnote 1: "we add a small constant to the calculated distance from the god-object to the
  /// virtual surface", here "another plane just below the virtual surface" [m]. 0: without.
  double Lowered = 1e-7;
  /// Section 2.2: "iterate the whole process", against the crossing of Fig. 6.
  bool Iterates = false;
  /// Not in the paper: facets reach so far beyond their edges [m], which closes the crack that the
  /// lowered planes open under concave edges.
  double Grown = 0.0;
};

/// @brief The god-object as Zilles and Salisbury (1995) print it, in float or double.
///
/// Sections 2.2 and 2.3 to the letter: every facet is looked at ("the simple collision detection
/// algorithm"); one is active where the line from the god-object to the HIP passes from its front
/// to its back within all of its edges; up to three constrain by equality, equation (4). Facets in
/// one plane count once. Where two are parallel, equation (4) has no answer (footnote 3): the
/// god-object stays, and the tick is counted.
template <class Real>
class PaperMethod : public ContactMethod
{
public:
  PaperMethod(const TriangleMesh& mesh, const PaperOptions& options);

  void Place(const Vec3& position) override;
  Vec3 Update(const Vec3& hip) override;
  long SingularSolves() const override { return this->Singular; }

private:
  struct Vector
  {
    Real X, Y, Z;
    Vector operator-(const Vector& b) const { return { X - b.X, Y - b.Y, Z - b.Z }; }
    Vector operator+(const Vector& b) const { return { X + b.X, Y + b.Y, Z + b.Z }; }
    Vector operator*(Real s) const { return { s * X, s * Y, s * Z }; }
  };
  struct Facet
  {
    Vector Corners[3];
    Vector Normal;
    Real Offset;
  };
  struct Hit
  {
    Real Fraction;
    const Facet* Met;
  };
  static Real Dot(const Vector& a, const Vector& b) { return a.X * b.X + a.Y * b.Y + a.Z * b.Z; }
  static Vector Cross(const Vector& a, const Vector& b);
  bool IsMet(const Facet& facet, const Vector& from, const Vector& to, Real& fraction) const;
  void FindActive(const Vector& from, const Vector& to);
  bool Solve(const Vector& hip, Vector& position) const;

  PaperOptions Options;
  std::vector<Facet> Facets;
  std::vector<Hit> Hits;
  std::vector<const Facet*> Active;
  Vector Position{};
  long Singular = 0;
};

extern template class PaperMethod<float>;
extern template class PaperMethod<double>;
}

#endif
