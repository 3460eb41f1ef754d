// SPDX-License-Identifier: MIT
// One robot on a workbench: its neighbours stand where a test puts them and say what it makes them
// say, and single rooms of the controller are called on it.
#pragma once

#include <map>
#include <vector>

#include "banyan/controller/controller.hpp"
#include "banyan/controller/policies.hpp"
#include "banyan/controller/robot.hpp"
#include "banyan/controller/survey.hpp"

namespace banyan {

class Bench {
 public:
  explicit Bench(const Policy& policy_ = outwards(), Reading reading = Reading::corrected, RobotId id = 1)
      : policy{&policy_}, params{policy_.defaults(reading)}, state{initial_state(id, false, false)} {}

  // A neighbour of the robot's own epoch and phase that belongs to the tree; it repeats its message
  // every tick until the test changes or silences it.
  Message& put(RobotId id, Vec2 position) {
    Neighbor& n = neighbors_[id];
    n.position = position;
    n.message.id = id;
    n.message.epoch = state.epoch;
    n.message.phase = state.phase;
    n.message.root = state.root;
    return n.message;
  }
  Message& say(RobotId id) { return neighbors_.at(id).message; }
  void move(RobotId id, Vec2 position) { neighbors_.at(id).position = position; }
  void silence(RobotId id) { neighbors_.erase(id); }

  // Packets of one tick go into the table and the table is surveyed, as step() does it.
  Robot tick(const Odometry& odometry = {}) {
    listen();
    Robot robot(params, *policy, state, heard_, target, obstacles);
    state.neighbors.update(heard_, Carry(odometry), robot.liveness_ticks(), state.id, {state.parent, state.old_parent});
    survey(robot);
    return robot;
  }
  Output step(const Odometry& odometry = {}) {
    listen();
    return banyan::step(params, *policy, state, heard_, odometry, target, obstacles);
  }
  Output steps(int count) {
    Output output;
    for (int k = 0; k < count; ++k) output = step();
    return output;
  }

  const Policy* policy;
  Params params;
  State state;
  const Vec2* target = nullptr;
  std::vector<Vec2> obstacles;  // what the proximity sensor sees

 private:
  struct Neighbor { Message message; Vec2 position; };
  void listen() {
    heard_.clear();
    for (const auto& [id, n] : neighbors_) heard_.push_back({&n.message, n.position});
  }
  std::map<RobotId, Neighbor> neighbors_;
  std::vector<Heard> heard_;
};

// A member of the tree in GROW TREE, epoch 1, with robot 9 as root.
inline Bench grown(const Policy& policy = outwards(), Reading reading = Reading::corrected) {
  Bench bench(policy, reading);
  bench.state.epoch = 1;
  bench.state.phase = Phase::grow_tree;
  bench.state.root = {1, 9};
  return bench;
}

}  // namespace banyan
