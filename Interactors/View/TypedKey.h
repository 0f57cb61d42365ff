#ifndef Haptics_TypedKey_h
#define Haptics_TypedKey_h

#include <cstring>

namespace haptics
{
/// What a vtkRenderWindowInteractor reports of a key.
struct ReportedKey
{
  char Code = 0;                ///< vtkRenderWindowInteractor::GetKeyCode()
  const char* Symbol = nullptr; ///< vtkRenderWindowInteractor::GetKeySym()
  bool Shift = false;           ///< vtkRenderWindowInteractor::GetShiftKey()
  bool IgnoresShift = false;    ///< VTK reports what the key types without Shift: X11, before 9.4
};

/// @brief The character that a key types.
///
/// Before VTK 9.4 X11 reports '?' as the key that it lies on: '/' on US keyboards, "ssharp" on
/// German ones; and no character for the keys of the keypad. Which key types '?', '+' and '0' with
/// Shift depends on the keyboard: US and British; German; French and Belgian; Italian, Spanish and
/// Swiss; Nordic.
inline char TypedKey(const ReportedKey& key)
{
  const auto is = [&key](const char* name)
  { return key.Symbol && std::strcmp(key.Symbol, name) == 0; };
  if (is("F1") || is("Help"))
  {
    return '?';
  }
  if (is("KP_Add"))
  {
    return '+';
  }
  if (is("KP_Subtract"))
  {
    return '-';
  }
  if (is("KP_0") || is("KP_Insert"))
  {
    return '0';
  }
  if (key.Shift && key.IgnoresShift)
  {
    if (is("slash") || is("ssharp") || is("comma") || is("apostrophe") || is("plus"))
    {
      return '?';
    }
    if (is("equal"))
    {
      return '+';
    }
    if (is("agrave"))
    {
      return '0';
    }
  }
  return key.Code;
}
}

#endif
