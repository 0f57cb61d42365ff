#ifndef Haptics_ErrorText_h
#define Haptics_ErrorText_h

#include <string>

namespace haptics
{
/// Appends what happened of the text of a vtkCommand::ErrorEvent: of
/// "ERROR: In file, line 1\nvtkClass (0x1): what happened\n\n" the words "what happened".
inline void AppendErrorText(std::string& errors, const char* eventText)
{
  std::string text = eventText;
  const std::size_t start = text.find("): ");
  if (start != std::string::npos)
  {
    text.erase(0, start + 3);
  }
  text.erase(text.find_last_not_of(" \n") + 1);
  errors += (errors.empty() ? "" : " ") + text;
}
}

#endif
