#include "haptics/Devices/Falcon/FalconPacket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace
{
using haptics::Decode;
using haptics::Encode;
using haptics::FalconCommand;
using haptics::FalconPacket;
using haptics::FalconReply;

std::string Text(const FalconPacket& packet)
{
  return std::string(packet.begin(), packet.end());
}

FalconPacket Packet(const std::string& text)
{
  FalconPacket packet{};
  std::copy(text.begin(), text.end(), packet.begin());
  return packet;
}

TEST(FalconPacket, IsWrittenLowNibbleFirstBetweenBrackets)
{
  FalconCommand command;
  command.Torques = { 0x1234, -1, 0 };
  command.Home = true;
  command.Leds = haptics::FalconLedRed | haptics::FalconLedGreen;
  EXPECT_EQ(Text(Encode(command)), "<EDCBPPPPAAAALA>"); // 'L' = 'A' + 1 + 2 + 8
}

TEST(FalconPacket, GivesEveryTorqueBackAtEveryLeg)
{
  using Limits = std::numeric_limits<std::int16_t>;
  for (int value = Limits::min(); value <= Limits::max(); ++value)
  {
    FalconCommand command;
    const auto torque = static_cast<std::int16_t>(value);
    const auto other = static_cast<std::int16_t>(~value);
    command.Torques = { torque, other, static_cast<std::int16_t>(torque ^ 0x5a5a) };
    FalconCommand read;
    ASSERT_TRUE(Decode(Encode(command), read)) << value;
    ASSERT_EQ(read.Torques, command.Torques) << value;
  }
}

TEST(FalconPacket, GivesEveryEncoderCountBackAtEveryLeg)
{
  using Limits = std::numeric_limits<std::int16_t>;
  for (int value = Limits::min(); value <= Limits::max(); ++value)
  {
    FalconReply reply;
    const auto count = static_cast<std::int16_t>(value);
    reply.Encoders = { static_cast<std::int16_t>(count ^ 0x0ff0), count,
      static_cast<std::int16_t>(~value) };
    FalconReply read;
    ASSERT_TRUE(Decode(Encode(reply), read)) << value;
    ASSERT_EQ(read.Encoders, reply.Encoders) << value;
  }
}

TEST(FalconPacket, GivesEveryFlagBack)
{
  for (unsigned int bits = 0; bits < 128; ++bits)
  {
    FalconReply reply;
    reply.Buttons = bits & 15u;
    reply.HomedLegs = bits >> 4;
    FalconReply read;
    ASSERT_TRUE(Decode(Encode(reply), read)) << bits;
    EXPECT_EQ(read.Buttons, reply.Buttons);
    EXPECT_EQ(read.HomedLegs, reply.HomedLegs);
  }
  for (unsigned int bits = 0; bits < 16; ++bits)
  {
    FalconCommand command;
    command.Home = (bits & 1u) != 0;
    command.Leds = bits >> 1;
    FalconCommand read;
    ASSERT_TRUE(Decode(Encode(command), read)) << bits;
    EXPECT_EQ(read.Home, command.Home);
    EXPECT_EQ(read.Leds, command.Leds);
  }
}

TEST(FalconPacket, DropsFlagsThatHaveNoPlace)
{
  FalconReply reply;
  reply.Buttons = 0xff;
  reply.HomedLegs = 0xff;
  EXPECT_EQ(Encode(reply)[13], 'A' + 127);
  FalconCommand command;
  command.Leds = 0xff;
  EXPECT_EQ(Encode(command)[13], 'A' + 15);
}

// One byte of a good packet, any of its 256 values: only what Encode() could write may pass.
TEST(FalconPacket, RefusesEveryByteThatEncodeCannotWrite)
{
  const FalconPacket good = Encode(FalconReply{ { 1, 2, 3 }, 5, 7 });
  for (std::size_t place = 0; place < good.size(); ++place)
  {
    for (int value = 0; value < 256; ++value)
    {
      FalconPacket packet = good;
      packet[place] = static_cast<std::uint8_t>(value);
      const bool digit = value >= 'A' && value <= 'P';
      const bool flags = value >= 'A' && value <= 'A' + 127;
      const bool allowed = place == 0 ? value == '<'
        : place == 15                 ? value == '>'
        : place == 14                 ? true
        : place == 13                 ? flags
                                      : digit;
      FalconReply reply{ { 9, 9, 9 }, 9, 1 };
      ASSERT_EQ(Decode(packet, reply), allowed) << "byte " << place << " value " << value;
      if (!allowed)
      {
        ASSERT_EQ(reply.Encoders[0], 9) << "a refused packet must leave the result";
      }
    }
  }
  FalconCommand command;
  EXPECT_FALSE(Decode(Packet("<AAAAAAAAAAAAQA>"), command)) << "a command has four flags";
}

TEST(FalconTorques, AreClampedTogetherSoThatTheForceKeepsItsDirection)
{
  using Units = std::array<std::int16_t, 3>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(haptics::ClampTorques({ 4095.0, -4095.0, 0.4 }), (Units{ 4095, -4095, 0 }));
  EXPECT_EQ(haptics::ClampTorques({ 8190.0, -4000.0, 2.0 }), (Units{ 4095, -2000, 1 }));
  EXPECT_EQ(haptics::ClampTorques({ 33000.0, 0.0, 0.0 }), (Units{ 4095, 0, 0 }))
    << "16 bits would have wrapped to -32536";
  EXPECT_EQ(haptics::ClampTorques({ 1e300, -1e300, 1.0 }), (Units{ 4095, -4095, 0 }));
  EXPECT_EQ(haptics::ClampTorques({ 1.0, nan, 1.0 }), (Units{}));
  EXPECT_EQ(haptics::ClampTorques({ 1.0, HUGE_VAL, 1.0 }), (Units{}));
}

std::vector<FalconReply> Feed(haptics::FalconPacketReader& reader, const std::string& bytes)
{
  std::vector<FalconReply> replies;
  for (const char byte : bytes)
  {
    FalconReply reply;
    if (reader.Push(static_cast<std::uint8_t>(byte), reply))
    {
      replies.push_back(reply);
    }
  }
  return replies;
}

const std::string First = Text(Encode(FalconReply{ { 100, -200, 300 }, 1, 7 }));
const std::string Second = Text(Encode(FalconReply{ { -1, 0, 1 }, 8, 7 }));

TEST(FalconPacketReader, JoinsPacketsHoweverTheyAreCut)
{
  for (std::size_t cut = 0; cut <= First.size(); ++cut)
  {
    haptics::FalconPacketReader reader;
    auto replies = Feed(reader, First.substr(0, cut));
    const auto rest = Feed(reader, First.substr(cut) + Second);
    replies.insert(replies.end(), rest.begin(), rest.end());
    ASSERT_EQ(replies.size(), 2u) << cut;
    EXPECT_EQ(replies[0].Encoders[1], -200);
    EXPECT_EQ(replies[1].Encoders[2], 1);
    EXPECT_EQ(reader.GetNumberOfMalformed(), 0u);
  }
}

TEST(FalconPacketReader, LosesNoGoodPacketBehindADamagedOne)
{
  for (std::size_t lost = 1; lost < First.size(); ++lost)
  {
    std::string damaged = First;
    damaged.erase(lost, 1);
    haptics::FalconPacketReader reader;
    const auto replies = Feed(reader, damaged + Second + First);
    ASSERT_EQ(replies.size(), 2u) << "without byte " << lost;
    EXPECT_EQ(replies[0].Buttons, 8);
    EXPECT_EQ(reader.GetNumberOfMalformed(), 1u);
  }
}

TEST(FalconPacketReader, ForgetsAPieceWhenCleared)
{
  haptics::FalconPacketReader reader;
  Feed(reader, First.substr(0, 7));
  reader.Clear();
  EXPECT_EQ(Feed(reader, Second).size(), 1u);
  EXPECT_EQ(reader.GetNumberOfMalformed(), 0u);
}

TEST(FtdiRead, IsItsBytesBehindTheModemStatus)
{
  const std::uint8_t bytes[65] = { 0x01, 0x60, 'x', 'y' };
  haptics::FtdiPayload payload{};
  ASSERT_TRUE(haptics::ReadFtdi(bytes, 4, payload));
  EXPECT_EQ(payload.Size, 2u);
  EXPECT_EQ(payload.Bytes[1], 'y');
  ASSERT_TRUE(haptics::ReadFtdi(bytes, 2, payload)) << "nothing but the status is no error";
  EXPECT_EQ(payload.Size, 0u);
  EXPECT_FALSE(haptics::ReadFtdi(bytes, 1, payload));
  EXPECT_FALSE(haptics::ReadFtdi(bytes, 0, payload));
  EXPECT_FALSE(haptics::ReadFtdi(bytes, 65, payload));
}
}
