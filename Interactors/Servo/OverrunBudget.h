#ifndef Haptics_OverrunBudget_h
#define Haptics_OverrunBudget_h

#include <algorithm>
#include <cstdint>

namespace haptics
{
/// @brief How many deadlines a servo may miss before it must stop: a bucket that leaks.
///
/// Each missed deadline fills it by one; it leaks `share` of the deadlines that pass. It is full
/// with `share` of a second's deadlines: missing more than `share` for longer than about a second
/// overruns it, and so does one burst as large.
class OverrunBudget
{
public:
  /// `share` of the deadlines, > 0; `period` [ns].
  OverrunBudget(double share, std::uint64_t period)
    : Share(share)
    , Capacity(share * 1e9 / static_cast<double>(period))
  {
  }

  /// Counts deadlines that passed, of which some were missed. False: the budget is used up.
  bool Add(std::uint64_t passed, std::uint64_t missed) noexcept
  {
    this->Level += static_cast<double>(missed) - this->Share * static_cast<double>(passed);
    this->Level = std::max(0.0, this->Level);
    return this->Level <= this->Capacity;
  }

private:
  double Share;
  double Capacity;
  double Level = 0.0;
};
}

#endif
