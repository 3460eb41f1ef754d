// SPDX-License-Identifier: MIT
// One robot on a workbench: its neighbours stand where a test puts them and say what it makes them
// say, and single rooms of the controller are called on it. Places are in C.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/paper/rules.hpp"
#include "convoy/robot.hpp"
#include "healing/healing.hpp"
#include "healing/tick.hpp"
#include "test_platform.hpp"
#include "tree/tree_index.hpp"

namespace banyan {

// ---- Kinds of robots: what an algorithm runs on ----

template <const paper::Growth& growth, const paper::Reading& reading, auto column> struct PaperKind {
  using Params = paper::Params;
  using State = paper::State;
  using Message = paper::Message;
  using Heard = paper::Heard;
  using Robot = paper::Robot;
  static Params defaults() { return column(); }
  static State initial(RobotId id, bool worker, bool root) { return paper::initial(id, worker, root); }
  static auto step(const Params& params, State& state, const Inputs<Heard>& inputs) {
    return paper::step(growth, reading, params, state, inputs);
  }
  static Report report(const State& state) { return paper::report(state); }
};

struct Convoy {
  using Params = ConvoyParams;
  using State = ConvoyState;
  using Message = ConvoyMessage;
  using Heard = banyan::Heard;
  using Robot = ConvoyRobot;
  static Params defaults() { return convoy_defaults(); }
  static State initial(RobotId id, bool worker, bool root) { return initial_convoy_state(id, worker, root); }
  static Robot robot(const Params& params, State& state, const Inputs<Heard>& inputs, Workspace& space) {
    return {params, state, inputs, space};
  }
  static auto step(const Params& params, State& state, const Inputs<Heard>& inputs) {
    return convoy_step(params, state, inputs);
  }
  static Report report(const State& state) { return convoy_report(state); }
};

using Outwards = PaperKind<paper::outwards, paper::corrected, paper::outwards_column>;
using Inwards = PaperKind<paper::inwards, paper::corrected, paper::inwards_column>;
using OutwardsLiteral = PaperKind<paper::outwards, paper::literal, paper::outwards_column>;
using InwardsLiteral = PaperKind<paper::inwards, paper::literal, paper::inwards_column>;

// visit.operator()<Kind>() for every algorithm, in both readings.
template <class Visit> void for_each_kind(Visit visit) {
  visit.template operator()<OutwardsLiteral>();
  visit.template operator()<Outwards>();
  visit.template operator()<InwardsLiteral>();
  visit.template operator()<Inwards>();
  visit.template operator()<Convoy>();
}

// ---- The workbench ----

template <class Kind> class BenchOf {
 public:
  using Message = typename Kind::Message;
  using Heard = typename Kind::Heard;
  using Robot = typename Kind::Robot;

  explicit BenchOf(RobotId id = 1) : state{Kind::initial(id, false, false)} {}

  // A neighbour of the robot's own epoch and phase that belongs to the tree; it repeats its message
  // every tick until the test changes or silences it.
  Message& put(RobotId id, Vec2 position) {
    Neighbor& n = neighbors_[id];
    n.position = position;
    n.message.id = id;
    n.message.count = state.id;  // it hears me
    n.message.epoch = state.epoch;
    n.message.phase = state.phase;
    n.message.root = state.root;
    return n.message;
  }
  // A connector of the tree, not far from the root, with a label and a sequence number.
  Message& put_connector(RobotId id, Vec2 position, std::uint16_t label, std::uint16_t seqno) {
    Message& m = put(id, position);
    m.role = Role::connector;
    m.parent = 9;
    m.depth = 2;
    m.tree_hops = 0;
    m.label = label;
    m.seqno = seqno;
    return m;
  }
  // Below this robot in the tree.
  Message& put_child(RobotId id, Vec2 position, Role role) {
    Message& m = put(id, position);
    m.role = role;
    m.parent = state.id;
    return m;
  }
  Message& say(RobotId id) { return neighbors_.at(id).message; }
  void move(RobotId id, Vec2 position) { neighbors_.at(id).position = position; }
  void silence(RobotId id) { neighbors_.erase(id); }

  // To a target at that place, from now on; its own frame, C.
  void send(Vec2 target) {
    orders.sent = true;
    orders.target = target;
  }
  void call_back() { orders = {}; }

  // Packets of one tick go into the table, orders are followed and neighbours indexed, as a step does it.
  Robot tick(const Odometry& odometry = {}) {
    listen();
    const Inputs<Heard>& inputs =
        *inputs_.emplace_back(std::make_shared<Inputs<Heard>>(heard_, senses(odometry), test_platform));
    Robot robot = Kind::robot(params, state, inputs, spaces_.emplace_back(inputs));
    begin_tick(robot, inputs);
    index_neighbors(robot);
    return robot;
  }
  Output<Message> step(const Odometry& odometry = {}) {
    listen();
    return Kind::step(params, state, {heard_, senses(odometry), test_platform});
  }
  Output<Message> steps(int count) {
    Output<Message> output;
    for (int k = 0; k < count; ++k) output = step();
    return output;
  }

  typename Kind::Params params = Kind::defaults();
  typename Kind::State state;
  Orders orders;
  std::vector<Vec2> obstacles;  // what the proximity sensor sees
  float elapsed_s = 0.0F;       // between steps; 0: a tick

 private:
  struct Neighbor {
    Message message;
    Vec2 position;
  };
  void listen() {
    heard_.clear();
    for (const auto& [id, n] : neighbors_) heard_.push_back({&n.message, n.position});
  }
  [[nodiscard]] Senses senses(const Odometry& odometry) const {
    return {.odometry = odometry, .orders = orders, .obstacles = obstacles, .elapsed_s = elapsed_s};
  }
  std::map<RobotId, Neighbor> neighbors_;
  std::vector<Heard> heard_;
  // What robots of single rooms refer to, for each of them
  std::vector<std::shared_ptr<const Inputs<Heard>>> inputs_;
  std::deque<Workspace> spaces_;
};

using ConvoyBench = BenchOf<Convoy>;

// A member of the tree in GROW TREE, epoch 1, with robot 9 as root.
template <class Kind = Convoy> BenchOf<Kind> grown() {
  BenchOf<Kind> bench;
  bench.state.epoch = 1;
  bench.state.phase = Phase::grow_tree;
  bench.state.root = {1, 9};
  return bench;
}

// A root with its centroid at x = 1, and neighbour 5 on the way there.
template <class Kind = Convoy> BenchOf<Kind> handing_over() {
  BenchOf<Kind> bench = grown<Kind>();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  bench.state.phase = Phase::select_root;
  bench.state.centroid = {1, 0};
  bench.state.centroid_known = true;
  bench.put(5, {0.5F, 0}).role = Role::connector;
  return bench;
}

}  // namespace banyan
