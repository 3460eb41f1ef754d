// SPDX-License-Identifier: MIT
// One robot between what the hub says and what the controller sees, with a controller that tells what it was given.
#include "banyan/hosts/udp/robot.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace banyan::udp {
namespace {

struct Given {
  Member member;
  std::vector<Packet> packets;
  std::vector<Bytes> messages;
  Senses senses;
  std::vector<Vec2> obstacles;
  int steps = 0;
  int made = 0;
  bool line_of_sight = true;
};

// Knows messages of one byte above zero.
class Listener final : public Swarm {
 public:
  explicit Listener(Given& given) : given_(given) {}
  [[nodiscard]] std::unique_ptr<Swarm> clone() const override { return std::make_unique<Listener>(given_); }
  [[nodiscard]] std::size_t size() const noexcept override { return 1; }
  void step(std::size_t, std::span<const Sensed> sensed, std::span<Velocity> commands,
            std::span<Report> reports) override {
    given_.packets.assign(sensed[0].packets.begin(), sensed[0].packets.end());
    given_.messages = received_;
    given_.senses = sensed[0].senses;
    given_.obstacles.assign(sensed[0].senses.obstacles.begin(), sensed[0].senses.obstacles.end());
    ++given_.steps;
    commands[0] = {0.1F, 0.0F, 0.2F};
    reports[0].role = Role::connector;
  }
  void advance() noexcept override { received_.clear(); }
  std::size_t send(std::size_t, std::span<std::uint8_t> bytes) const noexcept override { return bytes[0] = 42, 1; }
  [[nodiscard]] std::size_t message_bytes() const noexcept override { return 1; }
  std::optional<std::uint32_t> receive(std::span<const std::uint8_t> bytes) override {
    if (bytes.size() != 1 || bytes[0] == 0) return std::nullopt;
    received_.emplace_back(bytes.begin(), bytes.end());
    return static_cast<std::uint32_t>(received_.size());
  }
  [[nodiscard]] Report report(std::size_t) const noexcept override { return {}; }
  void add_to(Digest&, std::size_t) const noexcept override {}
  [[nodiscard]] std::span<const FieldInfo> message_fields() const noexcept override { return {}; }
  void message_numbers(std::size_t, std::span<double>) const noexcept override {}
  void set_line_of_sight(bool on) noexcept override { given_.line_of_sight = on; }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override { return 0; }

 private:
  Given& given_;
  std::vector<Bytes> received_;
};

class Listening final : public Algorithm {
 public:
  explicit Listening(Given& given) : given_(given) {}
  [[nodiscard]] std::string_view name() const noexcept override { return "listening"; }
  [[nodiscard]] std::string_view summary() const noexcept override { return ""; }
  [[nodiscard]] std::vector<const ParameterInfo*> parameters() const override { return {}; }
  [[nodiscard]] std::vector<float> values(const Setup&) const override { return {}; }
  [[nodiscard]] std::string fault(const Setup&) const override { return ""; }
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup&, std::span<const Member> members) const override {
    given_.member = members[0];
    ++given_.made;
    return std::make_unique<Listener>(given_);
  }

 private:
  Given& given_;
};

class RobotAlone : public ::testing::Test {
 protected:
  static SensorFrame frame(std::uint32_t tick, const OdometricPose& odometry = {}) {
    SensorFrame f;
    f.mission = 1;
    f.tick = tick;
    f.odometry = odometry;
    return f;
  }
  Given given_;
  Listening algorithm_{given_};
  UdpRobot robot_{algorithm_, banyan::Setup{}, 7, 0.5};
};

TEST_F(RobotAlone, BeginsAsTheHubSays) {
  EXPECT_FALSE(robot_.is_guided(0.0));
  SensorFrame first = frame(0);
  first.root = first.worker = true;
  first.line_of_sight = false;
  robot_.take(first, 10.0);
  EXPECT_TRUE(robot_.is_guided(10.4));
  EXPECT_EQ(given_.member.id, 7);
  EXPECT_TRUE(given_.member.root && given_.member.worker);
  EXPECT_FALSE(given_.line_of_sight);
  const Status status = robot_.step(10.05);
  EXPECT_EQ(status.message, Bytes{42});
  EXPECT_EQ(status.report.role, Role::connector);
  EXPECT_FLOAT_EQ(status.velocity.turn_rad_s, 0.2F);
}

// Cut short on the way, or of an algorithm that another robot was started with by mistake.
TEST_F(RobotAlone, CountsMessagesThatAreNone) {
  robot_.take(frame(0), 10.0);
  HeardBundle heard;
  heard.tick = 1;
  heard.packets = {{1, {1.0F, 0.0F}, {5}}, {2, {1.0F, 0.0F}, {}}, {3, {1.0F, 0.0F}, {5, 6}}, {4, {1.0F, 0.0F}, {0}}};
  robot_.take(heard);
  static_cast<void>(robot_.step(10.1));
  EXPECT_EQ(given_.packets.size(), 1U);
  EXPECT_EQ(robot_.refused(), 3U);
  static_cast<void>(robot_.step(10.2));
  EXPECT_EQ(robot_.refused(), 3U) << "each once";
}

TEST_F(RobotAlone, ThatHasStartedAgainIsNotTheFirstRoot) {
  SensorFrame first = frame(500);
  first.root = first.begun = true;
  robot_.take(first, 10.0);
  EXPECT_FALSE(given_.member.root);
}

TEST_F(RobotAlone, IsNotGuidedAfterHalfASecondOfSilence) {
  robot_.take(frame(0), 10.0);
  EXPECT_TRUE(robot_.is_guided(10.5));
  EXPECT_FALSE(robot_.is_guided(10.51));
  robot_.take(frame(0), 11.0);  // an old frame does not count
  EXPECT_FALSE(robot_.is_guided(11.0));
  robot_.take(frame(1), 11.0);
  EXPECT_TRUE(robot_.is_guided(11.0));
}

TEST_F(RobotAlone, PositionsAreAsOfNowWhateverTheOrder) {
  const OdometricPose before{{1.0F, 0.0F}, 0.0F}, now{{1.0F, 1.0F}, 1.5707963F};
  robot_.take(frame(4, before), 10.0);
  // A neighbour was 2 m ahead at tick 4; since then the robot has moved 1 m to its left and turned left.
  robot_.take(HeardBundle{4, before, {{3, {2.0F, 0.0F}, {1}}}});
  robot_.take(frame(5, now), 10.1);
  const Status ignored = robot_.step(10.15);
  ASSERT_EQ(given_.packets.size(), 1U);
  EXPECT_NEAR(given_.packets[0].position.x, -1.0F, 1e-5F);
  EXPECT_NEAR(given_.packets[0].position.y, -2.0F, 1e-5F);
  EXPECT_EQ(ignored.frame_tick, 5U);
}

TEST_F(RobotAlone, OfEachSenderTheNewestPacketIsHeardOnce) {
  robot_.take(frame(4), 10.0);
  robot_.take(HeardBundle{4, {}, {{3, {1.0F, 0.0F}, {4}}, {5, {0.0F, 1.0F}, {9}}}});
  robot_.take(HeardBundle{3, {}, {{3, {2.0F, 0.0F}, {3}}}});
  static_cast<void>(robot_.step(10.0));
  EXPECT_EQ(given_.messages, (std::vector<Bytes>{{4}, {9}}));
  robot_.take(HeardBundle{4, {}, {{3, {1.0F, 0.0F}, {4}}}});  // twice
  robot_.take(HeardBundle{2, {}, {{3, {1.0F, 0.0F}, {2}}}});  // late
  robot_.take(HeardBundle{5, {}, {{5, {1.0F, 0.0F}, {0}}}});  // not the algorithm's
  static_cast<void>(robot_.step(10.1));
  EXPECT_TRUE(given_.packets.empty());
}

TEST_F(RobotAlone, OdometryAndTimeSinceTheLastStep) {
  robot_.take(frame(0), 10.0);
  static_cast<void>(robot_.step(10.0));
  EXPECT_NEAR(given_.senses.elapsed_s, 0.1F, 1e-6F);  // the first
  robot_.take(frame(1, {{0.02F, 0.01F}, 0.1F}), 10.1);
  const Status status = robot_.step(10.13);
  EXPECT_NEAR(given_.senses.elapsed_s, 0.13F, 1e-5F);
  EXPECT_NEAR(status.period_us, 130000, 10);
  EXPECT_NEAR(given_.senses.odometry.forward_m, 0.02F, 1e-6F);
  EXPECT_NEAR(given_.senses.odometry.sideways_m, 0.01F, 1e-6F);
  EXPECT_NEAR(given_.senses.odometry.turn_rad, 0.1F, 1e-6F);
}

// Its sensor frame may be lost, but each datagram of packets says where it is, too.
TEST_F(RobotAlone, OdometryComesWithPacketsAndNeverGoesBack) {
  robot_.take(frame(1), 10.0);
  static_cast<void>(robot_.step(10.0));
  robot_.take(HeardBundle{3, {{0.03F, 0.0F}, 0.0F}, {{3, {1.0F, 0.0F}, {4}}}});
  robot_.take(HeardBundle{2, {{0.01F, 0.0F}, 0.0F}, {{5, {1.0F, 0.0F}, {4}}}});  // overtaken
  robot_.take(frame(2, {{0.01F, 0.0F}, 0.0F}), 10.08);                           // likewise
  static_cast<void>(robot_.step(10.1));
  EXPECT_NEAR(given_.senses.odometry.forward_m, 0.03F, 1e-6F);
  ASSERT_EQ(given_.packets.size(), 2U);
  EXPECT_NEAR(given_.packets[0].position.x, 1.0F, 1e-6F);
  EXPECT_NEAR(given_.packets[1].position.x, 0.98F, 1e-6F);
  robot_.take(frame(4, {{0.03F, 0.0F}, 0.0F}), 10.2);
  static_cast<void>(robot_.step(10.2));
  EXPECT_NEAR(given_.senses.odometry.forward_m, 0.0F, 1e-6F);
}

TEST_F(RobotAlone, APauseOfTheHubIsNoTimeOfTheMissionButAPauseOfTheRobotIs) {
  robot_.take(frame(10), 10.0);
  static_cast<void>(robot_.step(10.0));
  robot_.take(frame(11), 40.0);
  static_cast<void>(robot_.step(40.0));
  EXPECT_NEAR(given_.senses.elapsed_s, 0.1F, 1e-6F);
  robot_.take(frame(41), 43.0);
  static_cast<void>(robot_.step(43.0));
  EXPECT_NEAR(given_.senses.elapsed_s, 3.0F, 1e-5F);
}

TEST_F(RobotAlone, TargetsStayWhereTheyAreAndNewsOfThemCountsOnce) {
  SensorFrame f = frame(1);
  f.sent = f.has_target = true;
  f.target = {3.0F, 0.0F};
  f.given_up = 5;
  f.given_up_serial = 1;
  f.obstacles = {{0.2F, 0.0F}};
  robot_.take(f, 10.0);
  static_cast<void>(robot_.step(10.0));
  EXPECT_TRUE(given_.senses.orders.sent);
  ASSERT_TRUE(given_.senses.orders.target);
  EXPECT_EQ(given_.senses.orders.given_up, 5);
  EXPECT_EQ(given_.obstacles.size(), 1U);
  f.tick = 2;
  f.has_target = false;
  robot_.take(f, 10.1);
  static_cast<void>(robot_.step(10.1));
  EXPECT_FALSE(given_.senses.orders.target);
  EXPECT_EQ(given_.senses.orders.given_up, nobody);
}

TEST_F(RobotAlone, AnotherMissionBeginsAnew) {
  robot_.take(frame(100), 10.0);
  SensorFrame next = frame(0);
  next.mission = 2;
  robot_.take(next, 11.0);
  EXPECT_EQ(given_.made, 2);
  robot_.take(frame(1), 11.1);  // of the mission before: the hub sends none any more
  EXPECT_TRUE(robot_.is_guided(11.1));
}

TEST_F(RobotAlone, ABaseOfItsOwnMeasuresItself) {
  const OdometricPose then{{10.0F, 0.0F}, 0.0F}, now{{11.0F, 0.0F}, 0.0F};
  SensorFrame f = frame(1, {{-5.0F, -5.0F}, 1.0F});
  f.sent = f.has_target = true;
  f.target = {3.0F, 0.0F};
  robot_.take(f, 10.0, then);
  robot_.take(HeardBundle{1, {}, {{3, {2.0F, 1.0F}, {1}}}}, then);
  const std::vector<Vec2> seen{{0.3F, 0.0F}};
  static_cast<void>(robot_.step(10.1, now, seen));
  EXPECT_NEAR(given_.senses.orders.target->x, 2.0F, 1e-5F);
  EXPECT_NEAR(given_.packets[0].position.x, 1.0F, 1e-5F);
  EXPECT_EQ(given_.obstacles, seen);
}

TEST_F(RobotAlone, WhatItsBaseSeesBeyondItsProximityIsNoObstacle) {
  UdpRobot robot{algorithm_, banyan::Setup{}, 7, 0.5, 0.6};
  robot.take(frame(1), 10.0, OdometricPose{});
  static_cast<void>(robot.step(10.1, OdometricPose{}, std::vector<Vec2>{{0.0F, 0.5F}, {0.5F, 0.5F}, {8.0F, 0.0F}}));
  EXPECT_EQ(given_.obstacles, (std::vector<Vec2>{{0.0F, 0.5F}}));
}

// A proximity sensor cannot tell a robot from a wall; whom the robot hears, it knows. The dead say nothing and remain.
TEST_F(RobotAlone, WhatItsBaseSeesWhereARobotWasHeardIsNoObstacle) {
  const OdometricPose here{};
  const std::vector<Vec2> seen{{0.93F, 0.0F}, {0.0F, 0.5F}};
  robot_.take(frame(1), 10.0, here);
  robot_.take(HeardBundle{1, {}, {{3, {1.0F, 0.0F}, {1}}}}, here);
  static_cast<void>(robot_.step(10.1, here, seen));
  EXPECT_EQ(given_.obstacles, (std::vector<Vec2>{{0.0F, 0.5F}}));
  robot_.take(frame(2), 10.5, here);  // a packet of it was lost
  static_cast<void>(robot_.step(10.5, OdometricPose{{0.5F, 0.0F}, 0.0F}, std::vector<Vec2>{{0.43F, 0.0F}}));
  EXPECT_TRUE(given_.obstacles.empty()) << "the robot has driven on, the other stands where it was";
  robot_.take(frame(3), 10.9, here);
  static_cast<void>(robot_.step(10.9, here, seen));
  EXPECT_EQ(given_.obstacles, seen);
}

}  // namespace
}  // namespace banyan::udp
