#include "haptics/Surface/BruteForceEngine.h"

#include "haptics/Surface/TriangleBounds.h"

namespace haptics
{
namespace
{
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
    return this->Boxes.capacity() * sizeof(TriangleBounds);
  }

private:
  void Take(const EngineInput& input)
  {
    this->Margin = input.Margin;
    this->Boxes.clear();
    this->Boxes.reserve(input.Triangles.size());
    for (const auto& t : input.Triangles)
    {
      this->Boxes.push_back(BoundsOf(input, t));
    }
  }

  // Comparisons of rounded box corners only: the rounding is far below the margin in both calls.
  void FindInBox(const TriangleBounds& box, TriangleList& found) const noexcept
  {
    for (std::size_t i = 0; i < this->Boxes.size(); ++i)
    {
      const TriangleBounds& b = this->Boxes[i];
      const bool apart = b.High.x < box.Low.x || b.Low.x > box.High.x || b.High.y < box.Low.y ||
        b.Low.y > box.High.y || b.High.z < box.Low.z || b.Low.z > box.High.z;
      if (!apart && !found.Add(static_cast<std::int32_t>(i)))
      {
        return;
      }
    }
  }

  std::vector<TriangleBounds> Boxes;
  double Margin = 0.0;
};
}

std::unique_ptr<CollisionEngine> MakeBruteForceEngine(const EngineInput& input)
{
  return std::make_unique<BruteForceEngine>(input);
}
}
