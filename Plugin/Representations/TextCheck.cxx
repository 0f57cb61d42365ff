#include "TextCheck.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace haptics
{
namespace
{
const std::string Start = "<VTKFile";
const std::string CheckStart = Start + " check=\"";
constexpr std::size_t CheckDigits = 16;

/// Changes with each byte but of the space at the ends: FNV-1a,
/// http://www.isthe.com/chongo/tech/comp/fnv
std::string CheckOf(const std::string& text)
{
  std::uint64_t sum = 0xcbf29ce484222325u;
  const std::size_t end = text.find_last_not_of(" \t\r\n") + 1;
  for (std::size_t i = std::min(text.find('<'), end); i < end; ++i)
  {
    sum = (sum ^ static_cast<unsigned char>(text[i])) * 0x100000001b3u;
  }
  char digits[CheckDigits + 1];
  std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(sum));
  return digits;
}
}

std::string WithCheck(std::string text)
{
  const std::string check = CheckStart + CheckOf(text) + '"';
  return text.replace(text.find(Start), Start.size(), check);
}

bool IsUnchanged(const std::string& text)
{
  const std::size_t at = text.find(CheckStart);
  if (at == std::string::npos)
  {
    return true; // an earlier version wrote none
  }
  const std::size_t digits = at + CheckStart.size();
  std::string without = text;
  without.replace(at, CheckStart.size() + CheckDigits + 1, Start);
  return text.compare(digits, CheckDigits + 1, CheckOf(without) + '"') == 0;
}
}
