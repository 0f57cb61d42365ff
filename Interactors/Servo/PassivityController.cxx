#include "haptics/Servo/PassivityController.h"

#include <algorithm>

namespace haptics
{
void PassivityController::Restart() noexcept
{
  *this = PassivityController();
}

Vec3 PassivityController::Update(const Vec3& position, double period, double deviceDamping,
  double largestDamping, bool touching) noexcept
{
  Vec3 velocity{};
  double squaredSpeed = 0.0;
  if (this->HasPosition && period > 0.0)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double step = position[i] - this->Position[i];
      this->Energy -= this->Force[i] * step;
      velocity[i] = step / period;
      squaredSpeed += velocity[i] * velocity[i];
    }
    this->Energy += deviceDamping * squaredSpeed * period;
  }
  this->Position = position;
  this->HasPosition = true;
  if (!touching)
  {
    this->Energy = std::min(this->Energy, 0.0);
    return {};
  }
  if (this->Energy >= 0.0 || squaredSpeed == 0.0)
  {
    return {};
  }
  const double damping = std::min(-this->Energy / (period * squaredSpeed), largestDamping);
  return { -damping * velocity[0], -damping * velocity[1], -damping * velocity[2] };
}

void PassivityController::Sent(const Vec3& force, const Vec3& surfaceStep) noexcept
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->Energy += 0.5 * (this->Force[i] + force[i]) * surfaceStep[i];
  }
  this->Force = force;
}
}
