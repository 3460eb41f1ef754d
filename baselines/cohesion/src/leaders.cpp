// SPDX-License-Identifier: MIT
// Leaders drag: who is near one moves as it does, who is farther away moves towards it as fast. A leader with few
// neighbours calls for help.
#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::cohesion {
namespace {

constexpr int farthest = 64;         // hops; a leader farther away is none
constexpr int enough = 3;            // neighbours of a leader
constexpr unsigned echo_of_ten = 8;  // help passed on, in tenths

// How much of a leader's own direction counts, so many hops from it; the rest is the way there.
float share_of_direction(int hops) noexcept {
  constexpr float shares[] = {1.0F, 0.996F, 0.975F, 0.840F, 0.160F};
  return hops < 5 ? shares[hops] : 0.0F;
}

void note(Leaders& found, const SaidLeader& leader, int towards) noexcept {
  const auto end = found.said.begin() + found.size;
  auto at = std::find_if(found.said.begin(), end, [&](const SaidLeader& l) { return l.id == leader.id; });
  if (at != end && at->hops <= leader.hops) return;
  if (at == end) {
    if (found.size == static_cast<int>(most_leaders)) {
      --at;
      if (at->hops <= leader.hops) return;
    } else {
      ++found.size;
    }
  }
  auto i = static_cast<std::size_t>(at - found.said.begin());
  for (; i > 0 && found.said[i - 1].hops > leader.hops; --i) {
    found.said[i] = found.said[i - 1];
    found.towards[i] = found.towards[i - 1];
  }
  found.said[i] = leader;
  found.towards[i] = towards;
}

}  // namespace

Leaders find_leaders(const Robot& robot, Vec2 velocity) noexcept {
  Leaders found;
  if (robot.self.assignment.sent) note(found, {robot.self.id, 0, to_wire(velocity)}, -1);
  for (int k = 0; k < robot.around.size; ++k) {
    const Vec2 frame = robot.around.frame(k);
    if (frame == Vec2{}) continue;
    for (const SaidLeader& said : robot.message(k).leaders) {
      if (said.id == nobody || said.id == robot.self.id || said.hops + 1 >= farthest) continue;
      note(found, {said.id, static_cast<std::uint8_t>(said.hops + 1), to_wire(rotate(frame, said.velocity.in_frame()))},
           k);
    }
  }
  return found;
}

// (5)
Vec2 leaders_pull(const Robot& robot, const Leaders& leaders) noexcept {
  Vec2 sum;
  float weights = 0.0F;
  for (int i = 0; i < leaders.size; ++i) {
    const SaidLeader& leader = leaders.said[static_cast<std::size_t>(i)];
    const int towards = leaders.towards[static_cast<std::size_t>(i)];
    if (towards < 0) continue;
    const Vec2 velocity = leader.velocity.in_frame();
    const float share = share_of_direction(leader.hops);
    const Vec2 way = unit(robot.around.place(towards)) * norm(velocity);
    const float weight = 1.0F / static_cast<float>(leader.hops * leader.hops);
    sum += (velocity * share + way * (1.0F - share)) * weight;
    weights += weight;
  }
  return weights > 0.0F ? sum * (robot.params.leader_gain / weights) : Vec2{};
}

Guard wait_for_nearest(const Robot& robot) noexcept {
  Guard guard;
  const Neighbors& table = robot.table();
  int nearest = -1;
  for (int k = 0; k < table.size(); ++k)
    if (nearest < 0 || table.range(k) < table.range(nearest)) nearest = k;
  if (nearest >= 0) guard.add(table.position(nearest), robot.params.longest_link, robot.params.guard_rate);
  return guard;
}

// (6)
Help find_help(const Robot& robot) noexcept {
  Help found;
  if (robot.self.assignment.sent) {
    found.said = to_fixed<std::uint8_t>(static_cast<float>(std::max(0, enough - robot.around.size)), per_help);
    return found;
  }
  std::uint8_t most = 0;
  for (int k = 0; k < robot.around.size; ++k) most = std::max(most, robot.message(k).help);
  for (int k = 0; k < robot.around.size && most > 0; ++k)
    if (robot.message(k).help == most) found.pull += robot.around.place(k);
  found.pull *= robot.params.help_gain * static_cast<float>(most) / per_help;
  found.said = static_cast<std::uint8_t>(most * echo_of_ten / 10U);
  return found;
}

}  // namespace banyan::baselines::cohesion
