// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "banyan/controller/core/wire.hpp"

namespace banyan::udp {
namespace {

SensorFrame some_frame() {
  SensorFrame frame;
  frame.mission = 77;
  frame.tick = 1234;
  frame.root = frame.begun = frame.has_target = true;
  frame.line_of_sight = false;
  frame.odometry = {{1.5F, -2.25F}, 3.0F};
  frame.target = {-7.0F, 0.125F};
  frame.given_up = 5;
  frame.given_up_serial = 255;
  frame.obstacles = {{1.0F, 2.0F}, {-0.5F, 0.25F}};
  return frame;
}

HeardBundle some_heard() {
  return {99, {{0.5F, 1.0F}, -1.0F}, {{3, {1.0F, 2.0F}, {9, 8, 7}}, {8, {-1.0F, 0.0F}, Bytes(96, 5)}}};
}

Status some_status() {
  Status status;
  status.frame_tick = 4;
  status.period_us = 100'123;
  status.dropped = 7;
  status.given_up_serial = 2;
  status.velocity = {0.1F, -0.2F, 1.5F};
  Report& r = status.report;
  r.role = Role::worker;
  r.phase = Phase::grow_tree;
  r.need = Need::await;
  r.spare_state = SpareState::extend_edge;
  r.parent = 1, r.old_parent = 2, r.serves = 3, r.root = 4, r.grant = 5, r.request = 6;
  for (std::size_t k = 0; k < r.kept.size(); ++k) r.kept[k] = static_cast<RobotId>(10 + k);
  r.root_sequence = 11, r.epoch = 12, r.depth = 13;
  r.label = 1.75F;
  r.want = 1.25F;
  r.out_of_scale = true;
  r.tally = {21, 22, 23, 24, 25, 26};
  status.message = {1, 2, 3, 4};
  return status;
}

template <class Decode> void expect_no_cut(const Bytes& bytes, Decode decode) {
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(decode(ByteView(bytes).first(size))) << size;
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_FALSE(decode(ByteView(longer)));
}

TEST(Messages, ComeBackAsTheyWere) {
  EXPECT_EQ(decode_frame(encode(some_frame())), some_frame());
  EXPECT_EQ(decode_frame(encode(SensorFrame{})), SensorFrame{});
  EXPECT_EQ(decode_heard(encode(some_heard())), some_heard());
  const auto status = decode_status(encode(some_status()));
  ASSERT_TRUE(status);
  EXPECT_EQ(encode(*status), encode(some_status()));
  EXPECT_EQ(status->report.role, Role::worker);
  EXPECT_EQ(status->report.kept[11], 21);
  EXPECT_EQ(status->report.label, 1.75F);
  EXPECT_TRUE(status->report.out_of_scale);
  EXPECT_EQ(status->report.tally.rejected, 26U);
  EXPECT_FLOAT_EQ(status->velocity.turn_rad_s, 1.5F);
  EXPECT_EQ(status->message, (Bytes{1, 2, 3, 4}));
}

TEST(Messages, EveryFieldOfAReportTravels) {
  const Bytes first = encode(some_status());
  Status other = some_status();
  other.report = {};
  std::size_t different = 0;
  const Bytes second = encode(other);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) different += first[k] != second[k] ? 1 : 0;
  EXPECT_GT(different, 40U);
}

TEST(Messages, NeitherCutNorLonger) {
  expect_no_cut(encode(some_frame()), decode_frame);
  expect_no_cut(encode(some_heard()), decode_heard);
  expect_no_cut(encode(some_status()), decode_status);
}

TEST(Messages, ImpossibleValuesAreRefused) {
  SensorFrame frame = some_frame();
  frame.odometry.turn_rad = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(decode_frame(encode(frame)));
  frame = some_frame();
  frame.obstacles.resize(most_seen + 1);
  EXPECT_FALSE(decode_frame(encode(frame)));
  HeardBundle heard = some_heard();
  heard.odometry.position.x = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(decode_heard(encode(heard)));
  heard = some_heard();
  heard.packets[0].message.resize(largest_wire + 1);
  EXPECT_FALSE(decode_heard(encode(heard)));
  Status status = some_status();
  status.velocity.forward_m_s = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(decode_status(encode(status)));
  status = some_status();
  status.report.role = static_cast<Role>(4);
  EXPECT_FALSE(decode_status(encode(status)));
}

TEST(Messages, AnyBytesAreSurvived) {
  std::mt19937 random(2);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes(random() % 200);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (const auto frame = decode_frame(bytes)) { EXPECT_EQ(encode(*frame).size(), bytes.size()); }
    if (const auto heard = decode_heard(bytes)) { EXPECT_EQ(encode(*heard).size(), bytes.size()); }
    if (const auto status = decode_status(bytes)) { EXPECT_EQ(encode(*status).size(), bytes.size()); }
  }
}

TEST(OdometricPose, MotionBetweenTwoIsWhatWasMoved) {
  std::mt19937 random(3);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  const auto draw = [&](float limit) { return limit * (static_cast<float>(random() % 2001) / 1000.0F - 1.0F); };
  OdometricPose pose;
  for (int k = 0; k < 1000; ++k) {
    const Odometry motion{draw(0.02F), draw(0.02F), draw(0.5F)};
    const OdometricPose next = moved(pose, motion);
    const Odometry again = motion_between(pose, next);
    EXPECT_NEAR(again.forward_m, motion.forward_m, 1e-5F);
    EXPECT_NEAR(again.sideways_m, motion.sideways_m, 1e-5F);
    EXPECT_NEAR(again.turn_rad, motion.turn_rad, 1e-5F);
    EXPECT_LE(std::fabs(next.turn_rad), 3.1416F);
    const Vec2 point{draw(5.0F), draw(5.0F)};
    EXPECT_NEAR(distance(pose.inside(pose.outside(point)), point), 0.0F, 1e-5F);
    pose = next;
  }
}

TEST(Messages, AnAccountComesBackAsItWas) {
  for (const bool has_target : {true, false}) {
    Account account{some_status(), {{1.5F, -2.0F}, 3.0F}, std::nullopt, {{4, {0.5F, 1.0F}}, {65000, {-1.0F, 0.0F}}}};
    if (has_target) account.target = {7.0F, -8.0F};
    const Bytes bytes = encode(account);
    const auto again = decode_account(bytes);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->odometry, account.odometry);
    EXPECT_EQ(again->target, account.target);
    EXPECT_EQ(again->seen, account.seen);
    EXPECT_EQ(encode(again->status), encode(account.status));
    expect_no_cut(bytes, decode_account);
  }
  Account account{some_status(), {}, std::nullopt, std::vector<Sighting>(100)};
  EXPECT_EQ(decode_account(encode(account))->seen.size(), most_sightings);
  account.odometry.turn_rad = 30.0F;  // whole turns are left out
  EXPECT_NEAR(decode_account(encode(account))->odometry.turn_rad, std::remainder(30.0, 2.0 * M_PI), 1e-4);
  account.seen = {{1, {std::numeric_limits<float>::quiet_NaN(), 0.0F}}};
  EXPECT_FALSE(decode_account(encode(account)));
}

}  // namespace
}  // namespace banyan::udp
