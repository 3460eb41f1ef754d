// SPDX-License-Identifier: MIT
// Results as tidy tables (table.hpp).
#include "banyan/record/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "banyan/world/placement.hpp"
#include "cell.hpp"

namespace banyan::record {

namespace {

using Row = RunRow;
using measure::Tick;

// Distances that do not exist are negative in measure/; in a table they are empty.
Cell if_known(double value) { return value < 0.0 ? Cell{} : Cell{value}; }
Cell natural(std::uint64_t value) { return value; }
// What the oracle says, if it was asked.
Cell of_oracle(const measure::Run& run, const Cell& value) { return run.oracle_robots > 0 ? value : Cell{}; }

std::string hexadecimal(std::uint64_t value) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t k = 0; k < 16; ++k) text[15 - k] = digits[(value >> (4 * k)) & 15];
  return text;
}

constexpr int format_version = 1;

constexpr Column<Row> identifying_table[] = {
    {"name", "the scenario's name", 0, [](const Row& r) -> Cell { return r.id.name; }},
    {"algorithm", "mission.algorithm", 0, [](const Row& r) -> Cell { return r.id.algorithm; }},
    {"reading", "mission.reading: literal or corrected", 0, [](const Row& r) -> Cell { return r.id.reading; }},
    {"body", "robot.body: disks, box2d or linear", 0, [](const Row& r) -> Cell { return r.id.body; }},
    {"line_of_sight", "radio blocked by bodies and obstacles", 0,
     [](const Row& r) -> Cell { return r.id.line_of_sight; }},
    {"sight_leak", "share of the lines of sight past one body over which packets get through", 4,
     [](const Row& r) -> Cell { return r.id.sight_leak; }},
    {"loss", "probability that a packet is lost", 4, [](const Row& r) -> Cell { return r.id.loss; }, "packet loss"},
    {"targets", "number of targets at the start", 0, [](const Row& r) { return natural(r.id.targets); }},
    {"target_radius_m", "the farthest target from the centre of the start", 4,
     [](const Row& r) -> Cell { return r.id.target_radius_m; }, "farthest target (m)"},
    {"redundancy", "the paper's k: robots in units of sum |p| / 0.77 C", 4,
     [](const Row& r) -> Cell { return r.id.redundancy; }},
    {"range_m", "communication range C", 4, [](const Row& r) -> Cell { return r.id.range_m; }, "radio range C (m)"},
    {"tick_s", "length of a tick", 4, [](const Row& r) -> Cell { return r.id.tick_s; }, "length of a tick (s)"},
    {"seed", "of all random draws", 0, [](const Row& r) { return natural(r.id.seed); }},
    {"version", "of Banyan", 0, [](const Row& r) -> Cell { return r.id.version; }},
    {"git", "commit Banyan was built from", 0, [](const Row& r) -> Cell { return r.id.git; }},
};

constexpr Column<Row> result_table[] = {
    {"robots", "robots at the start", 0, [](const Row& r) { return natural(r.run.robots); }},
    {"ticks", "simulated ticks", 0, [](const Row& r) { return natural(r.run.ticks); }},
    {"time_s", "simulated time", 4, [](const Row& r) -> Cell { return r.run.time_s; }, "simulated time (s)"},
    {"complete", "every active target held by a living worker at once, and the tree in one piece", 0,
     [](const Row& r) -> Cell { return r.run.complete; }, "complete missions (share)"},
    {"interrupted", "stopped from outside before completion or limit", 0,
     [](const Row& r) -> Cell { return r.interrupted; }, "stopped runs (share)"},
    {"completion_time_s", "when it was complete; empty if never", 4,
     [](const Row& r) { return r.run.complete ? if_known(r.run.completion_time_s) : Cell{}; }, "completion time (s)"},
    {"time_limit_s", "the run's limit", 4, [](const Row& r) -> Cell { return r.run.time_limit_s; }, "time limit (s)"},
    {"normalized_time", "completion time / limit, 1 if never complete", 6,
     [](const Row& r) -> Cell { return r.run.normalized_time; }, "completion time / limit"},
    {"time_bound_s", "no completion can be earlier", 4, [](const Row& r) -> Cell { return r.run.time_bound_s; },
     "lower bound of the completion time (s)"},
    {"time_ratio", "completion time / time_bound_s; empty if never complete", 6,
     [](const Row& r) { return if_known(r.run.time_ratio); }, "completion time / lower bound"},
    {"held_time_ratio", "from completion on, mean share of the targets that are held; empty if never complete", 6,
     [](const Row& r) { return if_known(r.run.held_time_ratio); }, "share of targets held once complete"},
    {"unheld_time_ratio_by_death",
     "of the rest, the part from a worker's death at its target until it is held again; empty if never complete", 6,
     [](const Row& r) { return if_known(r.run.unheld_time_ratio_by_death); },
     "share of targets not held by workers' deaths"},
    {"held_ratio", "share of the active targets that are held at the end", 6,
     [](const Row& r) -> Cell { return r.run.held_ratio; }},
    {"robots_bound", "no fewer committed robots, a worker for each target among them, can connect the targets", 0,
     [](const Row& r) { return natural(r.run.robots_bound); }, "lower bound of the robots in the tree"},
    {"oracle_robots", "workers, and the fewest relays found for edges of 0.95 C; empty above 1,000 targets", 0,
     [](const Row& r) { return of_oracle(r.run, natural(r.run.oracle_robots)); }, "robots of the oracle"},
    {"oracle_exact", "no such tree has fewer relays", 0,
     [](const Row& r) { return of_oracle(r.run, r.run.oracle_exact); }, "oracle known to be best (share)"},
    {"oracle_targets", "targets at the start that the oracle holds with the robots there are", 0,
     [](const Row& r) { return of_oracle(r.run, natural(r.run.oracle_targets)); }},
    {"held_targets", "active targets held at the end by a worker that the tree joins to a root", 0,
     [](const Row& r) { return natural(r.run.held_targets); }},
    {"missed_targets", "the other active targets, by index, each with the reason", 0,
     [](const Row& r) -> Cell { return r.run.missed_targets; }},
    {"oracle_time_s",
     "when straight drives can be over, the oracle's relays placed; empty if robots are too few or too many", 4,
     [](const Row& r) { return if_known(r.run.oracle_time_s); }, "time of the oracle (s)"},
    {"steiner_length_m", "length of a shortest network of the targets, certified from below", 4,
     [](const Row& r) -> Cell { return r.run.steiner_length_m; }, "shortest network (m)"},
    {"star_length_m", "length of the shortest star of the targets, from their geometric median", 4,
     [](const Row& r) -> Cell { return r.run.star_length_m; }, "shortest star (m)"},
    {"committed", "robots in the tree at the end", 0, [](const Row& r) { return natural(r.run.committed); },
     "robots in the tree at the end"},
    {"mean_committed", "mean over ticks", 4, [](const Row& r) -> Cell { return r.run.mean_committed; },
     "robots in the tree, mean over time"},
    {"committed_ratio", "committed / robots_bound", 6, [](const Row& r) -> Cell { return r.run.committed_ratio; },
     "robots in the tree / lower bound"},
    {"oracle_ratio", "committed / oracle_robots", 6, [](const Row& r) { return of_oracle(r.run, r.run.oracle_ratio); },
     "robots in the tree / oracle's"},
    {"deployment_ratio", "most robots in the tree in a tick up to completion / robots_bound", 6,
     [](const Row& r) -> Cell { return r.run.deployment_ratio; }, "most in the tree, deploying / lower bound"},
    {"link_redundancy", "mission.link_redundancy, k", 0, [](const Row& r) { return natural(r.run.link_redundancy); }},
    {"redundancy_bound", "no fewer robots, a worker for each target among them, join the targets by k disjoint paths",
     0, [](const Row& r) { return natural(r.run.redundancy_bound); }},
    {"redundancy_exact", "a network with as few exists", 0,
     [](const Row& r) -> Cell { return r.run.redundancy_exact; }},
    {"companions", "spares that stand beside a robot of the tree at the end", 0,
     [](const Row& r) { return natural(r.run.companions); }},
    {"redundancy_ratio", "(committed + companions) / redundancy_bound", 6,
     [](const Row& r) -> Cell { return r.run.redundancy_ratio; }, "robots with companions / bound for k paths"},
    {"redundant_time_ratio",
     "from a drive (C / v_max) after completion on, share of ticks with k disjoint paths; empty if k is 1", 6,
     [](const Row& r) { return if_known(r.run.redundant_time_ratio); }, "time with k disjoint paths (share)"},
    {"severed_ticks", "of these, with living workers or the root cut off from each other", 0,
     [](const Row& r) { return natural(r.run.severed_ticks); }},
    {"restored_s", "from the last death until there were k disjoint paths; empty if there never were", 4,
     [](const Row& r) { return if_known(r.run.restored_s); }},
    {"redundant_targets", "active targets with k disjoint paths to the root at the end; 0 if k is 1", 0,
     [](const Row& r) { return natural(r.run.redundant_targets); }},
    {"network_length_m", "edges from living robots of the tree to their living parents, at the end", 4,
     [](const Row& r) -> Cell { return r.run.network_length_m; }, "length of the tree (m)"},
    {"broken_ticks", "ticks with a broken tree edge", 0, [](const Row& r) { return natural(r.run.broken_ticks); },
     "ticks with a broken edge"},
    {"broken_ticks_by_distance", "with an edge of C or longer", 0,
     [](const Row& r) { return natural(r.run.broken_ticks_by_distance); }, "ticks with an edge too long"},
    {"broken_ticks_by_occlusion", "with an edge in range but without line of sight", 0,
     [](const Row& r) { return natural(r.run.broken_ticks_by_occlusion); }, "ticks with a hidden edge"},
    {"broken_ticks_by_death", "with an edge to a dead robot", 0,
     [](const Row& r) { return natural(r.run.broken_ticks_by_death); }, "ticks with an edge to a dead robot"},
    {"disconnected_time_ratio", "broken_ticks / ticks", 6,
     [](const Row& r) -> Cell { return r.run.disconnected_time_ratio; }, "share of time with a broken edge"},
    {"disconnected_time_ratio_by_distance", "the same by distance", 6,
     [](const Row& r) -> Cell { return r.run.disconnected_time_ratio_by_distance; },
     "share of time with an edge too long"},
    {"disconnected_time_ratio_by_occlusion", "the same by occlusion", 6,
     [](const Row& r) -> Cell { return r.run.disconnected_time_ratio_by_occlusion; },
     "share of time with a hidden edge"},
    {"liveness_period_s", "I: a neighbour not heard for longer counts as gone", 4,
     [](const Row& r) -> Cell { return r.run.liveness_period_s; }},
    {"broken_ticks_after_silence", "with an edge broken for longer than liveness_period_s without a break", 0,
     [](const Row& r) { return natural(r.run.broken_ticks_after_silence); }},
    {"disconnected_time_ratio_after_silence", "broken_ticks_after_silence / ticks", 6,
     [](const Row& r) -> Cell { return r.run.disconnected_time_ratio_after_silence; }},
    {"start_parts", "into which the robots fall at the start, over links of which both ends hear each other", 0,
     [](const Row& r) { return natural(r.run.start_parts); }, "parts of the network at the start"},
    {"split_ticks", "ticks with several radio components", 0, [](const Row& r) { return natural(r.run.split_ticks); },
     "ticks with a split network"},
    {"split_ticks_by_distance", "the same without occlusion", 0,
     [](const Row& r) { return natural(r.run.split_ticks_by_distance); },
     "ticks with a split network, occlusion aside"},
    {"fiedler_time_ratio", "share of ticks with lambda_2 < 1e-3", 6,
     [](const Row& r) -> Cell { return r.run.fiedler_time_ratio; }, "share of time with λ₂ < 0.001"},
    {"fiedler_time_ratio_by_distance", "the same without occlusion", 6,
     [](const Row& r) -> Cell { return r.run.fiedler_time_ratio_by_distance; },
     "share of time with λ₂ < 0.001, occlusion aside"},
    {"two_roots_ticks", "ticks with more than one living root", 0,
     [](const Row& r) { return natural(r.run.two_roots_ticks); }, "ticks with two roots"},
    {"longest_two_roots_s", "the longest time of that without a break", 4,
     [](const Row& r) -> Cell { return r.run.longest_two_roots_s; }, "longest time with two roots (s)"},
    {"insertions", "spares inserted into edges", 0, [](const Row& r) { return natural(r.run.insertions); }},
    {"handovers", "times the root role was handed over", 0, [](const Row& r) { return natural(r.run.handovers); }},
    {"repairs", "lost parents replaced and orphans re-attached", 0,
     [](const Row& r) { return natural(r.run.repairs); }},
    {"elections", "times a robot made itself root because the root had fallen silent", 0,
     [](const Row& r) { return natural(r.run.elections); }},
    {"replacements", "times a robot took over the target of a silent worker", 0,
     [](const Row& r) { return natural(r.run.replacements); }},
    {"epochs", "the highest epoch reached", 0, [](const Row& r) { return natural(r.run.epochs); }},
    {"start_phase_ticks", "mean length of START", 4, [](const Row& r) -> Cell { return r.run.start_phase_ticks; },
     "phase START (ticks)"},
    {"select_phase_ticks", "mean length of SELECT PARENT", 4,
     [](const Row& r) -> Cell { return r.run.select_phase_ticks; }, "phase SELECT PARENT (ticks)"},
    {"bytes_per_robot_s", "broadcast", 4, [](const Row& r) -> Cell { return r.run.bytes_per_robot_s; },
     "bytes per robot and second"},
    {"messages", "broadcast by all robots", 0, [](const Row& r) { return natural(r.run.messages); }},
    {"decisions", "times a living robot has changed its role, parent or served target", 0,
     [](const Row& r) { return natural(r.run.decisions); }},
    {"driven_m", "the way of a robot, mean over the robots at the start", 4,
     [](const Row& r) -> Cell { return r.run.driven_m; }, "metres driven per robot"},
    {"overlap_ticks", "in which bodies of living robots overlap; empty unless robot.body is linear", 0,
     [](const Row& r) {
       return r.run.overlap_ticks < 0 ? Cell{} : natural(static_cast<std::uint64_t>(r.run.overlap_ticks));
     },
     "ticks with bodies that overlap"},
    {"least_charge", "of any living robot at any time, as a share of a full battery; empty without batteries", 4,
     [](const Row& r) { return if_known(r.run.least_charge); }},
    {"mean_charge", "of the living at the end; empty without batteries", 4,
     [](const Row& r) { return if_known(r.run.mean_charge); }},
    {"swaps", "robots of the tree with little charge that were relieved", 0,
     [](const Row& r) { return natural(r.run.swaps); }},
    {"broken_swaps", "of these, with a broken edge to either robot meanwhile", 0,
     [](const Row& r) { return natural(r.run.broken_swaps); }},
    {"trips", "of spares to charging places, until they were charged or died", 0,
     [](const Row& r) { return natural(r.run.trips); }},
    {"trips_arrived", "of these, those that ended in a slot", 0,
     [](const Row& r) { return natural(r.run.trips_arrived); }},
    {"emptied", "robots that died for want of charge", 0, [](const Row& r) { return natural(r.run.emptied); }},
    {"lasts_s", "the charge is used up so long after the end at most; empty if it is not, or without batteries", 4,
     [](const Row& r) { return if_known(r.run.lasts_s); }},
    {"deaths", "robots that died", 0, [](const Row& r) { return natural(r.run.deaths); }},
    {"survivors", "robots alive at the end", 0, [](const Row& r) { return natural(r.run.survivors); }},
    {"last_death_s", "when the last of them died; empty if none did", 4,
     [](const Row& r) { return if_known(r.run.last_death_s); }, "last death (s)"},
    {"recovered", "whole again within 20 drives (C / v_max) of the last death, and without a break for 2 or settle_s",
     0, [](const Row& r) -> Cell { return r.run.recovered; }, "recovered networks (share)"},
    {"recovery_time_s", "from the last death until then; empty if not recovered", 4,
     [](const Row& r) { return if_known(r.run.recovery_time_s); }, "recovery time (s)"},
    {"lost_holders", "workers that died at their targets", 0, [](const Row& r) { return natural(r.run.lost_holders); },
     "workers that died at their targets"},
    {"held_again_s", "from then until such a target was held again, median; empty if none was lost or half never were",
     4, [](const Row& r) { return if_known(r.run.held_again_s); }, "target held again after (s, median)"},
    {"survivors_suffice", "as many as the bound for the targets active at the end", 0,
     [](const Row& r) -> Cell { return r.run.survivors_suffice; }, "enough survivors (share)"},
    {"hash", "state hash of the world at the end, hexadecimal", 0,
     [](const Row& r) -> Cell { return hexadecimal(r.run.hash); }},
    {"format_version", "of this table", 0, [](const Row&) { return natural(format_version); }},
};

template <std::size_t a, std::size_t b>
constexpr std::array<Column<Row>, a + b> joined(const Column<Row> (&first)[a], const Column<Row> (&second)[b]) {
  std::array<Column<Row>, a + b> all{};
  std::copy(std::begin(first), std::end(first), all.begin());
  std::copy(std::begin(second), std::end(second), all.begin() + a);
  return all;
}
constexpr auto run_table = joined(identifying_table, result_table);

constexpr Column<Tick> series_table[] = {
    {"tick", "number of the tick", 0, [](const Tick& t) { return natural(t.tick); }},
    {"time_s", "tick times tick_s", 4, [](const Tick& t) -> Cell { return t.time_s; }},
    {"alive", "living robots", 0, [](const Tick& t) { return natural(t.alive); }},
    {"roots", "living roots", 0, [](const Tick& t) { return natural(t.roots); }},
    {"workers", "living workers", 0, [](const Tick& t) { return natural(t.workers); }},
    {"connectors", "living connectors", 0, [](const Tick& t) { return natural(t.connectors); }},
    {"spares", "living spares", 0, [](const Tick& t) { return natural(t.spares); }},
    {"committed", "alive and no spare", 0, [](const Tick& t) { return natural(t.committed); }},
    {"edges", "tree edges: parent and old parent of every robot that is no spare", 0,
     [](const Tick& t) { return natural(t.edges); }},
    {"broken_by_distance", "of these, of C or longer", 0, [](const Tick& t) { return natural(t.broken_by_distance); }},
    {"broken_by_occlusion", "of these, in range but without line of sight", 0,
     [](const Tick& t) { return natural(t.broken_by_occlusion); }},
    {"broken_after_silence", "tree edges broken for longer than I without a break, to dead robots too", 0,
     [](const Tick& t) { return natural(t.broken_after_silence); }},
    {"components", "of the radio graph of the living robots", 0, [](const Tick& t) { return natural(t.components); }},
    {"components_by_distance", "the same without occlusion", 0,
     [](const Tick& t) { return natural(t.components_by_distance); }},
    {"fiedler_low", "lambda_2 < 1e-3", 0, [](const Tick& t) -> Cell { return t.fiedler_low; }},
    {"fiedler_low_by_distance", "the same without occlusion", 0,
     [](const Tick& t) -> Cell { return t.fiedler_low_by_distance; }},
    {"fiedler", "lambda_2; empty if not computed at this tick", 9, [](const Tick& t) { return if_known(t.fiedler); }},
    {"worst_target_distance_m", "largest distance of an active target to the nearest worker that serves it", 4,
     [](const Tick& t) -> Cell { return t.worst_target_distance_m; }},
    {"targets_reached", "active targets held by a living worker", 0,
     [](const Tick& t) { return natural(t.targets_reached); }},
    {"least_charge", "of the living, as a share of a full battery; empty without batteries", 4,
     [](const Tick& t) { return if_known(t.least_charge); }},
    {"mean_charge", "of the living; empty without batteries", 4, [](const Tick& t) { return if_known(t.mean_charge); }},
};

void write_csv_field(Text& out, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) return out.put(field);
  out.put('"');
  for (const char c : field) {
    if (c == '"') out.put('"');
    out.put(c);
  }
  out.put('"');
}

template <class Columns> std::string header_of(const Columns& columns) {
  std::string line;
  for (const auto& column : columns) {
    if (!line.empty()) line += ',';
    line += column.name;
  }
  return line;
}

template <class Columns, class RowType> void write_row(Text& out, const Columns& columns, const RowType& row) {
  for (const auto& column : columns) {
    write_cell_csv(out, column.cell(row), column.decimals);
    out.put(',');
  }
  out.drop_last();
}

std::string_view body_name(world::BodyModel body) noexcept {
  switch (body) {
    case world::BodyModel::disks: return "disks";
    case world::BodyModel::box2d: return "box2d";
    case world::BodyModel::linear: return "linear";
  }
  return "?";
}

}  // namespace

void write_cell_csv(Text& out, const Cell& cell, int decimals) {
  if (const auto* flag = std::get_if<bool>(&cell)) return out.put(*flag ? "true" : "false");
  if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return out.natural(*whole);
  if (const auto* real = std::get_if<double>(&cell)) return out.fixed(*real, decimals, "");
  if (const auto* text = std::get_if<std::string>(&cell)) return write_csv_field(out, *text);
}

void write_cell_json(Text& out, const Cell& cell, int decimals) {
  if (const auto* flag = std::get_if<bool>(&cell)) return out.put(*flag ? "true" : "false");
  if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return out.natural(*whole);
  if (const auto* real = std::get_if<double>(&cell)) return out.fixed(*real, decimals);
  if (const auto* text = std::get_if<std::string>(&cell)) return out.json_string(*text);
  out.put("null");
}

Identification identify(const world::Scenario& scenario, std::string_view version, std::string_view git) {
  Identification id;
  id.name = scenario.name;
  id.algorithm = scenario.mission.algorithm;
  id.reading = scenario.mission.reading;
  id.body = body_name(scenario.robot.body);
  id.line_of_sight = scenario.radio.line_of_sight;
  id.sight_leak = scenario.radio.sight_leak;
  id.loss = scenario.radio.loss;
  const std::vector<Vec2> targets = world::target_positions(scenario);
  id.targets = targets.size();
  double sum_m = 0.0;
  for (const Vec2& target : targets) {
    const double far_m = distance(scenario.swarm.start.center, target);
    sum_m += far_m;
    id.target_radius_m = std::max(id.target_radius_m, far_m);
  }
  const double given = static_cast<double>(scenario.swarm.robots.value_or(0)) * world::redundancy_edge_m(scenario);
  id.redundancy = !scenario.swarm.robots ? scenario.swarm.redundancy : sum_m > 0.0 ? given / sum_m : 0.0;
  id.range_m = scenario.radio.range_m;
  id.tick_s = scenario.tick_s;
  id.seed = scenario.seed;
  id.version = version;
  id.git = git;
  return id;
}

std::span<const Column<RunRow>> run_columns() noexcept { return run_table; }
std::span<const Column<RunRow>> result_columns() noexcept { return result_table; }
std::span<const Column<measure::Tick>> series_columns() noexcept { return series_table; }

std::string run_csv_header() { return header_of(run_columns()); }
std::string series_csv_header() { return header_of(series_columns()); }

std::string run_csv_row(const RunRow& row) {
  Text line;
  write_row(line, run_columns(), row);
  return std::string(line.view());
}

std::string series_csv_row(const measure::Tick& tick) {
  Text line;
  write_row(line, series_columns(), tick);
  return std::string(line.view());
}

std::string run_json(const RunRow& row, std::string_view config_json) {
  Text out;
  out.put("{\n  \"format\": \"banyan.run\",\n  \"format_version\": ");
  out.natural(format_version);
  out.put(",\n  \"result\": {");
  for (const auto& column : run_columns()) {
    out.put("\n    \"");
    out.put(column.name);
    out.put("\": ");
    write_cell_json(out, column.cell(row), column.decimals);
    out.put(',');
  }
  out.drop_last();
  out.put("\n  },\n  \"config\": ");
  // Text that is not JSON must not make the whole file unreadable.
  if (nlohmann::json::accept(config_json)) {
    out.put(config_json.substr(0, config_json.find_last_not_of(" \n\r\t") + 1));
  } else {
    out.json_string(config_json);
  }
  out.put("\n}\n");
  return std::string(out.view());
}

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted) {
      if (c != '"') cells.back() += c;
      else if (i + 1 < line.size() && line[i + 1] == '"') cells.back() += line[++i];
      else quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::optional<std::vector<std::string>> run_cells(std::string_view row) {
  std::vector<std::string> cells = csv_cells(row);
  if (cells.size() != run_table.size() || cells.back() != std::to_string(format_version)) return std::nullopt;
  return cells;
}

std::string csv_quoted(std::string_view field) {
  Text out;
  write_csv_field(out, field);
  return std::string(out.view());
}

std::string json_quoted(std::string_view text) {
  Text out;
  out.json_string(text);
  return std::string(out.view());
}

void write_run_csv(const std::string& path, const RunRow& row, Existing existing) {
  write_file(path, run_csv_header() + "\n" + run_csv_row(row) + "\n", existing);
}

void write_run_json(const std::string& path, const RunRow& row, std::string_view config_json, Existing existing) {
  write_file(path, run_json(row, config_json), existing);
}

}  // namespace banyan::record
