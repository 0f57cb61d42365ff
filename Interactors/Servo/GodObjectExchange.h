#ifndef Haptics_GodObjectExchange_h
#define Haptics_GodObjectExchange_h

#include "haptics/Contact/GodObject.h"
#include "haptics/Servo/RingBuffer.h"
#include "vtkHapticsServoModule.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace haptics
{
/// A god-object with the number under which it was published.
struct NumberedGodObject
{
  std::unique_ptr<GodObject> Object;
  std::uint64_t Generation = 0;
  bool IsSeamless = false; ///< goes on where the one before was, with surfaces that have not jumped
};

/// @brief Swaps the servo's god-object for one with other surfaces, wait-free.
///
///     GUI thread  --Publish-->  [ incoming ]  --Take-->  servo thread
///                 <--Collect--  [ retired  ]  <---------  (the one before)
///
/// God-objects are made and deleted on the GUI thread alone.
class VTKHAPTICSSERVO_EXPORT GodObjectExchange
{
public:
  GodObjectExchange();
  ~GodObjectExchange();
  GodObjectExchange(const GodObjectExchange&) = delete;
  GodObjectExchange& operator=(const GodObjectExchange&) = delete;

  /// Hands a god-object (not null) to the servo in place of the one it has, and returns its
  /// number: 1 for the first. One that the servo has not taken yet is dropped. GUI thread.
  std::uint64_t Publish(std::unique_ptr<GodObject> next);
  /// Deletes what the servo has given back. GUI thread.
  void Collect();

  /// The servo's god-object: the newest published one, which goes on where the last one stood, once
  /// that one's surfaces no longer deform (GodObject::HasArrived(), within a second).
  /// Never null. Servo thread.
  NumberedGodObject& Take() noexcept;
  /// Whether another one waits for that. Servo thread.
  bool HasNext() const noexcept
  {
    return this->Incoming.load(std::memory_order_relaxed) != nullptr;
  }

private:
  // Between two calls of Collect() in Publish() the servo can retire two: the one that it had when
  // the older publication came, and that publication.
  static constexpr std::size_t MostRetired = 2;

  std::atomic<NumberedGodObject*> Incoming{ nullptr };
  RingBuffer<NumberedGodObject*> Retired{ MostRetired };
  NumberedGodObject* Current;    // the servo thread's
  std::uint64_t Generations = 0; // the GUI thread's
};
}

#endif
