// SPDX-License-Identifier: MIT
// An algorithm of your own, in a World like any other: these robots drive away from all nearer than half the radio
// range.
#include <algorithm>
#include <cstdio>

#include "banyan/controller/core/algorithm_of.hpp"
#include "banyan/controller/core/output.hpp"
#include "banyan/world/world.hpp"

using namespace banyan;

struct Hello {  // what is broadcast; list all fields below, and they travel, are hashed and recorded
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
};
template <class Visitor, class Message> constexpr void visit_fields(Visitor& visit, Message& m) noexcept {
  visit.robot("id", "of the sender", m.id);
}

struct Spread {
  using Params = Machine;  // what every algorithm is told: its body in C, its speed in rounds per C
  using Message = Hello;
  struct State {
    RobotId id;
  };
  struct Heard {
    const Hello* message;
    Vec2 position;
    float age_s;
  };  // where the sender is, in C: x ahead, y to the left

  static State initial(RobotId id, bool, bool) { return {id}; }
  static Output<Hello> step(const Params&, State& self, const Inputs<Heard>& inputs) {
    Vec2 away;
    for (const Heard& h : inputs.heard())  // what is not finite or too far has been dropped
      if (const float d = norm(h.position); d < 0.5F && d > 0.0F) away -= h.position * ((0.5F - d) / d);
    // In multiples of the fastest speed, and rad per C driven at that.
    return {{self.id}, {std::clamp(2.0F * away.x, 0.0F, 0.5F), 0.0F, std::clamp(80.0F * away.y, -10.0F, 10.0F)}};
  }
  static Report report(const State&) { return {}; }  // what observers see: here neither roles nor parents
  static void add_to(Digest& digest, const State& self) { digest.add(self.id); }
};

constexpr AlgorithmOf<Spread> spread({.name = "spread",
                                      .summary = "keeps half the radio range away from other robots"});

int main() {
  world::World world(world::Scenario{}, spread);
  const auto nearest_m = [&] {
    double least = 1e9;
    for (const auto& a : world.positions())
      for (const auto& b : world.positions()) least = &a == &b ? least : std::min(least, distance(a, b));
    return least;
  };
  std::printf("%zu robots, the two nearest %.2f m apart", world.size(), nearest_m());
  while (world.time_s() < 60.0) world.step();
  std::printf(", after a minute %.2f m\n", nearest_m());
}
