// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/autopilot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace banyan::udp {
namespace {

constexpr float pi_f = std::numbers::pi_v<float>;

class AnAutopilot : public ::testing::Test {
 protected:
  static AutopilotSetup at_home(double east_m, double north_m) {
    AutopilotSetup setup;
    setup.system = 4;
    setup.height_m = 10.0;
    setup.home = {east_m, north_m};
    return setup;
  }
  void say(const MavlinkMessage& message, std::uint8_t system = 4, const char* from = "10.0.0.4:14580") {
    autopilot_.hear({system, 1, message}, parse_address(from), now_s_);
  }
  void beat(std::uint8_t system = 4, const char* from = "10.0.0.4:14580") {
    say(MavlinkHeartbeat{2, 12}, system, from);
  }
  // Flies on for a moment, saying all that is needed.
  void fly(double seconds, float yaw_rad = 0.0F, MavlinkPosition position = {0.0F, 0.0F, -10.0F}) {
    for (const double end = now_s_ + seconds; now_s_ < end; now_s_ += 0.1) {
      beat();
      say(MavlinkAttitude{yaw_rad});
      say(position);
      autopilot_.refresh(now_s_);
    }
  }
  void wait(double seconds) { autopilot_.refresh(now_s_ += seconds); }
  [[nodiscard]] MavlinkSetPoint told() const { return autopilot_.set_point({1.0F, 0.5F, 0.25F}, now_s_); }
  [[nodiscard]] bool is_stopped() const {
    const MavlinkSetPoint point = told();
    return point.north_m_s == 0.0F && point.east_m_s == 0.0F && point.down_m_s == 0.0F && point.yaw_rate_rad_s == 0.0F;
  }
  [[nodiscard]] bool says(const std::string& words) const {
    return autopilot_.fault().find(words) != std::string::npos;
  }
  Autopilot autopilot_{at_home(20.0, 30.0)};
  double now_s_ = 100.0;
};

TEST_F(AnAutopilot, TurnsTheBodysVelocityToNorthAndEast) {
  fly(1.0, 0.0F);  // it points north
  EXPECT_NEAR(told().north_m_s, 1.0F, 1e-6F);
  EXPECT_NEAR(told().east_m_s, -0.5F, 1e-6F) << "left of north is west";
  EXPECT_EQ(told().yaw_rate_rad_s, -0.25F) << "counter-clockwise is negative in its frame";
  EXPECT_EQ(told().target_system, 4);
  fly(0.2, pi_f / 2.0F);  // east
  EXPECT_NEAR(told().north_m_s, 0.5F, 1e-6F);
  EXPECT_NEAR(told().east_m_s, 1.0F, 1e-6F);
}

TEST_F(AnAutopilot, KnowsWhereItIsInTheScenario) {
  fly(1.0, pi_f / 2.0F, {5.0F, 7.0F, -10.0F});
  ASSERT_TRUE(autopilot_.place());
  EXPECT_NEAR(autopilot_.place()->position.x, 27.0, 1e-6);
  EXPECT_NEAR(autopilot_.place()->position.y, 35.0, 1e-6);
  EXPECT_NEAR(autopilot_.place()->heading_rad, 0.0, 1e-6) << "east is the scenario's x axis";
  const OdometricPose pose = autopilot_.poses().at(now_s_);
  EXPECT_EQ(pose.position, (Vec2{7.0F, 5.0F}));
}

TEST_F(AnAutopilot, KeepsItsHeight) {
  fly(1.0, 0.0F, {0.0F, 0.0F, -9.5F});
  EXPECT_NEAR(told().down_m_s, -0.5F, 1e-6F);
  fly(0.2, 0.0F, {0.0F, 0.0F, -50.0F});
  EXPECT_EQ(told().down_m_s, 1.0F) << "it descends slowly";
}

TEST_F(AnAutopilot, StandsWithoutAHeartbeatAndGoesOnWithOne) {
  EXPECT_TRUE(is_stopped());
  fly(3.0);
  EXPECT_FALSE(is_stopped());
  EXPECT_EQ(autopilot_.fault(), "");
  wait(2.1);
  EXPECT_TRUE(is_stopped());
  EXPECT_TRUE(says("no heartbeat of MAVLink system 4")) << autopilot_.fault();
  EXPECT_FALSE(autopilot_.place());
  ASSERT_EQ(autopilot_.sources().size(), 1U) << "it is still told to stand";
  fly(0.2);
  EXPECT_FALSE(is_stopped());
  EXPECT_EQ(autopilot_.fault(), "");
}

TEST_F(AnAutopilot, StandsWhereTwoVehiclesHaveItsId) {
  fly(3.0);
  beat(4, "10.0.0.5:14580");
  wait(0.0);
  EXPECT_TRUE(is_stopped());
  EXPECT_TRUE(says("two vehicles are MAVLink system 4") && says("10.0.0.4:14580") && says("10.0.0.5:14580"))
      << autopilot_.fault();
  EXPECT_EQ(autopilot_.sources().size(), 2U) << "both are told to stand";
  fly(2.2);  // the other one has left
  EXPECT_FALSE(is_stopped());
}

TEST_F(AnAutopilot, OfAnotherIdIsNotFlownButNamed) {
  for (int k = 0; k < 30; ++k) {
    beat(9, "10.0.0.9:14580");
    wait(0.1);
  }
  EXPECT_TRUE(is_stopped());
  EXPECT_TRUE(autopilot_.sources().empty());
  EXPECT_TRUE(says("nothing is heard of MAVLink system 4, but of 9; --system")) << autopilot_.fault();
}

TEST_F(AnAutopilot, GroundStationsAndOtherComponentsAreNoVehicle) {
  say(MavlinkHeartbeat{6, 8});
  autopilot_.hear({4, 154, MavlinkHeartbeat{30, 12}}, parse_address("10.0.0.4:14580"), now_s_);
  wait(0.0);
  EXPECT_TRUE(autopilot_.sources().empty());
}

TEST_F(AnAutopilot, StandsWhenItDoesNotKnowWhereItIs) {
  fly(3.0);
  for (int k = 0; k < 6; ++k) {
    beat();
    say(MavlinkAttitude{});
    wait(0.1);
  }
  EXPECT_TRUE(is_stopped());
  EXPECT_TRUE(says("LOCAL_POSITION_NED")) << autopilot_.fault();
  fly(0.2);
  EXPECT_FALSE(is_stopped());
  for (int k = 0; k < 6; ++k) {
    beat();
    say(MavlinkPosition{});
    wait(0.1);
  }
  EXPECT_TRUE(is_stopped());
  EXPECT_TRUE(says("ATTITUDE")) << autopilot_.fault();
}

TEST_F(AnAutopilot, StandsWhenItsEstimatorIsNotSure) {
  fly(3.0);
  say(MavlinkEstimator{0x033F});
  fly(0.2);
  EXPECT_FALSE(is_stopped());
  for (const unsigned flags : {0x033FU | 0x80U, 0x033FU & ~1U, 0x033FU & ~2U, 0x033FU & ~0x18U}) {
    say(MavlinkEstimator{static_cast<std::uint16_t>(flags)});
    fly(0.2);
    EXPECT_TRUE(is_stopped()) << flags;
    EXPECT_TRUE(says("its estimator's flags are 0x0")) << autopilot_.fault();
  }
  say(MavlinkEstimator{0x033F & ~0x10});  // relative, not absolute
  fly(0.2);
  EXPECT_FALSE(is_stopped());
}

TEST_F(AnAutopilot, OdometryWillDoAlone) {
  for (int k = 0; k < 30; ++k) {
    beat();
    say(MavlinkOdometry{{1.0F, 2.0F, -10.0F}, pi_f / 2.0F});
    wait(0.1);
  }
  EXPECT_FALSE(is_stopped());
  EXPECT_NEAR(told().east_m_s, 1.0F, 1e-6F);
  EXPECT_EQ(autopilot_.poses().at(now_s_).position, (Vec2{2.0F, 1.0F}));
}

TEST_F(AnAutopilot, HomeOnTheGlobe) {
  AutopilotSetup setup = at_home(0.0, 0.0);
  setup.home.reset();
  setup.origin = GlobePoint{47.0, 8.0};
  autopilot_ = Autopilot(setup);
  fly(3.0, 0.0F, {5.0F, 7.0F, -10.0F});
  EXPECT_TRUE(is_stopped());
  EXPECT_TRUE(says("GPS_GLOBAL_ORIGIN or HOME_POSITION")) << autopilot_.fault();
  // A thousandth of a degree: 111.19 m, and 75.83 m along the parallel of 47 degrees. Home is not the origin.
  say(MavlinkReference{false, 47.001, 8.001, 3.0F, -4.0F});
  fly(0.2, 0.0F, {5.0F, 7.0F, -10.0F});
  EXPECT_FALSE(is_stopped());
  EXPECT_NEAR(autopilot_.place()->position.x, 75.83 + 4.0 + 7.0, 0.01);
  EXPECT_NEAR(autopilot_.place()->position.y, 111.19 - 3.0 + 5.0, 0.01);
  say(MavlinkReference{true, 47.0, 8.0, 0.0F, 0.0F});
  say(MavlinkReference{false, 47.001, 8.001, 0.0F, 0.0F});  // goes behind
  fly(0.2, 0.0F, {5.0F, 7.0F, -10.0F});
  EXPECT_NEAR(autopilot_.place()->position.x, 7.0, 1e-3);
}

// Its home moves whenever it is armed, and HOME_POSITION has zeros in place of where that is in the local frame.
TEST_F(AnAutopilot, ThatIsArduPilotMustSayItsOrigin) {
  AutopilotSetup setup = at_home(0.0, 0.0);
  setup.home.reset();
  setup.origin = GlobePoint{47.0, 8.0};
  autopilot_ = Autopilot(setup);
  fly(3.0);
  constexpr std::uint8_t ardupilot = 3;
  say(MavlinkHeartbeat{2, ardupilot});
  say(MavlinkReference{false, 47.001, 8.001, 0.0F, 0.0F});
  autopilot_.refresh(now_s_);
  EXPECT_TRUE(says("GPS_GLOBAL_ORIGIN is needed once")) << autopilot_.fault();
  EXPECT_FALSE(autopilot_.place());
  say(MavlinkReference{true, 47.0, 8.0, 0.0F, 0.0F});
  autopilot_.refresh(now_s_);
  EXPECT_FALSE(is_stopped());
  EXPECT_NEAR(autopilot_.place()->position.x, 0.0, 1e-3);
}

TEST_F(AnAutopilot, ThatATrackerSeesHasNoPlaceOfItsOwn) {
  AutopilotSetup setup = at_home(0.0, 0.0);
  setup.home.reset();
  autopilot_ = Autopilot(setup);
  fly(3.0);
  EXPECT_FALSE(is_stopped());
  EXPECT_FALSE(autopilot_.place());
}

TEST(MetresFrom, AlongTheEquatorAndAcrossTheDateLine) {
  const auto across = metres_from({0.0, 179.9995}, {0.0005, -179.9995});
  EXPECT_NEAR(across.x, 111.19, 0.01);
  EXPECT_NEAR(across.y, 55.60, 0.01);
}

}  // namespace
}  // namespace banyan::udp
