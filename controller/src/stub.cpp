// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/healing.hpp"

namespace banyan {
namespace {

constexpr float stub_for_s = 12.0F;
constexpr float near_enough = 0.15F;  // of C
constexpr int notice_ticks = 2;       // before the silent are forgotten

}  // namespace

void mind_stub(Robot& robot) noexcept {
  State& self = robot.self;
  const Neighborhood& table = robot.table();
  const auto hangs = [&](int k) { return table.message(k).role != Role::spare; };
  const auto fades = [&](int k) { return hangs(k) && table.age(k) > robot.liveness_ticks() - notice_ticks; };
  const auto lives = [&](int k) { return hangs(k) && !fades(k); };
  const auto any = [&](auto is) { return std::any_of(robot.children.begin(), robot.children.end(), is); };
  if (!robot.params.heals() || self.role != Role::connector || self.phase != Phase::grow_tree || any(lives)) {
    self.stub_ticks = 0;
    return;
  }
  const auto lost = std::find_if(robot.children.begin(), robot.children.end(), fades);
  if (lost != robot.children.end()) {
    self.stub = table.position(*lost);
    self.stub_ticks = static_cast<std::uint16_t>(robot.params.ticks(stub_for_s));
  } else if (self.stub_ticks > 0) {
    const bool there = norm(self.stub) < near_enough * robot.params.communication_range_m;
    self.stub_ticks = there ? std::uint16_t{0} : static_cast<std::uint16_t>(self.stub_ticks - 1);
  }
}

bool is_stub(const Robot& robot) noexcept { return robot.self.stub_ticks > 0 && robot.useful_children == 0; }

}  // namespace banyan
