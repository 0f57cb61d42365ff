// Real surfaces, good and bad: the report against what is known of them, and strokes over them with
// all engines, every piece of every way checked with exact arithmetic.
#include "AnalyticSurfaces.h"
#include "ExactEngine.h"
#include "ExactQueries.h"
#include "RealSurface.h"
#include "haptics/Contact/GodObject.h"
#include "vtkGodObjectFilter.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr int NumberOfStrokes = 12;

const RealSurface Surfaces[] = {
  // file, triangles, components, non-manifold and flipped edges, closed, genus
  { "wing.stl", 842, 1, 0, 0, true, -1 },
  { "t13.stl", 1580, 1, 0, 0, true, 2 },
  { "footbones.vtp", 4204, 26, 0, 0, true, -1 },
  { "propeller.stl", 7374, 1, 0, 12, true, -1 },
  // 162 as it comes, and 6 where its two triangles without area joined a corner to a longer edge.
  { "motor.stl", 13502, 13, 168, 0, false, -1 },
  { "aneurysm.stl", 20294, 1, 0, 0, false, -1 },
  { "pial.vtp", 20480, 1, 0, 0, true, 0 },
  { "gearbox.stl", 26966, 1, 0, 0, true, 22 },
#ifdef HAPTICS_TEST_ALL_REAL_SURFACES
  { "fault.vtp", 275772, 1, 0, 0, false, -1, 60 },
  { "cranium.vtp", 399757, 148, 8, 70, false, -1, 60 },
  { "frog.vtp", 1514708, 617, 0, 0, false, -1, 20 },
#endif
};

class RealSurfaces : public ::testing::TestWithParam<RealSurface>
{
protected:
  void SetUp() override
  {
    const std::string path = PathOf(GetParam());
    if (path.empty())
    {
      GTEST_SKIP() << GetParam().File << " could not be had: the test RealSurfaces.Get says why.";
    }
    this->Input = Read(path);
    ASSERT_TRUE(this->Input) << path;
  }

  vtkSmartPointer<vtkPolyData> Input;
};

/// A hand that comes down on a triangle from its front and wanders over what is there.
class Stroke
{
public:
  Stroke(const TriangleSurface& surface, unsigned seed)
    : Random(seed)
    , Size(0.02 * surface.Radius())
  {
    std::uniform_int_distribution<std::size_t> pick(0, surface.Triangles().size() - 1);
    Vec3 across{};
    do
    {
      const auto& [a, b, c] = surface.Triangles()[pick(this->Random)];
      const auto& points = surface.Points();
      this->Foot = (1.0 / 3.0) * (points[a] + points[b] + points[c]) + surface.Origin();
      across = Cross(points[b] - points[a], points[c] - points[a]);
    } while (Length(across) == 0.0);
    this->Normal = Unit(across);
  }

  Vec3 Start() const { return this->Foot + (0.1 * this->Size) * this->Normal; }

  Vec3 Next()
  {
    std::normal_distribution<double> normal;
    const double x = normal(this->Random);
    const double y = normal(this->Random);
    const Vec3 kick{ x, y, normal(this->Random) };
    this->Velocity = 0.95 * this->Velocity + (0.01 * this->Size) * kick;
    this->Velocity = this->Velocity - Dot(this->Velocity, this->Normal) * this->Normal;
    this->Foot = this->Foot + this->Velocity;
    this->Depth = std::min(this->Depth + 0.1 * this->Size, 0.5 * this->Size);
    return this->Foot - this->Depth * this->Normal;
  }

private:
  std::mt19937 Random;
  double Size; ///< [world unit]
  Vec3 Foot{};
  Vec3 Normal{};
  Vec3 Velocity{};
  double Depth = 0.0;
};

/// Checks the last update's way, piece by piece.
void ExpectNoCrossing(const ExactQueries& exact, const GodObject& god)
{
  int corners = 0;
  const Vec3* const way = god.Way(corners);
  for (int i = 0; i + 1 < corners; ++i)
  {
    EXPECT_FALSE(exact.Crosses(way[i], way[i + 1])) << "piece " << i;
  }
}
}

TEST_P(RealSurfaces, AreReportedAsTheyAre)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(this->Input);
  filter->Update();
  ASSERT_TRUE(filter->GetSurface());
  const RealSurface& known = GetParam();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys() + filter->GetNumberOfDuplicateTriangles(),
    known.Triangles);
  EXPECT_EQ(filter->GetNumberOfComponents(), known.Components);
  EXPECT_EQ(filter->GetNumberOfNonManifoldEdges(), known.NonManifoldEdges);
  EXPECT_EQ(filter->GetNumberOfFlippedEdges(), known.FlippedEdges);
  EXPECT_EQ(filter->GetClosed(), known.Closed);
  const bool isGood = known.Closed && known.FlippedEdges == 0;
  EXPECT_EQ(
    filter->GetTouchedSide(), isGood ? vtkGodObjectFilter::FRONT : vtkGodObjectFilter::BOTH);
  if (known.Genus >= 0)
  {
    // Euler: points - edges + triangles = 2 (components - genus), with 3/2 edges a triangle.
    const vtkIdType characteristic =
      filter->GetOutput()->GetNumberOfPoints() - filter->GetOutput()->GetNumberOfPolys() / 2;
    EXPECT_EQ(known.Components - characteristic / 2, known.Genus);
  }
}

TEST_P(RealSurfaces, LetNothingThroughAndAreTheSameWithEveryEngine)
{
  std::vector<std::shared_ptr<const TriangleSurface>> surfaces;
  for (const int engine :
    { vtkGodObjectFilter::BRUTE_FORCE, vtkGodObjectFilter::EMBREE, vtkGodObjectFilter::EXACT })
  {
    vtkNew<vtkGodObjectFilter> filter;
    filter->SetInputData(this->Input);
    filter->SetEngine(engine);
    filter->Update();
    ASSERT_TRUE(filter->GetSurface());
    surfaces.push_back(filter->GetSurface());
  }
  const TriangleSurface& surface = *surfaces.front();
  const ExactQueries exact(surfaces.front());
  int ticks = 0;
  int touching = 0;
  for (int stroke = 0; stroke < NumberOfStrokes; ++stroke)
  {
    GodObject first({ surfaces[0] });
    GodObject second({ surfaces[1] });
    GodObject third({ surfaces[2] });
    Stroke hand(surface, stroke);
    Vec3 before = hand.Start();
    double penetration = 0.0;
    for (GodObject* const god : { &first, &second, &third })
    {
      god->Place(before);
    }
    for (int tick = 0; tick < GetParam().Ticks; ++tick)
    {
      const Vec3 hip = hand.Next();
      const Contact& contact = first.Update(hip);
      ASSERT_NE(contact.Status, UpdateStatus::Overloaded)
        << "stroke " << stroke << ", tick " << tick;
      // The god-object never moves away from the HIP: the force grows no faster than the hand
      // moves.
      EXPECT_LE(contact.Penetration,
        (penetration + Length(hip - before)) * (1.0 + 1e-9) + 1e-12 * surface.Radius())
        << "stroke " << stroke << ", tick " << tick;
      ExpectNoCrossing(exact, first);
      for (GodObject* const other : { &second, &third })
      {
        const Contact& same = other->Update(hip);
        ASSERT_LT(Length(same.Position - contact.Position), 1e-9 * surface.Radius())
          << "stroke " << stroke << ", tick " << tick;
        ASSERT_EQ(same.Status, contact.Status);
      }
      ASSERT_FALSE(HasFailure()) << "stroke " << stroke << ", tick " << tick;
      ++ticks;
      touching += contact.Status == UpdateStatus::Touching;
      penetration = contact.Penetration;
      before = hip;
    }
  }
  // A hand that has left over an edge touches nothing any more.
  EXPECT_GT(touching, 0.4 * ticks);
}

INSTANTIATE_TEST_SUITE_P(Each, RealSurfaces, ::testing::ValuesIn(Surfaces),
  [](const auto& info)
  {
    const std::string file = info.param.File;
    return file.substr(0, file.find('.'));
  });

namespace
{
// Before any test makes a surface.
const bool IsExactEnabled = (EnableExactEngine(), true);
}
