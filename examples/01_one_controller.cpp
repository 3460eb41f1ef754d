// SPDX-License-Identifier: MIT
// The controller alone, in a loop written by hand: what a robot's firmware does, with the geometry
// of a world in ten lines. Robot 0 is the root and stands still; robot 1 is sent to a target.
#include <cstdio>

#include "banyan/controller/paper/paper.hpp"

using namespace banyan;

int main() {
  const Platform platform;  // what the robot is: a Khepera IV with a radio that reaches 2 m
  paper::Params params = paper::outwards_column();
  static_cast<Machine&>(params) = machine_of(platform);
  paper::State states[2] = {paper::initial(0, false, true), paper::initial(1, true, false)};
  paper::Message sent[2];  // what each robot said in the last tick
  Odometry odometry[2];    // how each moved since then; the root does not
  const Vec2 target{1.2F, 0.4F};
  Vec2 position[2] = {{0.0F, 0.0F}, {0.3F, 0.0F}};
  Vec2 heading[2] = {{1.0F, 0.0F}, {0.0F, 1.0F}};  // the worker does not face the target

  for (int tick = 0; tick < 150; ++tick) {
    Output<paper::Message> output[2];
    for (int i = 0; i < 2; ++i) {
      // Situated communication: the message, and where its sender is in my own frame.
      paper::Heard heard[] = {{&sent[1 - i], rotate_back(heading[i], position[1 - i] - position[i])}};
      Senses senses;
      senses.odometry = odometry[i];
      if (i == 1) senses.orders = {.sent = true, .target = rotate_back(heading[i], target - position[i])};
      output[i] = paper::step(paper::outwards, paper::corrected, params, states[i],
                              {std::span(heard, tick > 0 ? 1 : 0), senses, platform});
    }
    sent[0] = output[0].message;
    sent[1] = output[1].message;
    const Velocity velocity = velocity_of(output[1].motion, platform);  // for the motors
    const float turn = velocity.turn_rad_s * platform.tick_s;
    odometry[1] = {velocity.forward_m_s * platform.tick_s, 0.0F, turn};
    position[1] += heading[1] * odometry[1].forward_m;
    heading[1] = unit(rotate(heading[1], unit_vector(turn)));
    if (tick % 25 == 24) std::printf("%4.1f s: %.2f m to go\n", 0.1 * tick + 0.1, 1.0 * distance(position[1], target));
  }
  return distance(position[1], target) < 0.2F && states[1].parent == 0 ? 0 : 1;
}
