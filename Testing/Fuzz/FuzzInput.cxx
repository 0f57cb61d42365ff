#include "FuzzInput.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace haptics::fuzz
{
std::uint64_t FuzzInput::Word()
{
  std::uint64_t word = 0;
  for (int i = 0; i < 8; ++i)
  {
    word = word << 8 | this->Byte();
  }
  return word;
}

double FuzzInput::AnyNumber()
{
  const std::uint64_t bits = this->Word();
  double number;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

double FuzzInput::Coordinate()
{
  const int byte = this->Byte();
  const double lattice = 0.25 * (this->Choice(17) - 8);
  if (byte < 200)
  {
    return lattice;
  }
  if (byte < 220)
  {
    return std::nextafter(lattice, byte % 2 ? HUGE_VAL : -HUGE_VAL);
  }
  if (byte < 235)
  {
    return lattice + std::ldexp(1.0, -this->Choice(64));
  }
  if (byte < 245)
  {
    return std::ldexp(lattice, this->Choice(230));
  }
  if (byte < 250)
  {
    return std::ldexp(lattice, -4 * this->Choice(255));
  }
  return this->AnyNumber();
}

void Require(bool promise, const char* message)
{
  if (!promise)
  {
    std::fprintf(stderr, "Broken promise: %s\n", message);
    std::abort();
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  haptics::fuzz::FuzzInput input(data, size);
  haptics::fuzz::TestOneInput(input);
  return 0;
}
