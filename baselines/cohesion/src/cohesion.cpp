// SPDX-License-Identifier: MIT
#include "banyan/baselines/cohesion/cohesion.hpp"

#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::cohesion {
namespace {

constexpr float inertia = 0.8F;  // of a robot's velocity that it keeps

// My own velocity by K, in the frame of now.
Vec2 velocity_of(const Params& params, const Inputs<Heard>& inputs) noexcept {
  const Carry way = inputs.carry();
  const Vec2 v = way.shift / (inputs.elapsed() * params.way_in_a_round() * params.speed_gain);
  return clamped(way.vector(v), 1.0F);
}

std::uint16_t to_bearing(const Surroundings& around, int k) noexcept {
  return to_fixed<std::uint16_t>(around.bearings[static_cast<std::size_t>(k)], per_rad);
}

// Open sectors, the widest first; in the room that is left, where some neighbours are.
void say_sectors(Message& m, const Robot& robot, const Boundary& boundary) noexcept {
  const auto mention = [&](int k) { return Mention{robot.table().id(k), to_bearing(robot.around, k)}; };
  int next = 0;
  for (std::size_t i = 0; i < most_said_sectors; ++i) {
    if (static_cast<int>(i) < boundary.size) {
      const Sector& s = boundary.sectors[i];
      m.sectors[i] = {mention(s.right), mention(s.left), s.right_mean, s.left_mean};
      continue;
    }
    // Spread around, so that whoever hears this knows one of them.
    const int step = std::max(1, robot.around.size / static_cast<int>(2 * most_said_sectors));
    for (Mention* const free : {&m.sectors[i].right, &m.sectors[i].left}) {
      if (next >= robot.around.size) continue;
      *free = mention(robot.around.next(next));
      next += step;
    }
  }
}

}  // namespace

State initial_state(RobotId id, bool worker, bool root) noexcept { return state_at_start<State>(id, worker, root); }

Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
  begin_step(params, state, inputs, [](RobotId) { return false; });
  state.follow_root(state.id, state.assignment.sent, state.neighbors, inputs.elapsed_ticks(), state.tally);
  const Vec2 velocity = velocity_of(params, inputs);

  Robot robot{params, state};
  const Boundary boundary = find_boundary(robot);
  const Thickness thickness = find_thickness(robot, boundary);
  const Leaders leaders = find_leaders(robot, velocity);
  const Help help = find_help(robot);
  const Density density = find_density(robot, boundary);

  // (1), (2)
  Vec2 u = target_pull(state.assignment, params);
  const Vec2 drawn_in = contraction(robot, boundary, thickness);
  if (!state.assignment.sent) {
    u = velocity * inertia + lattice_force(robot, velocity) + boundary_tension(robot, boundary) + help.pull + drawn_in;
    if (!boundary.is_boundary()) u += leaders_pull(robot, leaders) + density.force;
  }
  u += avoidance(state.neighbors, inputs.obstacles(), params);

  Message m{.id = state.id,
            .candidate = boundary.candidate,
            .matching = boundary.matching,
            .velocity = to_wire(velocity),
            .leaders = leaders.said,
            .depth = thickness.depth,
            .thickness = thickness.thickness,
            .hops = thickness.hops,
            .help = help.said,
            .density = density.said,
            .root = state.root,
            .root_age = state.root_age};
  say_sectors(m, robot, boundary);
  return {m, move(u, state.assignment.sent ? wait_for_nearest(robot) : Guard{}, params)};
}

Report report(const State& state) noexcept { return report_without_links(state); }

void add_to(Digest& digest, const State& s) noexcept {
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  add(s.id, s.assignment.sent, s.assignment.known, s.assignment.target);
  add(s.root, s.root_age, s.rootless_ticks, s.lasting_thickness);
  add(s.tally.elections, s.tally.rejected);
  s.neighbors.add_to(digest);
}

}  // namespace banyan::baselines::cohesion
