#ifndef Haptics_FuzzInput_h
#define Haptics_FuzzInput_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace haptics::fuzz
{
/// @brief Turns a fuzzer's bytes into choices, numbers and points. Gives zeros once they run out.
class FuzzInput
{
public:
  FuzzInput(const std::uint8_t* data, std::size_t size)
    : Next(data)
    , End(data + size)
  {
  }

  bool IsEmpty() const { return this->Next == this->End; }
  std::uint8_t Byte() { return this->IsEmpty() ? 0 : *this->Next++; }
  /// 0 to count - 1.
  int Choice(int count) { return this->Byte() % count; }
  std::uint64_t Word();

  /// Any float64 that the eight next bytes spell: NaN, infinite, denormal, anything.
  double AnyNumber();
  /// Mostly small multiples of 1/4, which make points meet, lines touch and facets coincide; now
  /// and then the neighbour of one, a far or a tiny number.
  double Coordinate();
  std::array<double, 3> Place()
  {
    return { this->Coordinate(), this->Coordinate(), this->Coordinate() };
  }

private:
  const std::uint8_t* Next;
  const std::uint8_t* End;
};

/// Ends the program with the message where a promise is broken: what a fuzzer looks for.
void Require(bool promise, const char* message);

/// Feeds one input to the target.
void TestOneInput(FuzzInput& input);
}

#endif
