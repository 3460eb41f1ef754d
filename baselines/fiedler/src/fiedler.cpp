// SPDX-License-Identifier: MIT
#include "banyan/baselines/fiedler/fiedler.hpp"

#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::fiedler {
namespace {

constexpr float least_margin = 1e-3F;     // lambda_2 - epsilon counts as at least this: coth is infinite at 0
constexpr float least_to_divide = 0.02F;  // to divide by
constexpr float most_control = 2.0F;      // twice the largest pull of a target; avoidance is to count, too

// csch^2 u = 4 q / (1 - q)^2, q = e^-2u, for u > 0.
float csch_squared(float u) noexcept {
  const float q = exp_minus(2.0F * u);
  return 4.0F * q / ((1.0F - q) * (1.0F - q));
}

// (5)  N dlambda_2 / dp_i = sum a_ij / sigma^2 (x_i - x_j)^2 / z2 (p_j - p_i)
Vec2 gradient(const Params& params, const State& state, const Links& links) noexcept {
  Vec2 sum;
  for (int k = 0; k < state.neighbors.size(); ++k) {
    const float difference = state.component - state.neighbors.message(k).component;
    sum += state.neighbors.position(k) * (links[k] * difference * difference);
  }
  return sum / (params.weight_width * params.weight_width * std::max(state.square.value, least_to_divide));
}

// (6)  V = coth(lambda_2 - epsilon),  u_c = -gain dV / dp = gain csch^2(lambda_2 - epsilon) dlambda_2 / dp
Vec2 connectivity_control(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const float slope = csch_squared(std::max(robot.self.lambda - p.least_connectivity, least_margin));
  return clamped(gradient(p, robot.self, robot.links) * (p.connectivity_gain * slope), most_control);
}

Message composed(const State& s) noexcept {
  return {.id = s.id,
          .component = s.component,
          .mean = s.mean,
          .square = s.square,
          .product = s.product,
          .lambda = s.lambda,
          .links = s.links,
          .largest_degree = s.largest_degree,
          .degree_age = s.degree_age,
          .root = s.root,
          .root_age = s.root_age};
}

}  // namespace

Vec2 connectivity_gradient(const Params& params, const State& state) noexcept {
  return gradient(params, state, Links(params, state.neighbors));
}

State initial_state(RobotId id, bool worker, bool root) noexcept { return state_at_start<State>(id, worker, root); }

Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
  begin_step(params, state, inputs, [](RobotId) { return false; });

  state.ticks = static_cast<std::uint16_t>(std::min(state.ticks + inputs.elapsed_ticks(), 0xFFFF));

  Robot robot{params, state, inputs.elapsed_ticks()};
  spread_news(robot);
  // Neighbours' components are those of the last tick, as mine is until the iteration.
  const Vec2 control = connectivity_control(robot);
  iterate(robot);
  const Vec2 task = state.ticks > whole(params.settling_rounds) ? target_pull(state.assignment, params) : Vec2{};
  const Vec2 u = task + control + avoidance(state.neighbors, inputs.obstacles(), params);
  return {composed(state), move(u, Guard{}, params)};
}

// It guarantees no particular link, only lambda_2 > 0.
Report report(const State& state) noexcept { return report_without_links(state); }

void add_to(Digest& digest, const State& s) noexcept {
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  add(s.id, s.assignment.sent, s.assignment.known, s.assignment.target, s.ticks);
  add(s.links, s.largest_degree, s.degree_age, s.root, s.root_age, s.rootless_ticks);
  add(s.component, s.lambda, s.draws);
  for (const Average& a : {s.mean, s.square, s.product}) add(a.value, a.integral);
  add(s.tally.elections, s.tally.rejected);
  s.neighbors.add_to(digest);
}

}  // namespace banyan::baselines::fiedler
