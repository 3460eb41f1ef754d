// SPDX-License-Identifier: MIT
// A tree-forming algorithm of your own: derive from Policy, hand it to a World. This one is
// inwards with two changes: short edges where there is a choice, and outwards' pull to the targets.
#include <cstdio>

#include "banyan/controller/policies.hpp"
#include "banyan/measure/observer.hpp"

using namespace banyan;

class ShortEdges final : public Policy {
 public:
  std::string_view name() const noexcept override { return "short-edges"; }
  std::string_view summary() const noexcept override { return "inwards, by short edges and with a stronger pull"; }
  Params defaults(Reading reading) const noexcept override {
    Params params = inwards().defaults(reading);
    params.target_gain = 0.49F;
    return params;
  }
  bool may_join(const Robot& robot) const noexcept override { return inwards().may_join(robot); }
  bool accepts(const Robot& robot, int k) const noexcept override { return robot.table().range(k) < 0.7F; }
  bool prefers(const Robot& robot, int a, int b) const noexcept override { return inwards().prefers(robot, a, b); }
  bool tree_complete(const Robot& robot) const noexcept override { return inwards().tree_complete(robot); }
  bool leaves_branch(const Robot& robot) const noexcept override { return inwards().leaves_branch(robot); }
};

int main() {
  world::Scenario scenario;
  scenario.targets = world::RingTargets{.count = 3, .radius_m = 6.0};
  const ShortEdges mine;
  for (const Policy* policy : {&inwards(), static_cast<const Policy*>(&mine)}) {
    world::World world(scenario, *policy);
    measure::Observer observer(world);
    for (; !observer.finished(); observer.observe(world)) world.step();
    const measure::Run run = observer.result(world);
    std::printf("%-12s %5.1f s, %u of %u robots committed\n", policy->name().data(), run.time_s, run.committed,
                run.robots);
    if (!run.complete) return 1;
  }
}
