#include "TextCheck.h"

#include "vtkBase64Utilities.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLDataParser.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <sstream>
#include <vector>

namespace haptics
{
namespace
{
constexpr double MostExpansion = 1032.0;    // of zlib
constexpr std::size_t LeastBlock = 1 << 16; // [byte]; the writer's is 1 << 15

/// What an element holds before others that are in it, without spaces.
std::string DataOf(vtkXMLDataElement* element, const std::string& text)
{
  auto at = std::min(static_cast<std::size_t>(element->GetXMLByteIndex()), text.size());
  for (char quote = 0; at < text.size() && (quote || text[at] != '>'); ++at)
  {
    const bool isQuote = text[at] == '"' || text[at] == '\'';
    quote = isQuote && !quote ? text[at] : text[at] == quote ? '\0' : quote;
  }
  at = std::min(at + 1, text.size());
  std::string data = text.substr(at, text.find('<', at) - at);
  data.erase(
    std::remove_if(data.begin(), data.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
    data.end());
  return data;
}

/// The first `count` numbers of an array's data, of so many bytes each; fewer where it is shorter.
std::vector<std::uint64_t> HeaderOf(std::string digits, std::size_t count, std::size_t width)
{
  digits.resize(std::min(digits.size(), 4 * ((count * width + 2) / 3)));
  std::vector<unsigned char> bytes(digits.size() + 3);
  bytes.resize(
    vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(digits.data()),
      digits.size(), bytes.data(), bytes.size()));
  std::vector<std::uint64_t> numbers(std::min(count, bytes.size() / width));
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    std::memcpy(&numbers[i], &bytes[i * width], width); // little endian
  }
  return numbers;
}

/// What texts of earlier versions say of their arrays: the reader allocates by it before it looks
/// at the data, and ends the program where there is no such memory, or type.
class Sizes
{
public:
  Sizes(vtkXMLDataElement* root, const std::string& text)
    : Text(text)
    , Length(text.size())
    , Width(IsEqual(root->GetAttribute("header_type"), "UInt64") ? 8 : 4)
    , IsCompressed(root->GetAttribute("compressor") != nullptr)
  {
  }

  /// Of an element and all in it.
  bool ArePlausible(vtkXMLDataElement* element) const
  {
    const bool isArray =
      IsEqual(element->GetName(), "DataArray") || IsEqual(element->GetName(), "Array");
    double number = 1.0;
    for (int i = 0; i < element->GetNumberOfAttributes(); ++i)
    {
      const std::string name = element->GetAttributeName(i);
      double value = 0.0;
      const bool isSize = name.rfind("NumberOf", 0) == 0;
      if (isSize && !(element->GetScalarAttribute(name.c_str(), value) && this->Bears(value)))
      {
        return false;
      }
      number *= isSize && isArray ? value : 1.0;
    }
    if (!this->Bears(number) ||
      (isArray && !(HasKnownType(element) && this->HasPlausibleHeader(element))))
    {
      return false;
    }
    for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
    {
      if (!this->ArePlausible(element->GetNestedElement(i)))
      {
        return false;
      }
    }
    return true;
  }

private:
  static bool IsEqual(const char* text, const char* other)
  {
    return text && std::strcmp(text, other) == 0;
  }
  static bool HasKnownType(vtkXMLDataElement* array)
  {
    const auto is = [array](const char* type)
    { return IsEqual(array->GetAttribute("type"), type); };
    constexpr const char* Types[] = { "Bit", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32",
      "Int64", "UInt64", "Float32", "Float64" };
    return IsEqual(array->GetName(), "Array") ? is("String")
                                              : std::any_of(std::begin(Types), std::end(Types), is);
  }
  bool Bears(double size) const
  {
    return size >= 0.0 && size <= MostExpansion * static_cast<double>(this->Length);
  }
  /// Number of blocks, size of a block, of the last one, and what each takes in the text.
  bool HasPlausibleHeader(vtkXMLDataElement* array) const
  {
    if (IsEqual(array->GetAttribute("format"), "ascii"))
    {
      return true;
    }
    if (!IsEqual(array->GetAttribute("format"), "binary"))
    {
      return false;
    }
    if (!this->IsCompressed)
    {
      return true; // whose size is that of the array
    }
    const std::string data = DataOf(array, this->Text);
    const std::vector<std::uint64_t> head = HeaderOf(data, 3, this->Width);
    if (head.size() < 3 || head[1] == 0)
    {
      return false;
    }
    const std::size_t count = std::min<std::uint64_t>(head[0], this->Length);
    const std::vector<std::uint64_t> all = HeaderOf(data, 3 + count, this->Width);
    const bool hasMore = data.size() > 4 * this->Width; // than those three numbers
    return hasMore == (head[0] > 0) && all.size() == 3 + head[0] &&
      head[1] <= std::max(LeastBlock, 2 * this->Length) && head[2] <= head[1] &&
      std::all_of(
        all.begin() + 3, all.end(), [this](std::uint64_t size) { return size <= this->Length; });
  }

  const std::string& Text;
  std::size_t Length; // of the text [byte]
  std::size_t Width;  // of a number in a header [byte]
  bool IsCompressed;
};

/// Whether a text without a check, as earlier versions wrote it, is one that the reader bears.
bool IsPlausible(const std::string& text)
{
  std::istringstream stream(text);
  vtkNew<vtkXMLDataParser> parser;
  parser->AddObserver(vtkCommand::ErrorEvent, vtkNew<vtkCallbackCommand>()); // the caller says so
  parser->SetStream(&stream);
  vtkXMLDataElement* const root = parser->Parse() ? parser->GetRootElement() : nullptr;
  const auto is = [root](const char* name, const char* value)
  { return root && root->GetAttribute(name) && std::strcmp(root->GetAttribute(name), value) == 0; };
  const bool isKnown = is("type", "PolyData") && is("byte_order", "LittleEndian") &&
    (is("header_type", "UInt32") || is("header_type", "UInt64")) &&
    (!root->GetAttribute("compressor") || is("compressor", "vtkZLibDataCompressor"));
  return isKnown && Sizes(root, text).ArePlausible(root);
}

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

bool IsWhole(const std::string& text)
{
  const std::size_t at = text.find(CheckStart);
  if (at == std::string::npos)
  {
    return IsPlausible(text);
  }
  const std::size_t digits = at + CheckStart.size();
  std::string without = text;
  without.replace(at, CheckStart.size() + CheckDigits + 1, Start);
  return text.compare(digits, CheckDigits + 1, CheckOf(without) + '"') == 0;
}
}
