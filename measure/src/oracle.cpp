// SPDX-License-Identifier: MIT
#include "banyan/measure/oracle.hpp"

#include <algorithm>

#include "banyan/measure/bottleneck.hpp"
#include "banyan/measure/metrics.hpp"
#include "banyan/measure/relays.hpp"
#include "banyan/measure/steiner.hpp"

namespace banyan::measure {
namespace {

// What the oracle says, if it was asked.
template <auto field> Cell if_asked(const Oracle::Row& row) {
  return row.oracle_robots > 0 ? cell_of<field>(row) : Cell{};
}

constexpr Column<Oracle::Row> oracle_table[] = {
    column<&Oracle::Row::robots_bound>(
        "robots_bound", "no fewer committed robots, a worker for each target among them, can connect the targets",
        "lower bound of the robots in the tree"),
    {"oracle_robots", "workers, and the fewest relays found for edges of 0.95 C; empty above 1,000 targets", 0,
     if_asked<&Oracle::Row::oracle_robots>, "robots of the oracle"},
    {"oracle_exact", "no such tree has fewer relays", 0, if_asked<&Oracle::Row::oracle_exact>,
     "oracle known to be best (share)"},
    {"oracle_targets", "targets at the start that the oracle holds with the robots there are", 0,
     if_asked<&Oracle::Row::oracle_targets>},
    quantity<&Oracle::Row::oracle_time_s>(
        "oracle_time_s",
        "when straight drives can be over, the oracle's relays placed; empty if robots are too few or too many",
        "time of the oracle (s)"),
    quantity<&Oracle::Row::steiner_length_m>("steiner_length_m",
                                             "length of a shortest network of the targets, certified from below",
                                             "shortest network (m)"),
    quantity<&Oracle::Row::star_length_m>("star_length_m",
                                          "length of the shortest star of the targets, from their geometric median",
                                          "shortest star (m)"),
    column<&Oracle::Row::survivors_suffice>(
        "survivors_suffice", "as many as the bound for the targets active at the end", "enough survivors (share)"),
};

std::vector<world::Vec2> active_positions(const world::World& world) {
  std::vector<world::Vec2> positions;
  for (const world::Target& target : world.targets())
    if (target.active) positions.push_back(target.position);
  return positions;
}

std::vector<world::Vec2> unsent_positions(const world::World& world) {
  std::vector<char> sent(world.size(), 0);
  for (const world::Target& target : world.targets()) sent[target.worker] = 1;
  std::vector<world::Vec2> positions;
  for (std::size_t i = 0; i < world.size(); ++i)
    if (sent[i] == 0) positions.push_back(world.positions()[i]);
  return positions;
}

}  // namespace

std::span<const Column<Oracle::Row>> Oracle::columns() noexcept { return oracle_table; }

Oracle::Oracle(const world::World& start, Row& row)
    : range_m_(start.scenario().radio.range_m),
      tolerance_m_(world::target_tolerance_m(start.scenario())),
      speed_m_s_(start.scenario().robot.wheel_limit_m_s),
      targets_(active_positions(start)),
      others_(unsent_positions(start)) {
  row.steiner_length_m = steiner_length(targets_).lower_m;
  row.star_length_m = star_length(targets_);
  row.robots_bound = robots_bound(targets_, tolerance_m_, range_m_);
}

// The fewest robots, and the least time in which all workers and, from the nearest starts, relays can be at their
// places. Asked once, at the end, since no tick needs it. It takes milliseconds with few targets and some seconds with
// a thousand; with more it is not asked. Without any relay a root is needed beside the workers, which has no place of
// its own.
void Oracle::ask(const Moment& end) {
  constexpr double edge_share = 0.95;
  constexpr std::size_t most = 1'000;
  asked_ = true;
  if (targets_.size() > most) return;
  const RelayTree tree = fewest_relays(targets_, edge_share * range_m_);
  const std::size_t relays = std::max<std::size_t>(1, tree.relays.size());
  const auto targets = static_cast<std::uint32_t>(targets_.size());
  answer_.oracle_robots = targets + static_cast<std::uint32_t>(relays);
  answer_.oracle_exact = tree.exact;
  answer_.oracle_targets =
      end.run.robots >= answer_.oracle_robots ? targets : most_targets(targets_, edge_share * range_m_, end.run.robots);
  if (others_.size() < relays) return;
  const double longest_m = bottleneck_m(others_, tree.relays);
  if (longest_m >= 0.0) answer_.oracle_time_s = std::max(end.run.time_bound_s, longest_m / speed_m_s_);
}

void Oracle::sum_up(const Moment& end, Row& row) {
  if (!asked_) ask(end);
  row.oracle_robots = answer_.oracle_robots;
  row.oracle_exact = answer_.oracle_exact;
  row.oracle_targets = answer_.oracle_targets;
  row.oracle_time_s = answer_.oracle_time_s;
  const std::vector<world::Vec2> targets = active_positions(end.world);
  const std::uint32_t bound = targets == targets_ ? row.robots_bound : robots_bound(targets, tolerance_m_, range_m_);
  row.survivors_suffice = end.tick.alive >= bound;
}

}  // namespace banyan::measure
