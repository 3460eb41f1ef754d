// SPDX-License-Identifier: MIT
// All that a robot of branch repositioning remembers between two steps.
#pragma once

#include "banyan/baselines/branches/params.hpp"
#include "banyan/baselines/common/motion.hpp"
#include "banyan/baselines/common/root.hpp"
#include "banyan/baselines/common/table.hpp"

namespace banyan::baselines::branches {

struct Link {
  RobotId to = nobody;
  std::uint16_t unanswered_ticks = 0;  // for how long the other end has not named me
  std::uint16_t loop_ticks = 0;        // for how long it has led neither end to the root
  bool connector = false;              // the other end is one
  Vec2 at;                             // where that is; C, own frame
};

class Links {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool full() const noexcept { return size_ == most_links; }
  [[nodiscard]] Link& operator[](std::size_t i) noexcept { return links_[i]; }
  [[nodiscard]] const Link& operator[](std::size_t i) const noexcept { return links_[i]; }
  [[nodiscard]] bool has(RobotId id) const noexcept {
    for (std::size_t i = 0; i < size_; ++i)
      if (links_[i].to == id) return true;
    return false;
  }
  // Nothing happens if it is there, or there is no room.
  void add(RobotId id) noexcept {
    if (id != nobody && !full() && !has(id)) links_[size_++].to = id;
  }
  void remove(RobotId id) noexcept {
    for (std::size_t i = 0; i < size_; ++i) {
      if (links_[i].to != id) continue;
      std::move(links_.begin() + i + 1, links_.begin() + size_, links_.begin() + i);
      links_[--size_] = {};
      return;
    }
  }
  void clear() noexcept { *this = {}; }

 private:
  std::array<Link, most_links> links_{};
  std::uint8_t size_ = 0;
};

// A change in the middle of which a robot is, or what became of it.
struct Change {
  Stage stage = no_change;
  RobotId leaves = nobody;
  RobotId joins = nobody;
  bool recruits = false;    // that was a follower
  std::uint16_t ticks = 0;  // of this stage
};

struct State : KnownRoot {
  RobotId id = nobody;
  OwnTarget assignment;
  bool connector = false;
  std::uint16_t root_ticks = 0;  // for how long it has called itself root
  Links links;
  RobotId parent = nobody;
  std::uint8_t joined_age = unknown_age;
  Change change;
  RobotId held_by = nobody;     // the middle of a change in which it is an end
  RobotId held_other = nobody;  // its other end
  bool leaves = false;          // it is the one that leaves
  RobotId calls = nobody;
  std::uint16_t calls_ticks = 0;
  RobotId ignored = nobody;  // it did not answer
  std::uint16_t ignored_ticks = 0;
  std::uint16_t leaf_ticks = 0;     // for how long it has joined nothing to the network
  std::uint16_t cut_ticks = 65535;  // for how long it has not been joined
  RobotId lost = nobody;            // a robot that fell silent while it was linked with it
  RobotId lost_root = nobody;       // that led to this root, if it was the parent
  Vec2 lost_at;                     // C, own frame: where it was
  std::uint16_t lost_ticks = 0;     // since then
  RobotId team = nobody;
  std::uint8_t team_age = unknown_age;
  bool travels = false;  // on its way to its team
  RobotId needy = nobody;
  std::uint8_t needed = 0;
  std::uint8_t needy_age = unknown_age;
  RobotId sends = nobody;
  std::uint16_t sends_ticks = 0;  // since it sent the last one

  Tally tally;  // never read
  Table<Message> neighbors;

  // About `entries` entries of the table are needed soon, and all the rest.
  void prefetch(std::size_t entries) const noexcept { neighbors.prefetch(entries); }

  [[nodiscard]] bool is_root() const noexcept { return root == id; }
  [[nodiscard]] bool is_leader() const noexcept { return assignment.sent; }
  [[nodiscard]] bool is_follower() const noexcept { return !assignment.sent && !connector; }
  [[nodiscard]] bool is_joined() const noexcept { return joined_age <= news_ticks; }
  // For longer than a change takes to lead the news another way.
  [[nodiscard]] bool is_cut(const Params& params) const noexcept { return cut_ticks > whole(params.change_rounds); }
  [[nodiscard]] bool has_lost_parent() const noexcept { return lost != nobody && lost_root != nobody; }
  [[nodiscard]] bool has_lost_child() const noexcept { return lost != nobody && lost_root == nobody; }
  void forget() noexcept { lost = lost_root = nobody; }
  // In a change of its own or of another's.
  [[nodiscard]] bool is_busy() const noexcept { return change.stage != no_change || held_by != nobody; }
};

}  // namespace banyan::baselines::branches
