#include "haptics/Devices/Haply/HaplyMessage.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace haptics
{
namespace
{
using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

using Json = nlohmann::json;

/// Of what is none, null: a value that is missing or of another type is none.
const Json& Member(const Json& object, const char* name)
{
  static const Json none;
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

bool ReadFlag(const Json& object, const char* name, bool& flag)
{
  const Json& value = Member(object, name);
  if (value.is_boolean())
  {
    flag = value.get<bool>();
  }
  return value.is_boolean();
}

bool ReadNumber(const Json& object, const char* name, double& number)
{
  const Json& value = Member(object, name);
  if (value.is_number())
  {
    number = value.get<double>();
  }
  return value.is_number();
}

void ReadText(const Json& object, const char* name, std::string& text)
{
  const Json& value = Member(object, name);
  if (value.is_string())
  {
    text = value.get<std::string>();
  }
}

bool ReadVector(const Json& object, Vector& vector)
{
  return ReadNumber(object, "x", vector[0]) && ReadNumber(object, "y", vector[1]) &&
    ReadNumber(object, "z", vector[2]);
}

void ReadDevice(const Json& entry, HaplyDevice& device)
{
  const Json& config = Member(entry, "config");
  ReadText(Member(config, "coordinate_system"), "permutation", device.Permutation); // before 3.5
  ReadText(Member(config, "basis"), "permutation", device.Permutation);
  const Json& status = Member(entry, "status");
  ReadFlag(status, "calibrated", device.IsCalibrated);
  ReadFlag(status, "in_use", device.IsInUse);
  ReadFlag(status, "started", device.IsStarted);
  ReadFlag(status, "power_supply", device.IsPowered);
  Vector position;
  device.HasPosition = ReadVector(Member(Member(entry, "state"), "cursor_position"), position);
  if (device.HasPosition)
  {
    device.Position = position;
  }
}

void ReadGrip(const Json& entry, HaplyState& state)
{
  const Json& grip = Member(entry, "state");
  const Json& buttons = Member(grip, "buttons");
  state.Buttons = 0;
  constexpr std::array<const char*, 3> Letters{ { "a", "b", "c" } };
  for (std::size_t i = 0; i < Letters.size(); ++i)
  {
    bool isHeld = false;
    ReadFlag(buttons, Letters[i], isHeld);
    state.Buttons |= isHeld ? 1u << i : 0u;
  }
  bool isHeld = false; // a grip with one button
  ReadFlag(grip, "button", isHeld);
  state.Buttons |= isHeld ? 1u : 0u;

  const Json& orientation = Member(grip, "orientation");
  std::array<double, 4> q{};
  if (ReadNumber(orientation, "w", q[0]) && ReadNumber(orientation, "x", q[1]) &&
    ReadNumber(orientation, "y", q[2]) && ReadNumber(orientation, "z", q[3]))
  {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (length > 0.0 && std::isfinite(length))
    {
      state.Orientation = { q[0] / length, q[1] / length, q[2] / length, q[3] / length };
    }
  }
}

/// Null where the text is no object: what is damaged is damaged, wherever.
Json ObjectOf(std::string_view text)
{
  Json root = Json::parse(text, nullptr, false);
  return root.is_object() ? root : Json();
}

/// Row i is along which of the service's own axes the i-th number is.
bool MatrixOf(const std::string& permutation, Matrix& rows)
{
  rows = {};
  std::size_t row = 0;
  double sign = 1.0;
  for (const char letter : permutation)
  {
    if (letter == '-' && sign > 0.0)
    {
      sign = -1.0;
    }
    else if (letter >= 'X' && letter <= 'Z' && row < 3)
    {
      rows[row++][static_cast<std::size_t>(letter - 'X')] = sign;
      sign = 1.0;
    }
    else
    {
      return false;
    }
  }
  const Matrix& m = rows;
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
    m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
    m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return row == 3 && sign > 0.0 && determinant > 0.0;
}

void Append(double number, std::string& text)
{
  std::array<char, 32> digits{}; // whatever the locale
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), error == std::errc() ? end : digits.data());
}

std::string Escaped(const std::string& text)
{
  return Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
}
}

const HaplyDevice* HaplyState::Find(const std::string& id) const
{
  const auto found = std::find_if(this->Devices.begin(), this->Devices.end(),
    [&id](const HaplyDevice& device) { return id.empty() || device.Id == id; });
  return found == this->Devices.end() ? nullptr : &*found;
}

bool HaplyMessage::Read(std::string_view text, HaplyState& state)
{
  const Json root = ObjectOf(text);
  if (!Member(root, "inverse3").is_array())
  {
    return false;
  }
  std::vector<HaplyDevice> devices;
  for (const Json& entry : root["inverse3"])
  {
    std::string id;
    ReadText(entry, "device_id", id);
    if (!id.empty())
    {
      const HaplyDevice* before = state.Find(id);
      devices.push_back(before ? *before : HaplyDevice());
      devices.back().Id = id;
      ReadDevice(entry, devices.back());
    }
  }
  state.Devices = std::move(devices);
  state.HasGrip = false;
  for (const char* kind : { "verse_grip", "wireless_verse_grip", "custom_verse_grip" })
  {
    const Json& grips = Member(root, kind);
    if (!state.HasGrip && grips.is_array() && !grips.empty())
    {
      state.HasGrip = true;
      ReadGrip(grips[0], state);
    }
  }
  return true;
}

bool HaplyMessage::ReadVersion(std::string_view text, HaplyVersion& version)
{
  const Json root = ObjectOf(text);
  std::string number;
  const Json& data = Member(root, "data"); // some services put their answers into it
  ReadText(data.is_object() ? data : root, "project_version", number);
  return std::sscanf(number.c_str(), "%d.%d", &version.Major, &version.Minor) == 2;
}

void HaplyMessage::WriteForce(const std::string& id, const std::array<double, 3>& force,
  const std::string& permutation, bool hasVectors, const char* profile, std::string& text)
{
  const Vector asked = ToService(force, permutation);
  text = "{";
  if (profile)
  {
    text += R"("session":{"configure":{"profile":{"name":)" + Escaped(profile) + "}}},";
  }
  text += R"("inverse3":[{"device_id":)" + Escaped(id) + R"(,"commands":{"set_cursor_force":{")";
  text += hasVectors ? "vector" : "values";
  text += R"(":{"x":)";
  Append(asked[0], text);
  text += R"(,"y":)";
  Append(asked[1], text);
  text += R"(,"z":)";
  Append(asked[2], text);
  text += "}}}}]}";
}

bool HaplyMessage::IsPermutation(const std::string& permutation)
{
  Matrix rows;
  return MatrixOf(permutation, rows);
}

std::array<double, 3> HaplyMessage::ToDevice(
  const std::array<double, 3>& service, const std::string& permutation)
{
  Matrix rows;
  MatrixOf(permutation, rows);
  Vector own{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      own[j] += rows[i][j] * service[i];
    }
  }
  return { own[0], own[2], -own[1] };
}

std::array<double, 3> HaplyMessage::ToService(
  const std::array<double, 3>& device, const std::string& permutation)
{
  Matrix rows;
  MatrixOf(permutation, rows);
  const Vector own{ device[0], -device[2], device[1] };
  Vector service{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      service[i] += rows[i][j] * own[j];
    }
  }
  return service;
}
}
