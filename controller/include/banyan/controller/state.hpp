// SPDX-License-Identifier: MIT
// All that a robot remembers between two steps. A plain value: copy it, compare it, hash it.
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/neighborhood.hpp"

namespace banyan {

// Paper Fig. 5, spare robots.
enum class SpareState : std::uint8_t { wait, extend_edge, adjust_position };

// Counters for whoever watches (measure/); the algorithm never reads them.
struct Tally {
  std::uint32_t insertions = 0;  // times I was inserted into an edge
  std::uint32_t handovers = 0;   // times I took over the root token
  std::uint32_t repairs = 0;     // times I replaced a lost parent or re-attached as an orphan
  std::uint32_t elections = 0;   // times I made myself root because the root had fallen silent
  std::uint32_t replacements = 0;  // times I took over the target of a worker that had fallen silent
};

inline constexpr int task_capacity = 12;  // further targets have no successor for their worker

// A target, as everybody knows it who may have to take it over (succession.cpp).
struct Task {
  RobotId serves = nobody;       // the worker first sent there: the target's name
  RobotId holder = nobody;       // who serves it; nobody: it has been given up
  std::uint16_t beat = 0;        // the holder's count of ticks, the newest heard of
  std::uint16_t age_ticks = 0;   // since it grew
  Vec2 target;                   // m, own frame
  RobotId host = nobody;         // the root's plan: the branch of this target is to begin at that one (plan.cpp)
};

// A way round an obstacle (bypass.hpp); vectors in the own frame, m.
struct Detour {
  std::int8_t side = 0;  // +1: the obstacle is to the right, -1: to the left, 0: no detour
  Vec2 contact;          // where the obstacle was touched last
  Vec2 origin;           // where the detour began
  Vec2 goal;             // as it was then
  float leave_m = 0.0F;  // over when the goal is nearer than it was then
  float span_m = 0.0F;   // the other side is tried so far from the origin
};

// Points of obstacles that were sensed a while ago, in the own frame, m.
inline constexpr int landmark_capacity = 8;
struct Landmarks {
  std::array<Vec2, landmark_capacity> points{};  // the first `size` are valid
  std::uint8_t size = 0;
};

struct State {
  RobotId id = nobody;
  bool is_worker = false;
  RobotId serves = nobody;            // worker: whose target this is, the id of the worker first sent there
  Role role = Role::spare;

  // Epoch, phase, root token: gossip (epoch.hpp)
  std::uint16_t epoch = 0;
  Phase phase = Phase::init;
  std::uint16_t phase_ticks = 0;      // since this robot entered the phase
  RootToken root;
  std::uint16_t root_size = 0;        // robots that this root counted last; 0: none yet
  std::uint16_t done_ticks = 0;       // the root's barrier has held for so long

  // Label: distance to the root and the echo (label.hpp)
  std::uint16_t label_cm = unknown_label;
  std::uint16_t label_wait_ticks = 0;  // since the first labelled neighbour was heard
  RobotId flood_parent = nobody;
  bool flood_done = false;
  std::uint16_t flood_robots = 0;
  std::uint16_t flood_workers = 0;

  // Tree (parent_selection.hpp)
  RobotId parent = nobody;
  RobotId old_parent = nobody;
  bool committed = false;
  std::uint16_t search_ticks = 0;        // without a candidate parent
  std::uint16_t orphan_ticks = 0;        // depth invalid though I matter
  std::uint16_t childless_ticks = 0;     // connector without a child that is no spare
  std::uint16_t pulse = 0;
  RobotId wish = nobody;                 // the robot I want as parent as soon as it is ahead of me
  std::uint16_t wish_ticks = 0;
  RobotId warned = nobody;               // the child that I am about to lose sight of
  std::uint16_t depth = invalid_depth;
  std::uint8_t tree_hops = unreachable;

  // Count and centroid (census.hpp)
  std::uint16_t subtree = 1;
  std::uint16_t subtree_workers = 0;
  std::uint16_t count = 0;               // Alg. 2
  Vec2 q;                                // m, own frame; at the root Alg. 1's centroid
  float want_m = 0.0F;                   // largest remaining worker distance below me
  Vec2 pull;                             // target pull, own frame
  float least_want_m = 0.0F;             // the least want_m since it last grew
  std::uint16_t stalled_ticks = 0;       // since least_want_m last shrank by a hand's breadth

  // Root selection (root_selection.hpp)
  Vec2 centroid;                         // m, own frame
  bool centroid_known = false;
  RobotId new_root = nobody;             // offered to
  std::uint16_t offer_ticks = 0;

  // Spare management (spare_management.hpp)
  Need need = Need::no_need;
  std::uint16_t unserved_ticks = 0;      // in NEED without a grant
  std::uint8_t call_hops = nobody_calls;
  RobotId grant = nobody;
  std::uint16_t grant_ticks = 0;
  RobotId inserted_child = nobody;
  std::uint16_t inserted_ticks = 0;
  SpareState spare_state = SpareState::wait;
  RobotId request = nobody;              // owner of the edge I want to extend
  std::uint16_t request_ticks = 0;
  std::uint16_t ungranted_ticks = 0;
  RobotId reference = nobody;            // the robot a spare stays with, or follows to a need
  bool called = false;                   // by an edge out of sight

  // Chains from target to target (plan.cpp)
  RobotId above = nobody;                // the next worker above me in the tree, by its target
  RobotId below = nobody;                // the only worker below me, by its target
  RobotId errand = nobody;               // I lead my branch to that target
  RobotId led_from = nobody;             // the parent it had then
  std::uint16_t errand_ticks = 0;        // since its parent changed
  std::uint16_t settled_ticks = 0;       // the root: all workers have arrived
  std::uint16_t unsettled_ticks = 0;     // or have not any more
  std::uint16_t plan_ticks = 0;          // of the plan that is being carried out

  // Healing (healing.hpp)
  float expected_packets = 0.0F;         // of the last ticks, fading: to be heard
  float missed_packets = 0.0F;           // and of these, not heard
  std::uint16_t liveness_ticks = 0;      // what that loss asks for; 0: I will do
  std::uint16_t heartbeat = 0;
  std::uint16_t silence_ticks = 0;       // since the heartbeat grew
  RootToken heart;                       // the root whose heartbeat it is
  Vec2 root_at;                          // m, own frame: where that root is or was
  bool root_known = false;
  std::uint16_t turn = 0;                // whom I tell next
  std::uint16_t stub_ticks = 0;          // the last robot below me has died: so long I still go after it
  Vec2 stub;                             // m, own frame: where it was
  std::uint8_t task_count = 0;
  std::array<Task, task_capacity> tasks{};  // the first task_count are valid
  // Obstacles (bypass.hpp)
  Detour detour;
  Landmarks landmarks;
  Vec2 seen_from;                        // m, own frame: where I was when I last heard my parent; a spare: where the tree was
  bool pinned = false;                   // a corner is about to cut the edge to my parent

  Tally tally;
  Neighborhood neighbors;
};

// 64 bits over every field that can influence a later step, padding excluded.
[[nodiscard]] std::uint64_t hash(const State& state) noexcept;

}  // namespace banyan
