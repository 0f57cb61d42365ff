// Runs a fuzz target without libFuzzer: on the files named, or on random bytes.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char* argv[])
{
  constexpr unsigned numberOfInputs = 1000;
  for (int i = 1; i < argc; ++i)
  {
    std::ifstream file(argv[i], std::ios::binary);
    if (!file)
    {
      std::fprintf(stderr, "%s cannot be read. Usage: %s [FILE...]\n", argv[i], argv[0]);
      return 2;
    }
    const std::vector<char> bytes{ std::istreambuf_iterator<char>(file), {} };
    std::printf("%s\n", argv[i]);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  for (unsigned seed = 0; argc == 1 && seed < numberOfInputs; ++seed)
  {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> bytes(random() % 2000);
    for (std::uint8_t& byte : bytes)
    {
      byte = static_cast<std::uint8_t>(random());
    }
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::puts("No promise broken.");
  return 0;
}
