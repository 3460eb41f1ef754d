// SPDX-License-Identifier: MIT
#include "banyan/measure/course.hpp"

#include <algorithm>

#include "banyan/measure/hexadecimal.hpp"

namespace banyan::measure {
namespace {

constexpr Column<Course::Row> course_table[] = {
    column<&Course::Row::robots>("robots", "robots at the start"),
    column<&Course::Row::ticks>("ticks", "simulated ticks"),
    quantity<&Course::Row::time_s>("time_s", "simulated time", "simulated time (s)"),
    column<&Course::Row::complete>("complete",
                                   "every active target held by a living worker at once, and the tree in one piece",
                                   "complete missions (share)"),
    quantity<&Course::Row::completion_time_s>("completion_time_s", "when it was complete; empty if never",
                                              "completion time (s)"),
    quantity<&Course::Row::time_limit_s>("time_limit_s", "the run's limit", "time limit (s)"),
    ratio<&Course::Row::normalized_time>("normalized_time", "completion time / limit, 1 if never complete",
                                         "completion time / limit"),
    quantity<&Course::Row::time_bound_s>("time_bound_s", "no completion can be earlier",
                                         "lower bound of the completion time (s)"),
    ratio<&Course::Row::time_ratio>("time_ratio", "completion time / time_bound_s; empty if never complete",
                                    "completion time / lower bound"),
    {"hash", "state hash of the world at the end, hexadecimal", 0,
     [](const Course::Row& row) -> Cell { return hexadecimal(row.hash); }},
};

}  // namespace

std::span<const Column<Course::Row>> Course::columns() noexcept { return course_table; }

Course::Course(const world::World& start, Row& row) : rounding_s_(world::time_rounding_s(start.scenario())) {
  const world::Scenario& scenario = start.scenario();
  row.robots = static_cast<std::uint32_t>(start.arrived());
  row.time_limit_s = world::time_limit_s(scenario);
  for (const world::Target& target : start.targets()) {
    const double way_m =
        distance(start.positions()[target.worker], target.position) - world::target_tolerance_m(scenario);
    row.time_bound_s = std::max(row.time_bound_s, way_m / scenario.robot.wheel_limit_m_s);
  }
}

void Course::observe(const Moment& now, Row& row) const {
  ++row.ticks;
  row.time_s = now.tick.time_s;
  // A run that heals on after its limit is no longer in time.
  if (row.complete || !now.tick.complete() || row.time_s > row.time_limit_s + rounding_s_) return;
  row.complete = true;
  row.completion_time_s = row.time_s;
  row.normalized_time = row.time_s / row.time_limit_s;
}

void Course::sum_up(const Moment& end, Row& row) {
  if (row.complete && row.time_bound_s > 0.0) row.time_ratio = row.completion_time_s / row.time_bound_s;
  row.hash = end.world.hash();
}

}  // namespace banyan::measure
