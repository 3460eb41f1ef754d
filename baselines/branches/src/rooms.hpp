// SPDX-License-Identifier: MIT
// The parts of a step of branch repositioning, in their order.
#pragma once

#include <algorithm>

#include "banyan/baselines/branches/branches.hpp"

namespace banyan::baselines::branches {

// A robot within its step.
struct Robot {
  const Params& params;
  State& self;
  int elapsed_ticks;

  [[nodiscard]] const Table<Message>& table() const noexcept { return self.neighbors; }
  // Null for `nobody` and for robots not heard.
  [[nodiscard]] const Message* said_by(RobotId id) const noexcept {
    const int k = table().find(id);
    return k < 0 ? nullptr : &table().message(k);
  }
  [[nodiscard]] float between(int a, int b) const noexcept {
    return distance(table().position(a), table().position(b));
  }
  // How far apart two robots may be that are to be linked: no farther than the guard will hold them.
  [[nodiscard]] float reach() const noexcept { return params.longest_link - table().spread(); }
  [[nodiscard]] std::uint16_t counted(std::uint16_t ticks) const noexcept {
    return static_cast<std::uint16_t>(std::min(ticks + elapsed_ticks, 65535));
  }
};

[[nodiscard]] inline bool lists(const Ids& ids, RobotId id) noexcept {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}
[[nodiscard]] inline bool has_room(const Message& m) noexcept { return lists(m.links, nobody); }
[[nodiscard]] inline bool is_follower(const Message& m) noexcept { return !m.leader && !m.connector; }
// News from neighbour k, now; unknown_age if they are too old.
[[nodiscard]] inline std::uint8_t news_age(std::uint8_t said, const Table<Message>& table, int k) noexcept {
  const int age = age_now(said, table, k);
  return age > news_ticks ? unknown_age : static_cast<std::uint8_t>(age);
}

// links.cpp: which links are still there, and which of them leads to the root?
void watch_links(Robot& robot, const Carry& carry) noexcept;
// changes.cpp: take part in the changes of others; decide on one of my own, and see it through.
void take_part(Robot& robot) noexcept;
void change_links(Robot& robot) noexcept;
// joining.cpp: be joined to the root by links, or stop being a connector.
void join(Robot& robot) noexcept;
// teams.cpp: whom does a follower follow, and which team needs more?
void follow_team(Robot& robot) noexcept;
// spacing.cpp
[[nodiscard]] Vec2 spacing_motion(const Robot& robot) noexcept;
void guard_links(const Robot& robot, Guard& guard) noexcept;

}  // namespace banyan::baselines::branches
