#ifndef Haptics_TextCheck_h
#define Haptics_TextCheck_h

#include <string>

namespace haptics
{
/// Notes a check sum in the text of a .vtp file: a reader may end the program by one that was cut
/// or changed.
std::string WithCheck(std::string text);

/// Whether a text with a check sum is as WithCheck() has made it, but for space at its ends; true
/// for one without, which a reader has to judge: earlier versions wrote none.
bool IsUnchanged(const std::string& text);
}

#endif
