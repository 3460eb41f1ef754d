// SPDX-License-Identifier: MIT
// Radio links from positions alone, as a picture needs them (draw.hpp).
#include "banyan/record/draw.hpp"
#include "banyan/world/radio.hpp"
#include "seen_bodies.hpp"

namespace banyan::record {

RadioLinks radio_links(const Setting& setting, const Frame& frame) {
  RadioLinks links;
  if (frame.robots.empty()) return links;
  world::Scenario scenario;
  scenario.radio.range_m = setting.range_m;
  scenario.radio.line_of_sight = setting.line_of_sight;
  scenario.radio.sight_leak = setting.sight_leak;
  scenario.robot.radius_m = setting.radius_m;
  scenario.robot.dead_bodies = setting.dead_bodies;
  scenario.obstacles = setting.obstacles;
  const SeenBodies bodies(frame);
  world::Radio radio(scenario, frame.robots.size());
  world::Executor alone(1);
  radio.update(bodies.positions, bodies.alive, bodies.raised, alone);
  for (std::uint32_t i = 0; i < frame.robots.size(); ++i)
    for (const std::uint32_t j : radio.links(i))
      if (i < j) links.open.emplace_back(i, j);
  links.blocked = radio.blocked();
  return links;
}

}  // namespace banyan::record
