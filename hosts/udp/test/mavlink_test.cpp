// SPDX-License-Identifier: MIT
// Against packets that pymavlink has made (mavlink_frames.txt); test_autopilots.py compares that file with pymavlink.
#include "banyan/hosts/udp/mavlink.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>

namespace banyan::udp {
namespace {

class MavlinkPackets : public ::testing::Test {
 protected:
  static const Bytes& packet(const std::string& name) {
    static const std::map<std::string, Bytes> all = read();
    return all.at(name);
  }
  static std::optional<MavlinkWord> read_one(const std::string& name) {
    MavlinkReader reader;
    reader.feed(packet(name));
    const auto word = reader.next();
    EXPECT_FALSE(reader.next()) << name;
    EXPECT_EQ(reader.damaged(), 0U) << name;
    return word;
  }
  template <class Message> static Message message(const std::string& name) {
    const auto word = read_one(name);
    EXPECT_TRUE(word && word->system == 7 && word->component == 1) << name;
    const auto* found = word ? std::get_if<Message>(&word->message) : nullptr;
    EXPECT_NE(found, nullptr) << name;
    return found != nullptr ? *found : Message{};
  }

 private:
  static std::map<std::string, Bytes> read() {
    std::map<std::string, Bytes> packets;
    std::ifstream file(BANYAN_MAVLINK_FRAMES);
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string name, digits;
      if (line.starts_with('#') || !(words >> name >> digits)) continue;
      for (std::size_t k = 0; k + 1 < digits.size(); k += 2)
        packets[name].push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(k, 2), nullptr, 16)));
    }
    return packets;
  }
};

// The check value of CRC-16/MCRF4XX in the catalogue of parametrised CRC algorithms.
TEST(MavlinkCrc, IsMcrf4xx) {
  const std::string digits = "123456789";
  EXPECT_EQ(mavlink_crc(Bytes(digits.begin(), digits.end())), 0x6F91);
}

TEST_F(MavlinkPackets, OfBothVersionsAreRead) {
  for (const char* version : {"", "_v1"}) {
    const auto heartbeat = message<MavlinkHeartbeat>(std::string("heartbeat") + version);
    EXPECT_EQ(heartbeat.type, 2);
    EXPECT_EQ(heartbeat.autopilot, 12);
    EXPECT_EQ(message<MavlinkAttitude>(std::string("attitude") + version).yaw_rad, 1.25F);
    const auto position = message<MavlinkPosition>(std::string("position") + version);
    EXPECT_EQ(position.north_m, 12.5F);
    EXPECT_EQ(position.east_m, -3.25F);
    EXPECT_EQ(position.down_m, -10.0F);
  }
}

TEST_F(MavlinkPackets, SignaturesAreSkippedAndZerosAtTheEndFilledIn) {
  EXPECT_EQ(message<MavlinkPosition>("position_signed").down_m, -10.0F);
  EXPECT_EQ(message<MavlinkPosition>("position_truncated").down_m, 0.0F);
  MavlinkReader reader;
  reader.feed(packet("position_signed"));
  reader.feed(packet("attitude"));
  EXPECT_TRUE(reader.next());
  EXPECT_TRUE(reader.next()) << "what follows a signature is found";
}

TEST_F(MavlinkPackets, OdometryEstimatorsAndPlacesAreRead) {
  const auto odometry = message<MavlinkOdometry>("odometry");
  EXPECT_EQ(odometry.position.east_m, 2.5F);
  EXPECT_NEAR(odometry.yaw_rad, 1.2F, 1e-6F);
  EXPECT_EQ(message<MavlinkEstimator>("estimator").flags, 0x033F);
  EXPECT_EQ(message<MavlinkEstimator>("ekf").flags, 0x00BF);
  const auto home = message<MavlinkReference>("home");
  EXPECT_FALSE(home.is_origin);
  EXPECT_NEAR(home.latitude_deg, 47.397742, 1e-9);
  EXPECT_NEAR(home.longitude_deg, 8.545594, 1e-9);
  EXPECT_EQ(home.north_m, 3.0F);
  EXPECT_EQ(home.east_m, -4.0F);
  const auto origin = message<MavlinkReference>("origin");
  EXPECT_TRUE(origin.is_origin);
  EXPECT_NEAR(origin.latitude_deg, -33.7, 1e-9);
  EXPECT_NEAR(origin.longitude_deg, 151.2, 1e-9);
}

TEST_F(MavlinkPackets, WhatIsUnknownOrNoNumberIsSkipped) {
  for (const char* name : {"unknown", "position_nan", "odometry_of_no_north"}) EXPECT_FALSE(read_one(name)) << name;
  MavlinkReader reader;
  for (const char* name : {"unknown", "position_nan", "attitude"}) reader.feed(packet(name));
  const auto word = reader.next();
  EXPECT_TRUE(word && std::holds_alternative<MavlinkAttitude>(word->message));
}

TEST_F(MavlinkPackets, WhatIsSentIsThatOfPymavlink) {
  const MavlinkSender sender{7, 191, 42};
  EXPECT_EQ(encode(MavlinkSetPoint{98765, 7, 1, 0.5F, -0.25F, 0.125F, -1.5F}, sender), packet("sent_set_point"));
  EXPECT_EQ(encode(MavlinkSetPoint{98765, 7, 1}, sender), packet("sent_stop"));
  EXPECT_EQ(mavlink_heartbeat(sender), packet("sent_heartbeat"));
}

TEST_F(MavlinkPackets, AChangedByteIsNoticedWhereverItIs) {
  for (std::size_t k = 0; k < packet("position").size(); ++k) {
    Bytes changed = packet("position");
    changed[k] ^= 0x10U;
    MavlinkReader reader;
    reader.feed(changed);
    const auto word = reader.next();
    EXPECT_FALSE(word) << "byte " << k;
  }
}

// A serial line that breaks off, with noise between packets: whatever the pieces are, the same is read.
TEST_F(MavlinkPackets, ComeInPiecesAmongNoise) {
  Bytes stream;
  std::size_t sent = 0;
  std::mt19937 dice(1);
  for (int round = 0; round < 50; ++round)
    for (const char* name : {"heartbeat", "attitude_v1", "position_signed", "unknown", "odometry"}) {
      for (unsigned k = 0; k < dice() % 7; ++k) stream.push_back(static_cast<std::uint8_t>(dice() % 0xFD));
      stream.insert(stream.end(), packet(name).begin(), packet(name).end());
      sent += name == std::string("unknown") ? 0 : 1;
    }
  MavlinkReader reader;
  std::size_t read = 0;
  for (std::size_t begin = 0; begin < stream.size();) {
    const std::size_t size = std::min<std::size_t>(1 + dice() % 40, stream.size() - begin);
    reader.feed(ByteView(stream).subspan(begin, size));
    begin += size;
    while (reader.next()) ++read;
  }
  EXPECT_EQ(read, sent);
  EXPECT_EQ(reader.damaged(), 0U);
}

TEST_F(MavlinkPackets, AFalseBeginningCostsNoSoundPacket) {
  Bytes stream{0xFE, 28, 0, 7, 1, 32};  // as if a LOCAL_POSITION_NED began
  for (int k = 0; k < 3; ++k) stream.insert(stream.end(), packet("attitude").begin(), packet("attitude").end());
  MavlinkReader reader;
  reader.feed(stream);
  std::size_t read = 0;
  while (reader.next()) ++read;
  EXPECT_EQ(read, 3U);
  EXPECT_EQ(reader.damaged(), 1U);
}

}  // namespace
}  // namespace banyan::udp
