#ifndef Haptics_Statistics_h
#define Haptics_Statistics_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace haptics::testing
{
/// 0.5 is the median, 1 the largest; 0 where there are none.
inline double Quantile(std::vector<double> values, double quantile)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto nth =
    values.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

inline double Mean(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}
}

#endif
