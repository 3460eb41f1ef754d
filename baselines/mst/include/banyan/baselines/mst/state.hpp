// SPDX-License-Identifier: MIT
// All that a robot of MST preservation remembers between two steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "banyan/baselines/common/motion.hpp"
#include "banyan/baselines/common/table.hpp"
#include "banyan/baselines/mst/message.hpp"

namespace banyan::baselines::mst {

// Links by their other ends: those that are there, then nobody.
class Ends {
 public:
  [[nodiscard]] bool has(RobotId id) const noexcept { return std::find(begin(), end(), id) != end(); }
  void add(RobotId id) noexcept {
    if (size_ < most_kept_links && !has(id)) ends_[size_++] = id;
  }
  void remove(RobotId id) noexcept {
    const auto last = std::remove(ends_.begin(), ends_.begin() + size_, id);
    size_ = static_cast<std::size_t>(last - ends_.begin());
    std::fill(last, ends_.end(), nobody);
  }
  void clear() noexcept { *this = {}; }
  void add_all(const Ends& others) noexcept {
    for (const RobotId id : others) add(id);
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const RobotId* begin() const noexcept { return ends_.data(); }
  [[nodiscard]] const RobotId* end() const noexcept { return ends_.data() + size_; }
  [[nodiscard]] const KeptLinks& all() const noexcept { return ends_; }

 private:
  KeptLinks ends_ = no_links();
  std::size_t size_ = 0;
};

// A link as it was measured when the construction began.
struct Candidate {
  RobotId to = nobody;
  std::uint16_t length = 0;  // as in an Edge
  bool narrow = false;       // no third robot was nearer to both ends: it may well be in the tree
};

struct State {
  RobotId id = nobody;
  OwnTarget assignment;

  // The tree that is kept
  bool has_tree = false;  // or had one
  Ends tree;
  Ends old;                 // edges of earlier trees, until their other end is known to be in this one
  RobotId parent = nobody;  // towards the root
  RobotId root = nobody;    // the smallest id that is no worker
  Serial tree_epoch = 0;

  // When the next one is built (epoch.cpp)
  Serial epoch = 0;
  Serial next = 0;
  std::uint8_t countdown = 0;
  std::uint16_t epoch_ticks = 0;  // since the construction began

  // Construction (construction.cpp)
  std::uint8_t level = 0;
  RobotId fragment = nobody;  // nobody: none has begun yet
  RobotId up = nobody;
  bool ready = false;
  bool decided = false;
  bool done = true;
  bool failed = false;  // this construction cannot end
  Edge best;
  Edge choice;
  RobotId least = nobody;     // the smallest id below me that is no worker; of a complete tree of all
  RobotId least_by = nobody;  // the branch in which it is; nobody: it is my own id
  Ends branches;
  Ends refused;                        // they had no room for an edge to me: not chosen before there is a tree
  std::uint16_t unanswered_ticks = 0;  // how long the other end of the edge that I chose has not named it
  std::uint16_t decided_ticks = 0;     // a leader: since it chose
  std::array<Candidate, neighbor_capacity> candidates{};
  std::uint8_t candidate_count = 0;

  [[nodiscard]] bool holds(RobotId end) const noexcept { return tree.has(end) || old.has(end) || branches.has(end); }
  // All edges that are promised, at most as many as a report has room for: none is added beyond that.
  [[nodiscard]] Ends held() const noexcept {
    Ends all = tree;
    all.add_all(old);
    all.add_all(branches);
    return all;
  }
  [[nodiscard]] bool is_full() const noexcept { return held().size() == most_kept_links; }

  Tally tally;  // never read
  Table<Message> neighbors;

  // About `entries` entries of the table are needed soon, and all the rest.
  void prefetch(std::size_t entries) const noexcept { neighbors.prefetch(entries); }
};

}  // namespace banyan::baselines::mst
