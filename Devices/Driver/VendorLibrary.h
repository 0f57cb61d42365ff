#ifndef Haptics_VendorLibrary_h
#define Haptics_VendorLibrary_h

#include <string>
#include <vector>

namespace haptics
{
/// @brief A device maker's library that the user has installed, loaded at run time.
///
/// It stays loaded until the process ends, as it may have threads. Throws DeviceFault where it, or
/// a function of it, is not there.
class VendorLibrary
{
public:
  /// The first of these paths or names that can be loaded; `advice` is what to do where none can.
  VendorLibrary(const std::vector<std::string>& names, const std::string& advice);

  /// Sets `function` to the library's of that name.
  template <typename Function>
  void Get(Function*& function, const char* name) const
  {
    function = reinterpret_cast<Function*>(this->Find(name));
  }

private:
  void* Find(const char* name) const;

  const std::string Advice;
  std::string Name;
  void* Handle = nullptr;
};
}

#endif
