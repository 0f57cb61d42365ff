#include "haptics/Surface/BruteForceEngine.h"

#include "haptics/Math/VectorMath.h"

#include <glm/common.hpp>

namespace haptics
{
namespace
{
struct Bounds
{
  Vector Low, High;
};

Bounds BoundsOf(const std::vector<Vec3>& points, const std::array<std::int32_t, 3>& t)
{
  const Vector a = ToVector(points[t[0]]);
  const Vector b = ToVector(points[t[1]]);
  const Vector c = ToVector(points[t[2]]);
  return { glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)) };
}

class BruteForceEngine final : public CollisionEngine
{
public:
  explicit BruteForceEngine(const EngineInput& input) { this->Take(input); }

  void FindInBall(const Vec3& centre, double radius, TriangleList& found) const noexcept override
  {
    const Vector c = ToVector(centre);
    this->FindInBox({ c - radius, c + radius }, found);
  }

  void FindOnSegment(const Vec3& from, const Vec3& to, TriangleList& found) const noexcept override
  {
    const Vector p = ToVector(from);
    const Vector q = ToVector(to);
    this->FindInBox({ glm::min(p, q) - this->Margin, glm::max(p, q) + this->Margin }, found);
  }

  bool Refit(const EngineInput& input) override
  {
    this->Take(input);
    return true;
  }

  std::unique_ptr<CollisionEngine> Clone() const override
  {
    return std::make_unique<BruteForceEngine>(*this);
  }

  EngineKind Kind() const noexcept override { return EngineKind::BruteForce; }
  std::size_t MemoryBytes() const noexcept override
  {
    return this->Boxes.capacity() * sizeof(Bounds);
  }

private:
  void Take(const EngineInput& input)
  {
    this->Margin = input.Margin;
    this->Boxes.clear();
    this->Boxes.reserve(input.Triangles.size());
    for (const auto& t : input.Triangles)
    {
      Bounds box = BoundsOf(input.Points, t);
      if (input.StartPoints)
      {
        const Bounds start = BoundsOf(*input.StartPoints, t);
        box = { glm::min(box.Low, start.Low), glm::max(box.High, start.High) };
      }
      this->Boxes.push_back(box);
    }
  }

  // Comparisons of rounded box corners only: the rounding is far below the margin in both calls.
  void FindInBox(const Bounds& box, TriangleList& found) const noexcept
  {
    for (std::size_t i = 0; i < this->Boxes.size(); ++i)
    {
      const Bounds& b = this->Boxes[i];
      const bool apart = b.High.x < box.Low.x || b.Low.x > box.High.x || b.High.y < box.Low.y ||
        b.Low.y > box.High.y || b.High.z < box.Low.z || b.Low.z > box.High.z;
      if (!apart && !found.Add(static_cast<std::int32_t>(i)))
      {
        return;
      }
    }
  }

  std::vector<Bounds> Boxes;
  double Margin = 0.0;
};
}

std::unique_ptr<CollisionEngine> MakeBruteForceEngine(const EngineInput& input)
{
  return std::make_unique<BruteForceEngine>(input);
}
}
