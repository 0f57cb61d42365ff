// Lines and triangles: what float64 says it knows is so by exact arithmetic.
#include "ExactSigns.h"
#include "haptics/Math/Predicates.h"
#include "haptics/Math/TriangleSeenFrom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// A triangle somewhere, and a way that goes through its plane.
struct Question
{
  Vector A, B, C, From, To;
};

/// Ways of every length down to rounding's, through corners, edges and points inside, to within
/// nothing, rounding or more, along an edge too.
class Questions
{
public:
  explicit Questions(unsigned seed)
    : Random(seed)
  {
  }

  Question Next()
  {
    Question question;
    const double size = this->PowerOfTen(-12, 2);
    const Vector origin = this->PowerOfTen(-6, 3) * this->Cube();
    question.A = origin + size * this->Cube();
    question.B = origin + size * this->Cube();
    question.C = this->Chance(4) ? question.B + this->PowerOfTen(-14, 0) * size * this->Cube()
                                 : origin + size * this->Cube();
    const double s = this->Chance(4) ? 0.0 : 0.5 + 0.5 * this->Uniform(this->Random);
    const double t = this->Chance(3) ? 0.0 : (1.0 - s) * (0.5 + 0.5 * this->Uniform(this->Random));
    const Vector aim = question.A + s * (question.B - question.A) + t * (question.C - question.A);
    const Vector aside = this->Chance(2) ? Vector(0.0) : this->PowerOfTen(-16, 0) * this->Cube();
    const Vector along = this->Chance(3)
      ? question.B - question.A + this->PowerOfTen(-16, 0) * size * this->Cube()
      : size * this->Cube();
    const Vector way = this->PowerOfTen(-14, 1) * along;
    question.From = aim + size * aside - way;
    question.To = question.From + 2.0 * way;
    return question;
  }

private:
  bool Chance(int in) { return this->Random() % static_cast<unsigned>(in) == 0; }
  double PowerOfTen(double least, double most)
  {
    return std::pow(10.0, least + (most - least) * 0.5 * (1.0 + this->Uniform(this->Random)));
  }
  Vector Cube()
  {
    const double x = this->Uniform(this->Random);
    const double y = this->Uniform(this->Random);
    return { x, y, this->Uniform(this->Random) };
  }

  std::mt19937 Random;
  std::uniform_real_distribution<double> Uniform{ -1.0, 1.0 };
};

/// Whether the line passes the three edges on no two sides.
bool PassesThrough(const Question& q)
{
  const auto side = [&](const Vector& a, const Vector& b)
  { return SignOfVolume(ToVec3(q.From), ToVec3(q.To), ToVec3(a), ToVec3(b)); };
  const int ab = side(q.A, q.B), bc = side(q.B, q.C), ca = side(q.C, q.A);
  return std::max({ ab, bc, ca }) - std::min({ ab, bc, ca }) < 2;
}
}

TEST(Predicates, LinesMeetTrianglesExactly)
{
  Questions questions(5);
  int known = 0;
  int met = 0;
  for (int i = 0; i < 100000; ++i)
  {
    const Question q = questions.Next();
    const bool expected = PassesThrough(q);
    met += expected;
    ASSERT_EQ(LineMeetsTriangle(q.From, q.To, q.A, q.B, q.C), expected) << "question " << i;
    const auto answer = TriangleSeenFrom(q.From, q.A, q.B, q.C).Ask(q.To - q.From);
    if (answer != TriangleSeenFrom::Answer::Unknown)
    {
      ++known;
      ASSERT_EQ(answer == TriangleSeenFrom::Answer::Meets, expected) << "question " << i;
    }
  }
  // Enough of each kind, or the test tests nothing.
  EXPECT_GT(met, 10000);
  EXPECT_LT(met, 90000);
  EXPECT_GT(known, 10000);
  EXPECT_LT(known, 90000);
}

TEST(Predicates, ShortWaysAreKnownByFloat64)
{
  // A ten-billionth of the triangle's size past an edge, by as little: what a god-object in a
  // corner asks about.
  const Vector a(0.3, 0.4, 0.5), b(0.31, 0.41, 0.5), c(0.3, 0.41, 0.51);
  const Vector up = glm::normalize(glm::cross(b - a, c - a));
  const Vector from = 0.5 * (a + b) + 1e-12 * up;
  const auto ask = [&](const Vector& way)
  { return TriangleSeenFrom(from, a, b, c).Ask((from + way) - from); };
  const Vector inwards = glm::normalize(c - 0.5 * (a + b));
  EXPECT_EQ(ask(4e-12 * (inwards - up)), TriangleSeenFrom::Answer::Meets);
  EXPECT_EQ(ask(-4e-12 * (inwards + up)), TriangleSeenFrom::Answer::Misses);
}

TEST(Predicates, WhatOverflowsOrUnderflowsIsNotKnown)
{
  for (const double size : { 1e-150, 1e150 })
  {
    const Vector a(0, 0, 0), b(size, 0, 0), c(0, size, 0), from(0.2 * size, 0.2 * size, size);
    EXPECT_EQ(
      TriangleSeenFrom(from, a, b, c).Ask({ 0, 0, -size }), TriangleSeenFrom::Answer::Unknown);
    EXPECT_TRUE(LineMeetsTriangle(from, from - Vector(0, 0, 2 * size), a, b, c)) << size;
  }
}
