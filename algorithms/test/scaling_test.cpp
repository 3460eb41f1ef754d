// SPDX-License-Identifier: MIT
// Two swarms whose lengths and speeds, or whose times, differ by a power of two are one swarm to every algorithm: the
// same bytes travel, the same is remembered, and velocities differ by that power alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan {
namespace {

// Powers of two by which metres and seconds are multiplied. Metres per second are what they become.
struct Scale {
  int length = 0, time = 0;
  [[nodiscard]] float metres(float m) const { return std::ldexp(m, length); }
  [[nodiscard]] float seconds(float s) const { return std::ldexp(s, time); }
  [[nodiscard]] float speed(float m_s) const { return std::ldexp(m_s, length - time); }
  [[nodiscard]] float turn(float rad_s) const { return std::ldexp(rad_s, -time); }
  [[nodiscard]] Vec2 place(Vec2 m) const { return {metres(m.x), metres(m.y)}; }
};

constexpr std::size_t swarm_size = 10;
constexpr int ticks = 400;

// What the robots of one tick sense, in the metres and seconds of the first swarm.
struct Script {
  std::array<std::vector<Packet>, swarm_size> packets;
  std::array<std::vector<Vec2>, swarm_size> obstacles;
  std::array<Senses, swarm_size> senses;
  std::array<bool, swarm_size> steps;
};

// A swarm of an algorithm in a world of some scale.
class Scaled {
 public:
  Scaled(const Algorithm& algorithm, Setup setup, Scale scale) : scale_(scale) {
    Platform& p = setup.platform;
    for (float* m : {&p.communication_range_m, &p.wheel_distance_m, &p.body_radius_m}) *m = scale.metres(*m);
    p.wheel_limit_m_s = scale.speed(p.wheel_limit_m_s);
    p.tick_s = scale.seconds(p.tick_s);
    setup.arrival_distance_m = std::ldexp(setup.arrival_distance_m, scale.length);
    EXPECT_EQ(algorithm.fault(setup), "");
    std::vector<Member> members;
    for (std::size_t i = 0; i < swarm_size; ++i)
      members.push_back({static_cast<RobotId>(i), i + 2 >= swarm_size, i == 0});
    swarm_ = algorithm.make(setup, members);
  }
  void tick(Script script) {
    std::array<Sensed, swarm_size> sensed;
    for (std::size_t i = 0; i < swarm_size; ++i) {
      for (Packet& packet : script.packets[i]) {
        packet.position = scale_.place(packet.position);
        packet.age_s = scale_.seconds(packet.age_s);
      }
      for (Vec2& point : script.obstacles[i]) point = scale_.place(point);
      Senses& senses = script.senses[i];
      senses.odometry.forward_m = scale_.metres(senses.odometry.forward_m);
      senses.odometry.sideways_m = scale_.metres(senses.odometry.sideways_m);
      if (senses.orders.target) senses.orders.target = scale_.place(*senses.orders.target);
      senses.elapsed_s = scale_.seconds(senses.elapsed_s);
      senses.obstacles = script.obstacles[i];
      sensed[i] = {script.packets[i], senses, script.steps[i]};
    }
    swarm_->step(0, sensed, commands_, reports_);
    swarm_->advance();
  }
  [[nodiscard]] const Velocity& command(std::size_t i) const { return commands_[i]; }
  [[nodiscard]] std::vector<std::uint8_t> said(std::size_t i) const {
    std::vector<std::uint8_t> bytes(largest_wire);
    bytes.resize(swarm_->send(i, bytes));
    return bytes;
  }
  [[nodiscard]] std::uint64_t remembered(std::size_t i) const {
    Digest digest;
    swarm_->add_to(digest, i);
    return digest.value();
  }
  [[nodiscard]] const Scale& scale() const { return scale_; }

 private:
  Scale scale_;
  std::unique_ptr<Swarm> swarm_;
  std::array<Velocity, swarm_size> commands_{};
  std::array<Report, swarm_size> reports_{};
};

// Robots that drive as they want to, among pillars, with noise in all that they sense, packets that are late or lost,
// steps that are left out, and workers whose targets change.
class Course {
 public:
  Course(const Platform& platform, std::uint64_t seed) : platform_(platform), state_(seed * 2'654'435'761U + 1) {
    for (std::size_t i = 0; i < swarm_size; ++i) {
      const std::size_t column = i % 4, row = i / 4;
      at_[i] = Vec2{0.4F * static_cast<float>(column) + draw(0.1F), 0.45F * static_cast<float>(row) + draw(0.1F)} *
               platform.communication_range_m;
      facing_[i] = unit_vector(draw(3.0F));
    }
  }
  Script sense(int tick) {
    Script script;
    for (std::size_t i = 0; i < swarm_size; ++i) {
      script.steps[i] = draw(1.0F) > -0.9F;
      ++waited_[i];
      for (std::size_t j = 0; j < swarm_size; ++j) {
        if (i == j || distance(at_[i], at_[j]) > platform_.communication_range_m || draw(1.0F) < -0.8F) continue;
        const bool measured_before = draw(1.0F) > 0.8F;
        script.packets[i].push_back({.sender = static_cast<std::uint32_t>(j),
                                     .age_ticks = draw(1.0F) > 0.5F ? 2U : 1U,
                                     .position = seen(i, at_[j]),
                                     .age_s = measured_before ? 0.3F * platform_.tick_s : 0.0F});
      }
      for (const Vec2 pillar : {Vec2{0.6F, 0.7F}, Vec2{1.6F, 0.2F}, Vec2{1.7F, 1.1F}}) {
        const Vec2 middle = pillar * platform_.communication_range_m, way = at_[i] - middle;
        const Vec2 point = middle + unit(way) * std::min(0.1F * platform_.communication_range_m, norm(way));
        if (distance(point, at_[i]) < 0.3F * platform_.communication_range_m)
          script.obstacles[i].push_back(seen(i, point));
      }
      Senses& senses = script.senses[i];
      const Vec2 way = rotate_back(facing_before_[i], driven_[i]);
      senses.odometry = {way.x * (1.0F + draw(0.02F)), way.y, turned_[i]};
      if (i + 2 >= swarm_size) {
        const Vec2 target = (i + 1 == swarm_size) != (tick > ticks / 2) ? Vec2{2.6F, 0.5F} : Vec2{-0.5F, 2.3F};
        senses.orders.sent = true;
        if (draw(1.0F) > -0.8F) senses.orders.target = seen(i, target * platform_.communication_range_m);
      }
      if (tick == 300) senses.orders.given_up = static_cast<RobotId>(swarm_size - 1);
      if (platform_.battery) senses.charge = Charge{1.0F - 0.002F * static_cast<float>(tick), false};
      if (waited_[i] > 1) senses.elapsed_s = static_cast<float>(waited_[i]) * platform_.tick_s;
      if (!script.steps[i]) continue;
      waited_[i] = 0;
      driven_[i] = {}, turned_[i] = 0.0F, facing_before_[i] = facing_[i];
    }
    return script;
  }
  void move(std::size_t i, const Velocity& v) {
    const Vec2 way = rotate(facing_[i], Vec2{v.forward_m_s, v.sideways_m_s} * platform_.tick_s);
    at_[i] += way;
    driven_[i] += way;
    turned_[i] += v.turn_rad_s * platform_.tick_s;
    facing_[i] = unit(rotate(facing_[i], unit_vector(v.turn_rad_s * platform_.tick_s)));
    total_ += norm(way);
  }
  [[nodiscard]] float driven() const { return total_; }

 private:
  float draw(float most) {  // Lehmer (1951)
    state_ = state_ * 48271U % 2147483647U;
    return most * static_cast<float>(2.0 * static_cast<double>(state_) / 2147483647.0 - 1.0);
  }
  Vec2 seen(std::size_t i, Vec2 place) {
    const float noise = 0.01F * platform_.communication_range_m;
    const float x = draw(noise);
    return rotate_back(facing_[i], place - at_[i]) + Vec2{x, draw(noise)};
  }

  Platform platform_;
  std::uint64_t state_;
  std::array<Vec2, swarm_size> at_, facing_, driven_{}, facing_before_ = filled({1.0F, 0.0F});
  std::array<float, swarm_size> turned_{};
  std::array<int, swarm_size> waited_{};
  float total_ = 0.0F;

  static std::array<Vec2, swarm_size> filled(Vec2 v) {
    std::array<Vec2, swarm_size> all;
    all.fill(v);
    return all;
  }
};

class Scaling : public testing::TestWithParam<const Algorithm*> {};
INSTANTIATE_TEST_SUITE_P(Algorithms, Scaling, testing::ValuesIn(algorithms().begin(), algorithms().end()),
                         [](const testing::TestParamInfo<const Algorithm*>& of) {
                           std::string name(of.param->name());
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(Scaling, ByAPowerOfTwoChangesNothingButTheUnits) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    banyan::Setup setup;  // of lengths and times that are no powers of two
    setup.platform.communication_range_m = 1.7F;
    setup.platform.tick_s = 0.07F;
    setup.platform.wheel_limit_m_s = 0.23F;
    setup.platform.drive = seed % 2 == 0 ? Drive::differential : Drive::holonomic;
    setup.platform.battery = seed >= 2;
    setup.history = 2;
    Scaled first(*GetParam(), setup, {});
    std::vector<Scaled> others;
    for (const Scale scale : {Scale{5, 0}, Scale{-6, 0}, Scale{0, 4}, Scale{0, -7}, Scale{-3, 5}})
      others.emplace_back(*GetParam(), setup, scale);
    Course world(setup.platform, seed);
    for (int tick = 0; tick < ticks; ++tick) {
      const Script script = world.sense(tick);
      first.tick(script);
      for (Scaled& other : others) {
        other.tick(script);
        for (std::size_t i = 0; i < swarm_size; ++i) {
          const Scale& by = other.scale();
          const Velocity &v = first.command(i), &w = other.command(i);
          ASSERT_TRUE(w.forward_m_s == by.speed(v.forward_m_s) && w.sideways_m_s == by.speed(v.sideways_m_s) &&
                      w.turn_rad_s == by.turn(v.turn_rad_s) && other.said(i) == first.said(i) &&
                      other.remembered(i) == first.remembered(i))
              << "lengths by 2^" << by.length << ", times by 2^" << by.time << ": robot " << i << ", tick " << tick
              << ", seed " << seed;
        }
      }
      for (std::size_t i = 0; i < swarm_size; ++i) world.move(i, first.command(i));
    }
    EXPECT_GT(world.driven(), setup.platform.communication_range_m) << "the test says nothing";
  }
}

}  // namespace
}  // namespace banyan
