// SPDX-License-Identifier: MIT
// Over real sockets and a terminal. What vehicles do with what they are told is in test_autopilots.py.
#include "banyan/hosts/udp/mavlink_base.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "banyan/hosts/udp/base_wire.hpp"

namespace banyan::udp {
namespace {

// A heartbeat of system 7, by pymavlink (mavlink_frames.txt).
constexpr std::array<std::uint8_t, 21> heartbeat_of_7{0xFD, 9, 0, 0, 42, 7,  1, 0, 0,    0,   0,
                                                      0,    0, 0, 2, 12, 81, 4, 3, 0x02, 0xC3};

class HomeFile : public ::testing::Test {
 protected:
  static AutopilotSetup setup(const std::string& home) {
    RobotOptions options;
    options.id = 3;
    options.home = home;
    return autopilot_setup(options);
  }
  static std::string fault(const std::string& home) {
    try {
      static_cast<void>(setup(home));
    } catch (const BaseError& error) { return error.what(); }
    return "";
  }
  [[nodiscard]] std::string fault_in(const std::string& text) const {
    std::ofstream(path_) << text;
    const std::string words = fault(path_);
    return words.starts_with(path_) ? words.substr(path_.size()) : words;
  }
  std::string path_ = ::testing::TempDir() + "homes.txt";
};

TEST_F(HomeFile, HasTheRobotsOwnLine) {
  std::ofstream(path_) << "# robot east north\n0 1 2\n\n3 -4.5 5e1  # mine\n";
  const AutopilotSetup found = setup(path_);
  ASSERT_TRUE(found.home && !found.origin);
  EXPECT_EQ(*found.home, (BasicVec2<double>{-4.5, 50.0}));
  EXPECT_EQ(found.system, 4) << "its id plus 1";
}

TEST_F(HomeFile, WhatIsWrongIsSaidWithItsLine) {
  EXPECT_EQ(fault_in("0 1 2\n"), ": has no line for robot 3");
  EXPECT_EQ(fault_in("3 1 2\n3 1 2\n"), ":2: robot 3 has a home already");
  for (const char* line : {"3 1", "3 1 2 3", "three 1 2", "3.5 1 2", "-1 1 2", "3 nan 2", "3 1e9 2", "3 1 2x"})
    EXPECT_EQ(
        fault_in(std::string("\n") + line + "\n"),
        std::string(":2: must be ROBOT EAST NORTH, an id and two lengths in m, at most 100000; not \"") + line + "\"");
  EXPECT_EQ(fault("/no/such/file"),
            "--home /no/such/file: No such file or directory; it is a file of homes, LATITUDE,LONGITUDE or tracker");
}

TEST_F(HomeFile, OrAnOriginOnTheGlobeOrATracker) {
  const AutopilotSetup globe = setup("47.4,-8.5");
  ASSERT_TRUE(globe.origin && !globe.home);
  EXPECT_EQ(globe.origin->latitude_deg, 47.4);
  EXPECT_EQ(globe.origin->longitude_deg, -8.5);
  EXPECT_EQ(fault("91,8"), "--home 91,8: a latitude is from -85 to 85 degrees, a longitude from -180 to 180");
  const AutopilotSetup tracked = setup("tracker");
  EXPECT_FALSE(tracked.home || tracked.origin);
}

std::unique_ptr<Driver> opened(const std::string& base) {
  RobotOptions options;
  options.id = 6;
  options.base = base;
  options.height_m = 0.0;
  options.home = "tracker";
  return open_mavlink_base(options);
}

TEST(MavlinkOverUdp, SetPointsGoToTheVehicleThatWasHeardAtLeastFiveTimesASecond) {
  const Socket vehicle(parse_address("127.0.0.1:0"));
  const Address base_address = Socket(parse_address("127.0.0.1:0")).local();  // free again
  const auto base = opened("mavlink:udp:" + to_string(base_address));
  std::array<std::uint8_t, 512> room{};
  Address from;
  base->listen(1.0);
  base->drive({});
  EXPECT_FALSE(vehicle.receive(room, from)) << "nobody to talk to";
  int set_points = 0, heartbeats = 0;
  for (int k = 0; k < 100; ++k) {  // 10 s without a single drive()
    vehicle.send(heartbeat_of_7, base_address);
    base->listen(2.0 + 0.1 * k);
    while (const auto packet = vehicle.receive(room, from)) {
      EXPECT_EQ((*packet)[0], 0xFD);
      EXPECT_EQ((*packet)[5], 7) << "it is a component of the vehicle's system";
      ++((*packet)[7] == 84 ? set_points : heartbeats);
    }
  }
  EXPECT_GE(set_points, 49);
  EXPECT_GE(heartbeats, 9);
  EXPECT_TRUE(from == base_address);
  EXPECT_NE(base->fault().find("LOCAL_POSITION_NED"), std::string::npos) << base->fault();
}

TEST(MavlinkOverUdp, GarbageDoesNoHarm) {
  const Socket vehicle(parse_address("127.0.0.1:0"));
  const Address base_address = Socket(parse_address("127.0.0.1:0")).local();
  const auto base = opened("mavlink:udp:" + to_string(base_address));
  vehicle.send(Bytes(1400, 0xFD), base_address);
  vehicle.send(ByteView(heartbeat_of_7).first(12), base_address);
  vehicle.send(heartbeat_of_7, base_address);
  base->listen(1.0);
  base->drive({});
  std::array<std::uint8_t, 512> room{};
  Address from;
  EXPECT_TRUE(vehicle.receive(room, from)) << "a cut datagram does not swallow the next";
}

TEST(MavlinkOverASerialPort, AtItsSpeed) {
  const int vehicle = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  std::array<char, 128> name{};
  ASSERT_TRUE(vehicle >= 0 && ::grantpt(vehicle) == 0 && ::unlockpt(vehicle) == 0 &&
              ::ptsname_r(vehicle, name.data(), name.size()) == 0);
  const std::string path = name.data();
  EXPECT_THROW(static_cast<void>(opened("mavlink:" + path + "@57601")), BaseError);
  EXPECT_THROW(static_cast<void>(opened("mavlink:" + path + "@fast")), BaseError);
  const auto base = opened("mavlink:" + path + "@57600");
  termios settings{};
  ASSERT_EQ(::tcgetattr(vehicle, &settings), 0);
  EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(B57600));
  std::array<std::uint8_t, 512> room{};
  base->listen(0.0);
  EXPECT_EQ(::read(vehicle, room.data(), room.size()), 21) << "a heartbeat, for which some vehicles wait";
  ASSERT_EQ(::write(vehicle, heartbeat_of_7.data(), heartbeat_of_7.size()),
            static_cast<ssize_t>(heartbeat_of_7.size()));
  base->listen(0.5);
  base->drive({});
  EXPECT_GT(::read(vehicle, room.data(), room.size()), 0);
  EXPECT_EQ(room[0], 0xFD);
  EXPECT_EQ(room[7], 84);
  EXPECT_FALSE(base->lost());
  ::close(vehicle);
  base->listen(2.0);
  EXPECT_TRUE(base->lost());
}

TEST(MavlinkOverASerialPort, SaysWhatIsWrong) {
  EXPECT_THROW(static_cast<void>(opened("mavlink:/no/such/device")), BaseError);
  EXPECT_THROW(static_cast<void>(opened("mavlink:tcp:127.0.0.1:1")), BaseError);
  EXPECT_THROW(static_cast<void>(opened("mavlink:udp:nowhere")), SocketError);
}

}  // namespace
}  // namespace banyan::udp
