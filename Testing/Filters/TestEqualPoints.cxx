#include "haptics/Filters/EqualPoints.h"
#include "haptics/Filters/PointMerger.h"

#include "vtkNew.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <random>

using namespace haptics;

namespace
{
/// As a PointMerger that is given one point after the other.
void ExpectFirstOnes(
  vtkPoints* points, const Vec3& origin, const std::vector<std::int32_t>& interest)
{
  std::vector<std::int32_t> found = interest;
  ASSERT_TRUE(FindEqualPoints(PointReader(points), origin, found, {}));
  PointMerger merger(0, 0.0);
  std::vector<std::int32_t> first; // of each kept point
  for (std::size_t i = 0; i < interest.size(); ++i)
  {
    if (interest[i] < 0)
    {
      ASSERT_EQ(found[i], interest[i]);
      continue;
    }
    double p[3];
    points->GetPoint(static_cast<vtkIdType>(i), p);
    const auto kept = static_cast<std::size_t>(
      merger.Insert({ p[0] - origin[0], p[1] - origin[1], p[2] - origin[2] }));
    if (kept == first.size())
    {
      first.push_back(static_cast<std::int32_t>(i));
    }
    ASSERT_EQ(found[i], first[kept]) << i;
  }
}
}

/// Regular grids, whose coordinates differ in few bits, several times over, each as stored.
TEST(EqualPoints, AreThoseThatAPointMergerFinds)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    std::mt19937 random(1);
    vtkNew<vtkPoints> points;
    points->SetDataType(type);
    std::vector<std::int32_t> interest;
    for (int i = 0; i < 150000; ++i)
    {
      const std::uint32_t at = random() % 60000;
      const double zero = random() % 2 == 0 ? 0.0 : -0.0;
      points->InsertNextPoint(
        0.25 * (at % 40), 1e6 + at / 40 % 40, at / 1600 == 0 ? zero : at / 1600);
      interest.push_back(random() % 10 == 0 ? -1 : 0);
    }
    ExpectFirstOnes(points, { 0, 0, 0 }, interest);
    ExpectFirstOnes(points, { 5, 1e6 + 20, 18.5 }, interest);
  }
}

TEST(EqualPoints, AreTakenApartByTheirLastBit)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  points->InsertNextPoint(1, 2, 3);
  points->InsertNextPoint(std::nextafter(1.0, 2.0), 2, 3);
  points->InsertNextPoint(1, 2, std::nextafter(3.0, 2.0));
  points->InsertNextPoint(1, 2, 3);
  std::vector<std::int32_t> found(4, 0);
  ASSERT_TRUE(FindEqualPoints(PointReader(points), { 0, 0, 0 }, found, {}));
  EXPECT_EQ(found, (std::vector<std::int32_t>{ 0, 1, 2, 0 }));
}
