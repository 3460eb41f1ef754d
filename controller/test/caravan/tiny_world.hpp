// SPDX-License-Identifier: MIT
// A world of a few robots of caravan without bodies: exact places, and a radio that a test makes as bad as it likes.
// What happens is read from messages and reports, as anybody could; no state is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include <rapidcheck.h>

#include "caravan/rules.hpp"
#include "test_platform.hpp"

namespace banyan::caravan {

inline constexpr float longest_edge = 0.95F;  // C, as by default

inline constexpr Platform on_wheels_to_all_sides = [] {
  Platform p = test_platform;
  p.drive = banyan::Drive::holonomic;
  return p;
}();

class Dice {  // splitmix64
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  float share() {  // [0, 1)
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return static_cast<float>((z ^ (z >> 31U)) >> 40U) * 0x1p-24F;
  }
  float between(float low, float high) { return low + (high - low) * share(); }
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(share() * static_cast<float>(limit)); }
  bool comes_up(float chance) { return share() < chance; }
  Vec2 on_disc(float radius) {
    for (;;)
      if (const Vec2 v{between(-radius, radius), between(-radius, radius)}; norm(v) <= radius) return v;
  }

 private:
  std::uint64_t state_;
};

// Any at all from the first case of a property on.
inline std::uint64_t any_seed() {
  return *rc::gen::noShrink(rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()));
}

// One place for all that a test asks of a robot: robot i has id i, and 0 is the first root, unless there is none.
class TinyWorld {
 public:
  explicit TinyWorld(std::vector<Vec2> start, const std::vector<std::size_t>& sent = {}, bool has_root = true)
      : params(machine_for_all_sides()), places(std::move(start)), said_(places.size()) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool worker = std::find(sent.begin(), sent.end(), i) != sent.end();
      states_.push_back(initial(static_cast<RobotId>(i), worker, has_root && i == 0));
      said_[i].id = static_cast<RobotId>(i);
    }
    const std::size_t n = size();
    robots_.resize(n);
    deaf_.assign(n * n, false);
  }

  // ---- What a test does to it ----

  void send(std::size_t i, Vec2 target) { robots_[i].target = target; }
  void call_back(std::size_t i) { robots_[i].target.reset(); }
  void give_up(RobotId name) {  // all are told, once
    for (Robot& r : robots_) r.given_up = name;
  }
  void see_obstacles(std::size_t i, std::vector<Vec2> points) { robots_[i].obstacles = std::move(points); }
  void kill(std::size_t i) { robots_[i].lives = false; }
  void hold(std::size_t i, bool holds = true) { robots_[i].held = holds; }  // whatever its motors are told
  void hold_all() {
    for (Robot& r : robots_) r.held = true;
  }
  void deafen(std::size_t listener, std::size_t speaker, bool is = true) { deaf_[listener * size() + speaker] = is; }
  void part(std::size_t i, std::size_t j, bool are = true) { deafen(i, j, are), deafen(j, i, are); }
  void jam(std::size_t i, bool is = true) {
    for (std::size_t j = 0; j < size(); ++j) part(i, j, is);
  }
  // One round. Of those that are late nothing is heard, and later they step once for all of that time.
  void step(const std::vector<bool>& late = {}) {
    std::vector<Message> next = said_;
    std::vector<Vec2> moved = places;
    for (std::size_t i = 0; i < size(); ++i) {
      Robot& robot = robots_[i];
      if (!robot.lives) continue;
      ++robot.since_step;
      if (!late.empty() && late[i]) continue;
      std::vector<Heard> heard;
      for (std::size_t j = 0; j < size(); ++j)
        if (hears(i, j) && (late.empty() || !late[j]) && !(loss > 0.0F && dice.comes_up(loss)))
          heard.push_back({&packet(j), rotate_back(heading(i), places[j] - places[i])});
      const Vec2 v = step_of(i, heard, next[i]);
      if (!robot.held) moved[i] = places[i] + v * params.way_in_a_round();
    }
    for (std::size_t i = 0; i < size(); ++i) robots_[i].moved += moved[i] - places[i];
    places = moved;
    before_.push_front(std::exchange(said_, next));
    if (before_.size() > oldest) before_.pop_back();
  }
  void steps(int count) {
    for (int k = 0; k < count; ++k) step();
  }
  // Until it is so; after how many rounds, or `limit`.
  template <class Is> int until(int limit, Is is) {
    int k = 0;
    for (; k < limit && !is(); ++k) step();
    return k;
  }

  // ---- What a test asks ----

  [[nodiscard]] std::size_t size() const { return places.size(); }
  [[nodiscard]] bool lives(std::size_t i) const { return robots_[i].lives; }
  [[nodiscard]] const Message& said(std::size_t i) const { return said_[i]; }
  [[nodiscard]] Report reported(std::size_t i) const { return report(states_[i]); }
  [[nodiscard]] Role role(std::size_t i) const { return said_[i].role; }
  [[nodiscard]] float between(std::size_t i, std::size_t j) const { return distance(places[i], places[j]); }
  [[nodiscard]] float to(std::size_t i, Vec2 place) const { return distance(places[i], place); }
  [[nodiscard]] bool hears(std::size_t i, std::size_t j) const {
    return i != j && lives(i) && lives(j) && !deaf_[i * size() + j] && (!by_distance || between(i, j) < 1.0F);
  }
  // Living robots that hold that target.
  [[nodiscard]] std::vector<std::size_t> holders(RobotId name) const {
    return those([&](std::size_t i) { return lives(i) && reported(i).serves == name; });
  }
  [[nodiscard]] std::vector<std::size_t> of_role(Role role) const {
    return those([&](std::size_t i) { return lives(i) && said_[i].role == role; });
  }
  // From robot i along parents; without an end if they close.
  [[nodiscard]] std::vector<std::size_t> way_up(std::size_t i) const {
    std::vector<std::size_t> way{i};
    while (way.size() <= size() && said_[way.back()].parent != nobody) way.push_back(said_[way.back()].parent);
    return way;
  }
  [[nodiscard]] bool leads_to(std::size_t i, std::size_t root) const { return way_up(i).back() == root; }
  [[nodiscard]] bool has_cycle() const {
    for (std::size_t i = 0; i < size(); ++i)
      if (way_up(i).size() > size()) return true;
    return false;
  }
  [[nodiscard]] float longest_on(const std::vector<std::size_t>& way) const {
    float longest = 0.0F;
    for (std::size_t k = 1; k < way.size(); ++k) longest = std::max(longest, between(way[k - 1], way[k]));
    return longest;
  }
  // The living are joined by links up to 1 C.
  [[nodiscard]] bool is_one_piece() const {
    std::vector<std::size_t> reached;
    for (std::size_t i = 0; i < size() && reached.empty(); ++i)
      if (lives(i)) reached.push_back(i);
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (std::size_t j = 0; j < size(); ++j)
        if (lives(j) && between(reached[k], j) < 1.0F && std::find(reached.begin(), reached.end(), j) == reached.end())
          reached.push_back(j);
    return reached.size() == those([&](std::size_t i) { return lives(i); }).size();
  }

  Params params;
  std::vector<Vec2> places;  // C; a test may move robots
  float loss = 0.0F;         // of packets, by chance
  std::size_t oldest = 0;    // packets come up to so many rounds late, in any order
  bool by_distance = true;   // else all hear each other that are not made deaf
  Dice dice{1};

 private:
  struct Robot {
    bool lives = true;
    bool held = false;
    std::optional<Vec2> target;
    RobotId given_up = nobody;
    std::vector<Vec2> obstacles;
    int since_step = 0;
    Vec2 moved;  // since it stepped
  };

  static Params machine_for_all_sides() {
    Params p;
    static_cast<Machine&>(p) = machine_of(on_wheels_to_all_sides);
    return p;
  }
  // Each robot looks elsewhere: nothing may depend on a frame that they have in common.
  static Vec2 heading(std::size_t i) { return unit_vector(0.9F * static_cast<float>(i)); }
  template <class Is> [[nodiscard]] std::vector<std::size_t> those(Is is) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < size(); ++i)
      if (is(i)) found.push_back(i);
    return found;
  }
  // What robot j said a round ago, or before.
  const Message& packet(std::size_t j) {
    const std::size_t age = before_.empty() ? 0 : dice.below(before_.size() + 1);
    return age == 0 ? said_[j] : before_[age - 1][j];
  }
  // Its message, and where it wants to go.
  Vec2 step_of(std::size_t i, std::vector<Heard>& heard, Message& message) {
    Robot& robot = robots_[i];
    const Vec2 moved = rotate_back(heading(i), robot.moved);
    Senses senses;
    senses.odometry = {moved.x, moved.y, 0.0F};
    senses.orders.sent = robot.target.has_value();
    if (robot.target) senses.orders.target = rotate_back(heading(i), *robot.target - places[i]);
    senses.orders.given_up = std::exchange(robot.given_up, nobody);
    senses.obstacles = robot.obstacles;
    senses.elapsed_s = static_cast<float>(robot.since_step) * on_wheels_to_all_sides.tick_s;
    const auto output = caravan::step(params, states_[i], {heard, senses, on_wheels_to_all_sides});
    robot.since_step = 0;
    robot.moved = {};
    message = output.message;
    return rotate(heading(i), {output.motion.forward, output.motion.sideways});
  }

  std::vector<State> states_;
  std::vector<Message> said_;
  std::deque<std::vector<Message>> before_;  // the newest first
  std::vector<Robot> robots_;
  std::vector<bool> deaf_;  // listener by listener
};

}  // namespace banyan::caravan
