// SPDX-License-Identifier: MIT
// The one broadcast a robot sends per tick, and its wire format (protocol 1). The fields are kept in
// their wire types, so what a receiver computes with is exactly what travelled.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "banyan/controller/vec2.hpp"

namespace banyan {

using RobotId = std::uint16_t;
inline constexpr RobotId nobody = 0xFFFF;

// Paper Sec. III-A. A mission fixes worker and the first root; the others follow from the tree.
enum class Role : std::uint8_t { spare, connector, worker, root };

// Paper Fig. 1, in the order in which they are entered; (epoch, phase) only ever grows.
enum class Phase : std::uint8_t { init, start_tree, select_parent, grow_tree, select_root };

// Paper Fig. 5, non-spare robots: the need of the edge to the parent.
enum class Need : std::uint8_t { no_need, need, await };

// A token that says who is root: the larger (sequence, id) wins.
struct RootToken {
  std::uint16_t sequence = 0;
  RobotId id = nobody;
  friend constexpr bool operator==(RootToken, RootToken) noexcept = default;
};
constexpr bool newer(RootToken a, RootToken b) noexcept {
  return a.sequence != b.sequence ? a.sequence > b.sequence : a.id > b.id;
}

// Counts modulo 2^16: how much `a` is ahead of `b`.
constexpr int ahead_by(std::uint16_t a, std::uint16_t b) noexcept {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(a - b));
}

inline constexpr std::uint16_t unknown_label = 0xFFFF;
inline constexpr std::uint16_t invalid_depth = 0;
inline constexpr std::uint8_t unreachable = 0xFF;
inline constexpr std::uint8_t nobody_calls = 0xFF;

// What a robot keeps of each neighbour until it hears from it again: where it stands in the protocol.
// A cache line: 96 of them are most of what a robot remembers.
struct Standing {
  RobotId id = nobody;
  Role role = Role::spare;
  Phase phase = Phase::init;
  Need need = Need::no_need;
  bool flood_done : 1 = false;      // START echo: my flood subtree is complete (protocol 4)
  bool committed : 1 = false;       // I am in this epoch's tree
  bool parent_silent : 1 = false;   // my parent has not been heard for longer than I
  bool pinned : 1 = false;          // a corner is about to cut the edge to my parent, and I have to go on
  std::uint16_t epoch = 0;
  std::uint16_t label_cm = unknown_label;  // distance to the root along hops, fixed once an epoch
  std::uint16_t pulse = 0;        // the root's count as it came down the tree: (pulse, label) orders the tree
  std::uint16_t depth = invalid_depth;     // root 1; 0: not connected to the root by tree edges
  std::uint8_t tree_hops = unreachable;    // hops over unattached spares to the rooted tree, 0: in it
  std::uint8_t call_hops = nobody_calls;   // hops to an edge whose need nobody has answered
  RobotId parent = nobody;
  RobotId old_parent = nobody;
  RobotId flood_parent = nobody;
  std::uint16_t flood_robots = 0;   // echo sums
  std::uint16_t flood_workers = 0;
  std::uint16_t subtree = 0;          // 1 + sum over children
  std::uint16_t subtree_workers = 0;
  std::uint16_t count = 0;            // Alg. 2's c_i, beside the sums above; nothing depends on it
  std::uint16_t want_cm = 0;          // largest remaining worker distance below me
  Vec2 q;                             // m, edge frame to `up`: Alg. 1's contribution
  std::int16_t pull_x = 0;            // target pull, edge frame to `up`, 1 = pull_unit
  std::int16_t pull_y = 0;
  RobotId grant = nobody;             // the spare I let into the edge to my parent
  RobotId request = nobody;           // the owner whose edge I want to join
  RobotId inserted_child = nobody;    // I have just been inserted above this robot
  std::int16_t hinge_x_cm = 0;        // the corner nearest to the edge to my parent - parent, edge frame; 0, 0: none known
  std::int16_t hinge_y_cm = 0;
  RobotId serves = nobody;            // worker: whose target this is, the id of the worker first sent there
  std::uint8_t child_count = 0;       // living children that are no spares
  RobotId below = nobody;             // the only worker below me, by its target; nobody: there are branches

  friend bool operator==(const Standing&, const Standing&) = default;
};

// What is made use of in the tick in which it is heard, and passed on.
struct Tidings {
  RootToken root;               // gossip: the newest root token I know
  std::uint16_t root_size = 0;        // robots that this root counted last; 0: none yet
  RobotId new_root = nobody;          // offer of the token root.sequence + 1
  std::int16_t centroid_x_cm = 0;     // centroid - addressee, edge frame to `new_root`
  std::int16_t centroid_y_cm = 0;
  RobotId warned = nobody;            // the child whose line of sight to me is about to be cut, for all it can see
  RobotId above = nobody;             // the next worker above me in the tree, by its target (plan.cpp)
  // Healing (healing.hpp): everybody passes on where the root and the targets are, a target and an
  // addressee a tick in turn. Who is no addressee makes use of the counts alone.
  std::uint16_t heartbeat = 0;        // gossip: the root's count of ticks, compared modulo 2^16
  RobotId told = nobody;              // addressee of the vectors that follow
  bool root_told = false;             // I know where the root is
  std::int16_t root_x_cm = 0;         // root - addressee, edge frame to `told`
  std::int16_t root_y_cm = 0;
  RobotId task_serves = nobody;       // a target, by its first worker; nobody: I know none
  RobotId task_holder = nobody;       // gossip: who serves it; nobody: it has been given up
  RobotId task_host = nobody;         // the root's plan: at which target its branch is to begin; nobody: none
  std::uint16_t task_beat = 0;        // gossip: the holder's count of ticks, compared modulo 2^16
  std::int16_t task_x_cm = 0;         // target - addressee, edge frame to `told`
  std::int16_t task_y_cm = 0;

  friend bool operator==(const Tidings&, const Tidings&) = default;
};

static_assert(sizeof(Standing) == 64);

struct Message : Standing, Tidings {
  friend bool operator==(const Message&, const Message&) = default;
};

inline constexpr float pull_unit = 16384.0F;  // fixed point of pull_x, pull_y: +-2
inline constexpr float per_cm = 100.0F;        // fixed point of lengths

// `v` as it travels: in units of 1 / unit, rounded, saturated.
template <class Int>
constexpr Int to_fixed(float v, float unit) noexcept {
  const float scaled = v * unit + (v < 0.0F ? -0.5F : 0.5F);
  constexpr auto low = static_cast<float>(std::numeric_limits<Int>::min());
  constexpr auto high = static_cast<float>(std::numeric_limits<Int>::max());
  return static_cast<Int>(std::clamp(scaled, low, high));
}
// Largest |component| of q. A sender keeps within it and decode() rejects what exceeds it, or one
// robot's nonsense would overflow the sums of all above it.
inline constexpr float q_limit_m = 1.0e9F;

// The tree neighbour that vectors of the census are addressed to: the parent or, during a switch
// while there is none, the old parent.
constexpr RobotId up_of(const Standing& m) noexcept { return m.role == Role::root ? nobody : m.parent != nobody ? m.parent : m.old_parent; }

inline constexpr std::size_t wire_size = 96;  // bytes, little-endian, no padding
inline constexpr std::uint8_t wire_version = 3;
using Wire = std::array<std::uint8_t, wire_size>;

[[nodiscard]] Wire encode(const Message& message) noexcept;

// nothing if the size, the version, an enumerator, a reserved bit or a float is not one that
// encode() writes; never reads outside `bytes`.
[[nodiscard]] std::optional<Message> decode(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace banyan
