// SPDX-License-Identifier: MIT
#include "batteries.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/world/random.hpp"

namespace banyan::world {

Batteries::Batteries(const Scenario& scenario, std::size_t robots)
    : model_(scenario.battery),
      holonomic_(scenario.robot.body == BodyModel::linear),
      reach_m_(charging_reach_m(scenario)),
      wheel_distance_m_(wheel_distance_m(scenario)),
      wheel_limit_m_s_(scenario.robot.wheel_limit_m_s) {
  if (!on()) return;
  places_.assign(robots, -1);
  for (std::size_t i = 0; i < robots; ++i) {
    const double less = model_.start_spread * to_uniform(bits(scenario.seed, Purpose::start_charge, i));
    levels_.push_back(std::max(0.01, model_.start_charge - less));
  }
  first_levels_ = levels_;
}

// Share of a full battery, per second. It counts what the wheels are told to do, whether or not something is in the
// way.
double Batteries::drawn_per_s(const Velocity& motion) const noexcept {
  const double forward = static_cast<double>(motion.forward_m_s);
  const double speed = std::sqrt(forward * forward +
                                 static_cast<double>(motion.sideways_m_s) * static_cast<double>(motion.sideways_m_s));
  const double turn = std::fabs(static_cast<double>(motion.turn_rad_s));
  if (model_.model == Battery::Model::power) {
    const double part = 0.5 * static_cast<double>(motion.turn_rad_s) * wheel_distance_m_;
    const auto wheel = [&](double side) {
      return std::min(std::fabs(holonomic_ ? speed : forward + side * part), wheel_limit_m_s_);
    };
    return (model_.idle_w + model_.computing_w + model_.radio_w + model_.drive_w_per_m_s * (wheel(-1.0) + wheel(1.0))) /
           model_.capacity_j;
  }
  const double standing = model_.model == Battery::Model::motion ? 0.0 : model_.charge_per_s;
  const double moving =
      model_.model == Battery::Model::time ? 0.0 : model_.charge_per_m * speed + model_.charge_per_rad * turn;
  return standing + moving;
}

// A robot keeps its slot until it is full or leaves; a free slot goes to the emptiest robot in reach, then to the
// first.
void Batteries::give_slots(std::span<const Vec2> positions, std::span<const std::uint8_t> alive) {
  const double reach2 = reach_m_ * reach_m_;
  for (std::size_t p = 0; p < model_.places.size(); ++p) {
    const auto place = static_cast<std::int32_t>(p);
    const auto in_reach = [&](std::size_t i) {
      return alive[i] != 0 && levels_[i] < 1.0 && squared_norm(positions[i] - model_.places[p]) <= reach2;
    };
    std::size_t free = model_.slots;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      if (places_[i] != place) continue;
      if (in_reach(i)) --free;
      else places_[i] = -1;
    }
    for (; free > 0; --free) {
      std::size_t next = levels_.size();
      for (std::size_t i = 0; i < levels_.size(); ++i)
        if (places_[i] < 0 && in_reach(i) && (next == levels_.size() || levels_[i] < levels_[next])) next = i;
      if (next == levels_.size()) break;
      places_[next] = place;
    }
  }
}

std::size_t Batteries::pass(double seconds, std::span<const Velocity> moving, std::span<const Vec2> positions,
                            std::span<const std::uint8_t> alive) {
  if (!on()) return 0;
  give_slots(positions, alive);
  std::size_t empty = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (alive[i] == 0) continue;
    const double gained = places_[i] >= 0 ? model_.charge_w / model_.capacity_j : 0.0;
    levels_[i] = std::clamp(levels_[i] + (gained - drawn_per_s(moving[i])) * seconds, 0.0, 1.0);
    empty += levels_[i] == 0.0 ? 1 : 0;
  }
  return empty;
}

void Batteries::add_to(Digest& digest) const noexcept {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    digest.add(levels_[i]);
    digest.add(places_[i]);
  }
}

}  // namespace banyan::world
