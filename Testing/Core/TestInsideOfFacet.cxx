// What is learned of a facet says no more than CoverageOf() does.
#include "RandomVectors.h"
#include "haptics/Contact/InsideOfFacet.h"
#include "haptics/Surface/Facet.h"

#include <gtest/gtest.h>

#include <random>

using namespace haptics;
using haptics::testing::NormalVector;

namespace
{
constexpr double Own = GrowthOverSharedEdges * 1024.0 * UnitRoundoff;

Coverage At(const Facet& facet, const Vector& x)
{
  Vector nearest;
  return CoverageOf(
    facet.Normal, facet.Corner[0], facet.Corner[1], facet.Corner[2], x, Own, Own,
    [](int) { return false; }, nearest);
}
}

TEST(InsideOfFacet, SaysNoMoreThanTheFacetItself)
{
  std::mt19937 random(34);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  int inside = 0;
  int known = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    // Some thin, some as small as a few clearances.
    const double size = std::ldexp(0.3, -(trial % 5) * 10);
    const Vector a = 0.3 * ToVector(NormalVector(random));
    const Vector b = a + size * ToVector(NormalVector(random));
    const Vector c = trial % 3 ? a + size * ToVector(NormalVector(random))
                               : glm::mix(a, b, 0.4) + 1e-6 * size * ToVector(NormalVector(random));
    const Facet facet(a, b, c);
    InsideOfFacet learned;
    while (!learned.IsWorthLearning(7, Own))
    {
      EXPECT_FALSE(learned.Has(7, Own, (a + b + c) / 3.0));
    }
    learned.Learn(facet.Normal, a, b, c);
    EXPECT_FALSE(learned.Has(8, Own, (a + b + c) / 3.0)); // another facet
    EXPECT_FALSE(learned.Has(7, 2.0 * Own, (a + b + c) / 3.0));
    for (int k = 0; k < 100; ++k)
    {
      const double v = share(random);
      const double w = share(random);
      Vector x = a + v * (b - a) + w * (c - a) + 0.1 * size * share(random) * facet.Normal;
      if (k % 2)
      {
        // About one of the edges, by parts of what is left out there.
        const Vector from[3] = { a, b, c };
        const Vector along = glm::mix(from[k % 3], from[(k + 1) % 3], v);
        x = along +
          4.0 * Own * share(random) *
            glm::normalize(glm::cross(facet.Normal, from[(k + 1) % 3] - from[k % 3]));
      }
      const bool isInside = At(facet, x) == Coverage::Inside;
      const bool isKnown = learned.Has(7, Own, x);
      EXPECT_TRUE(isInside || !isKnown) << trial << ' ' << k;
      inside += isInside ? 1 : 0;
      known += isKnown ? 1 : 0;
    }
  }
  EXPECT_GT(known, 40000);
  EXPECT_GT(known, 0.8 * inside);
}

TEST(InsideOfFacet, IsForgottenWhereAnotherFacetIsAskedOf)
{
  const Vector a(0.0, 0.0, 0.0), b(1.0, 0.0, 0.0), c(0.0, 1.0, 0.0), x(0.2, 0.2, 0.1);
  InsideOfFacet learned;
  while (!learned.IsWorthLearning(1, Own))
  {
  }
  learned.Learn({ 0.0, 0.0, 1.0 }, a, b, c);
  EXPECT_TRUE(learned.Has(1, Own, x));
  EXPECT_FALSE(learned.IsWorthLearning(2, Own));
  EXPECT_FALSE(learned.Has(1, Own, x));
  EXPECT_FALSE(learned.Has(2, Own, x));
}
