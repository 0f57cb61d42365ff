#include "haptics/Math/LargePages.h"

#include <gtest/gtest.h>

#include <sys/mman.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace haptics;

namespace
{
/// Whether the system has been asked for large pages at a place: /proc/self/smaps has a block for
/// each mapping, with its bounds first and its flags last.
bool IsAdvised(const void* memory)
{
  std::ifstream file("/proc/self/smaps");
  const auto place = reinterpret_cast<std::uintptr_t>(memory);
  bool isHere = false;
  for (std::string line; std::getline(file, line);)
  {
    unsigned long first = 0;
    unsigned long end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &first, &end) == 2)
    {
      isHere = first <= place && place < end;
    }
    else if (isHere && line.rfind("VmFlags:", 0) == 0)
    {
      std::istringstream flags(line);
      for (std::string flag; flags >> flag;)
      {
        if (flag == "hg")
        {
          return true;
        }
      }
    }
  }
  return false;
}
}

TEST(LargePages, AreAskedForWhatIsLarge)
{
  if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"))
  {
    GTEST_SKIP() << "this system has no large pages";
  }
  std::vector<double> large;
  ReserveLargePages(large, 4 << 20);
  EXPECT_TRUE(IsAdvised(large.data() + (2 << 20)));
  large.resize(4 << 20, 1.5);
  EXPECT_EQ(large.back(), 1.5);
}

TEST(LargePages, LeaveWhatLiesBeside)
{
  // A mapping of its own: memory of the heap may have been large pages' before.
  constexpr std::size_t page = 2 << 20;
  std::size_t left = 3 * page;
  void* const memory =
    mmap(nullptr, left, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  void* begin = memory;
  ASSERT_TRUE(std::align(page, 2 * page, begin, left));
  // Most of two pages, but no whole one.
  AdviseLargePages(static_cast<char*>(begin) + 1, 2 * page - 2);
  EXPECT_FALSE(IsAdvised(begin));
  EXPECT_FALSE(IsAdvised(static_cast<char*>(begin) + page));
  munmap(memory, 3 * page);

  std::vector<double> none;
  ReserveLargePages(none, 0);
  EXPECT_TRUE(none.empty());
}
