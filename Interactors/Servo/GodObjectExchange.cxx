#include "haptics/Servo/GodObjectExchange.h"

#include <utility>
#include <vector>

namespace haptics
{
GodObjectExchange::GodObjectExchange()
{
  auto freeSpace = std::make_unique<NumberedGodObject>();
  freeSpace->Object = std::make_unique<GodObject>(std::vector<TouchedSurface>{});
  this->Current = freeSpace.release();
}

GodObjectExchange::~GodObjectExchange()
{
  this->Collect();
  delete this->Incoming.load(std::memory_order_acquire);
  delete this->Current;
}

std::uint64_t GodObjectExchange::Publish(std::unique_ptr<GodObject> next)
{
  this->Collect();
  auto numbered = std::make_unique<NumberedGodObject>();
  numbered->Object = std::move(next);
  numbered->Generation = ++this->Generations;
  // Release: the servo sees a whole god-object. Acquire: a dropped one is safe to delete.
  delete this->Incoming.exchange(numbered.release(), std::memory_order_acq_rel);
  return this->Generations;
}

void GodObjectExchange::Collect()
{
  NumberedGodObject* retired = nullptr;
  while (this->Retired.Pop(retired))
  {
    delete retired;
  }
}

NumberedGodObject& GodObjectExchange::Take() noexcept
{
  if (this->Incoming.load(std::memory_order_relaxed) && this->Retired.HasRoom() &&
    this->Current->Object->HasArrived())
  {
    // Publish() never withdraws, so there is still one, perhaps a newer one.
    NumberedGodObject* next = this->Incoming.exchange(nullptr, std::memory_order_acq_rel);
    next->IsSeamless = next->Object->Continue(*this->Current->Object);
    this->Retired.Push(this->Current);
    this->Current = next;
  }
  return *this->Current;
}
}
