// SPDX-License-Identifier: MIT
// What an observer may know of a robot: never read by an algorithm. The first part is what every
// algorithm can say; what an algorithm does not use keeps its default here.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/serial.hpp"

namespace banyan {

// Paper Sec. III-A. A mission fixes worker and the first root; the others follow from the tree.
enum class Role : std::uint8_t { spare, connector, worker, root };

// Paper Fig. 1, in the order in which they are entered; (epoch, phase) only ever grows.
enum class Phase : std::uint8_t { init, start_tree, select_parent, grow_tree, select_root };

// Paper Fig. 5, non-spare robots: the need of the edge to the parent.
enum class Need : std::uint8_t { no_need, need, await };

// Paper Fig. 5, spare robots.
enum class SpareState : std::uint8_t { wait, extend_edge, adjust_position };

// What has happened to a robot since the start.
struct Tally {
  std::uint32_t insertions = 0;    // times it was inserted into an edge
  std::uint32_t handovers = 0;     // times it took over the root token
  std::uint32_t repairs = 0;       // times it replaced a lost parent or re-attached as an orphan
  std::uint32_t elections = 0;     // times it became root because the root had fallen silent
  std::uint32_t replacements = 0;  // times it took over the target of a worker that had fallen silent
  std::uint32_t rejected = 0;      // sensor readings that did not pass the gate (gate.hpp)
};

// Links that a robot can promise to keep besides the edges to its parents.
inline constexpr std::size_t most_kept_links = 12;
using KeptLinks = std::array<RobotId, most_kept_links>;
constexpr KeptLinks no_links() noexcept {
  KeptLinks links{};
  links.fill(nobody);
  return links;
}

struct Report {
  Role role = Role::spare;
  RobotId parent = nobody;  // the edges that it promises to keep
  RobotId old_parent = nobody;
  KeptLinks kept =
      no_links();            // the links that it promises to keep besides, then nobody: without a tree, or of a spare
  RobotId serves = nobody;   // a worker: its target, by the robot first sent there
  RobotId root = nobody;     // the robot that it believes to be root,
  Serial root_sequence = 0;  // by a token with this number: the newest names the root

  // Algorithms that build a tree again and again (paper Fig. 1, Fig. 5)
  Serial epoch = 0;
  Phase phase = Phase::init;
  Need need = Need::no_need;
  SpareState spare_state = SpareState::wait;
  float label = -1.0F;        // distance to the root along hops, C; -1: unknown
  std::uint16_t depth = 0;    // in the tree, root 1; 0: no path of tree edges to the root
  RobotId grant = nobody;     // the spare that it lets into the edge to its parent
  RobotId request = nobody;   // the owner of the edge that it wants to join
  float want = 0.0F;          // largest remaining way of a worker below, C
  bool out_of_scale = false;  // so far from the root that its label cannot grow: it has no place for a child

  // Algorithms for robots with batteries
  bool leaves = false;        // it has to be relieved
  bool seeks_charge = false;  // it is free, and on its way to a charging place or waits there to be full
  RobotId relieves = nobody;  // the robot whose place it takes

  Tally tally;
};

// The robot at the upper end of its edge: the parent or, while trees are switched and there is none, the old one.
constexpr RobotId up_of(const Report& r) noexcept {
  return r.role == Role::root ? nobody : r.parent != nobody ? r.parent : r.old_parent;
}

// Of two robots that believe in different roots, `a` knows the newer token.
constexpr bool has_newer_root(const Report& a, const Report& b) noexcept {
  return a.root_sequence != b.root_sequence ? is_newer(a.root_sequence, b.root_sequence) : a.root > b.root;
}

// Whether the link to `other` is one of those that it keeps besides a tree.
constexpr bool keeps(const Report& r, RobotId other) noexcept {
  return r.kept[0] != nobody && std::find(r.kept.begin(), r.kept.end(), other) != r.kept.end();
}

}  // namespace banyan
