#ifndef Haptics_TextCheck_h
#define Haptics_TextCheck_h

#include <string>

namespace haptics
{
/// Notes a check sum in the text of a .vtp file: a reader may end the program by one that was cut
/// or changed.
std::string WithCheck(std::string text);

/// Whether a text is as WithCheck() has made it, but for space at its ends; or, where it has no
/// check, one of an earlier version that a reader bears.
bool IsWhole(const std::string& text);
}

#endif
