// SPDX-License-Identifier: MIT
// Who may go where, by the distance d to the parent: forward while d < SAFE, back where d >= CRITICAL.
#include "rooms.hpp"

namespace banyan::baselines::chains {
namespace {

constexpr float nearly = 0.1F;  // a relay so near its place slows down

// What the distances to the parents allow; `back`: where to go if they are too large.
struct Leave {
  bool onwards = true;
  Vec2 back;
};

// Without a parent: towards the first of those that were above it, or the base.
Vec2 way_back(const Robot& robot, const Chain& chain) noexcept {
  for (const RobotId id : chain.above)
    if (const int k = robot.find_fresh(id); k >= 0) return unit(robot.table().position(k));
  return robot.self.base.known ? unit(robot.self.base.at) : Vec2{};
}

// The worker waits for the rest of a broken chain, but not for ever: a new one has to begin near the base.
bool waits(const Robot& robot, std::size_t lost) noexcept {
  return lost < robot.chains().size() && robot.self.gap_ticks <= robot.params.rounds(robot.params.gap_patience_drives);
}

// (1)
Leave leave_of(const Robot& robot) noexcept {
  Leave leave;
  float farthest = 0.0F;
  std::size_t lost = 0;
  for (const Chain& chain : robot.chains()) {
    const int k = robot.table().find(chain.parent);
    if (k < 0) {
      leave.onwards = false;
      if (!waits(robot, ++lost)) leave.back = way_back(robot, chain);
      continue;
    }
    const float d = robot.table().range(k);
    if (!(d < robot.params.safe_distance) || robot.table().age(k) > fresh_ticks) leave.onwards = false;
    if (d < robot.params.critical_distance || d < farthest) continue;
    farthest = d;
    leave.back = unit(robot.table().position(k));
  }
  return leave;
}

// Chains that end at the same worker come to it side by side.
Vec2 beside_worker(const Robot& robot) noexcept {
  const int step = (robot.self.number + 1) / 2;
  const float side = robot.self.number % 2 == 1 ? 1.0F : -1.0F;
  return left_of(unit(robot.self.child_place.at)) * (side * static_cast<float>(step) * robot.params.side_offset);
}

// (2)
Vec2 relay_pull(const Robot& robot) noexcept {
  const State& self = robot.self;
  const float missing = robot.missing();
  if (missing < slack) return {};
  Vec2 aim = self.gap.known ? self.gap.at : self.child_place.at;
  if (self.child == self.worker) aim += beside_worker(robot);
  return unit(aim) * std::min(1.0F, missing / nearly);
}

// There is room for a free robot to come nearer.
bool is_open(const Robot& robot, int towards) noexcept {
  const Table<Message>& table = robot.table();
  for (int k = 0; k < table.size(); ++k)
    if (k != towards && table.range(k) < robot.params.free_spacing &&
        dot(table.position(k), table.position(towards)) > 0.0F)
      return false;
  return true;
}

// A free robot follows the neighbour that is nearest to the base, if that is far away or there is room near it.
Vec2 free_motion(const Robot& robot) noexcept {
  const Table<Message>& table = robot.table();
  int next = -1;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    if (m.worker != nobody || m.root != robot.self.root || m.root == nobody) continue;
    const auto is_nearer = [&](int a, int b) {
      const int age_a = age_now(table.message(a).root_age, table, a);
      const int age_b = age_now(table.message(b).root_age, table, b);
      return age_a < age_b || (age_a == age_b && table.range(a) < table.range(b));
    };
    if (next < 0 || is_nearer(k, next)) next = k;
  }
  if (next < 0) return {};
  const float safe = robot.params.safe_distance;
  const bool comes = table.range(next) > safe || (table.range(next) > 0.5F * safe && is_open(robot, next));
  return comes ? unit(table.position(next)) : Vec2{};
}

}  // namespace

Vec2 spacing_motion(const Robot& robot) noexcept {
  const State& self = robot.self;
  if (self.is_free()) return free_motion(robot);
  const Leave leave = leave_of(robot);
  if (leave.back != Vec2{}) return leave.back;
  if (!leave.onwards) return {};
  return self.is_worker() ? target_pull(self.assignment, robot.params) : relay_pull(robot);
}

void guard_chain(const Robot& robot, Guard& guard) noexcept {
  const auto add = [&](RobotId end) {
    if (const int k = robot.table().find(end); k >= 0)
      guard.add(robot.table().position(k), robot.params.longest_link - robot.table().spread(), robot.params.guard_rate);
  };
  if (robot.self.is_free()) return;
  for (const Chain& chain : robot.chains()) add(chain.parent);
  add(robot.self.child);
}

}  // namespace banyan::baselines::chains
