// SPDX-License-Identifier: MIT
// A swarm whose robots know lengths as shares of the range and speeds as shares of what their wheels can do, and
// nothing else: worlds that differ in scale alone look the same to it. It drives about, and remembers all that it has
// sensed.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"

namespace banyan::world {

class ToySwarm final : public Swarm {
 public:
  ToySwarm(const Platform& platform, std::span<const Member> members) : platform_{platform} {
    for (const Member& member : members) {
      Report report;
      report.role = member.root ? Role::root : member.worker ? Role::worker : Role::connector;
      if (member.worker) report.serves = member.id;
      robots_.push_back({report, Digest()});
    }
  }
  [[nodiscard]] std::unique_ptr<Swarm> clone() const override { return std::make_unique<ToySwarm>(*this); }
  [[nodiscard]] std::size_t size() const noexcept override { return robots_.size(); }

  void step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
            std::span<Report> reports) override {
    for (std::size_t k = 0; k < sensed.size(); ++k) {
      if (!sensed[k].steps) continue;
      commands[k] = decide_one(robots_[first + k], sensed[k]);
      reports[k] = robots_[first + k].report;
    }
  }
  void advance() noexcept override {}

  std::size_t send(std::size_t /*i*/, std::span<std::uint8_t> /*bytes*/) const noexcept override { return 0; }
  [[nodiscard]] std::size_t message_bytes() const noexcept override { return 0; }
  std::optional<std::uint32_t> receive(std::span<const std::uint8_t> /*bytes*/) override { return std::nullopt; }
  [[nodiscard]] Report report(std::size_t i) const noexcept override { return robots_[i].report; }
  // All that robot i has sensed so far, free of scale.
  void add_to(Digest& digest, std::size_t i) const noexcept override { digest.add(robots_[i].sensed.value()); }
  [[nodiscard]] std::span<const FieldInfo> message_fields() const noexcept override { return {}; }
  void message_numbers(std::size_t /*i*/, std::span<double> /*numbers*/) const noexcept override {}
  void set_line_of_sight(bool /*on*/) noexcept override {}
  [[nodiscard]] std::size_t memory_bytes() const noexcept override { return robots_.size() * sizeof(Robot); }

 private:
  struct Robot {
    Report report;
    Digest sensed;
  };

  // Towards its target or away from the nearest others, and away from what it sees nearby; else round and round.
  Velocity decide_one(Robot& robot, const Sensed& sensed) const {
    const float range_m = platform_.communication_range_m;
    const auto note = [&](banyan::Vec2 v) {
      robot.sensed.add(v.x);
      robot.sensed.add(v.y);
      return v;
    };
    const Senses& senses = sensed.senses;
    note(banyan::Vec2{senses.odometry.forward_m, senses.odometry.sideways_m} / range_m);
    robot.sensed.add(senses.odometry.turn_rad);
    banyan::Vec2 wish{0.1F, 0.05F};
    for (const Packet& packet : sensed.packets) {
      robot.sensed.add(packet.sender);
      robot.sensed.add(packet.age_ticks);
      if (const banyan::Vec2 way = note(packet.position / range_m); norm(way) < 0.4F) wish -= way;
    }
    if (senses.orders.target) wish = note(*senses.orders.target / range_m);
    for (const banyan::Vec2 point : senses.obstacles) wish -= 2.0F * note(point / range_m);
    if (senses.charge) robot.sensed.add(senses.charge->level);
    wish = clamped(wish, 1.0F);
    const float fastest = platform_.wheel_limit_m_s;
    if (platform_.drive == Drive::holonomic)
      return {fastest * wish.x, fastest * wish.y, 0.01F * wish.y / platform_.tick_s};
    return {fastest * wish.x, 0.0F, fastest / platform_.wheel_distance_m * wish.y};
  }

  Platform platform_;
  std::vector<Robot> robots_;
};

class ToyAlgorithm final : public Algorithm {
 public:
  constexpr ToyAlgorithm() = default;
  [[nodiscard]] std::string_view name() const noexcept override { return "toy"; }
  [[nodiscard]] std::string_view summary() const noexcept override { return "drives about"; }
  [[nodiscard]] std::vector<const ParameterInfo*> parameters() const override { return {}; }
  [[nodiscard]] std::vector<float> values(const Setup& /*setup*/) const override { return {}; }
  [[nodiscard]] std::string fault(const Setup& /*setup*/) const override { return {}; }
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    return std::make_unique<ToySwarm>(setup.platform, members);
  }
};

}  // namespace banyan::world
