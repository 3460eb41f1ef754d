// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include <algorithm>
#include <cinttypes>
#include <cmath>

#include "banyan/measure/recovery.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

std::string verdict(const record::RunRow& row, const SummaryExtras& extras) {
  const auto& run = row.run;
  if (run.complete) return format("COMPLETE after %.1f s", run.completion_time_s);
  std::string reached = format("%zu of %zu targets reached", extras.targets_reached, extras.targets);
  if (extras.targets_reached == extras.targets && extras.tree_parts != 1)
    reached +=
        extras.tree_parts == 0 ? ", but there is no root" : format(", but the tree is in %zu parts", extras.tree_parts);
  if (row.interrupted) return format("STOPPED at %.1f s: ", run.time_s) + reached;
  return format("NOT COMPLETE within %.1f s: ", run.time_limit_s) + reached;
}

std::string time_text(const measure::Run& run) {
  std::string text =
      format("%.1f s of the limit of %.1f s", run.complete ? run.completion_time_s : run.time_s, run.time_limit_s);
  if (run.complete) text += format(" (normalised %.3f)", run.normalized_time);
  return text + format("; no swarm could do it in less than %.1f s", run.time_bound_s);
}

std::string tree_text(const measure::Run& run) {
  if (run.broken_ticks == 0) return "no edge broken in any of " + plural(run.ticks, "tick");
  std::string text =
      format("some edge broken in %s of %s (%.2f %%): by distance %s, by occlusion %s",
             grouped(static_cast<double>(run.broken_ticks)).c_str(), plural(run.ticks, "tick").c_str(),
             100.0 * run.disconnected_time_ratio, grouped(static_cast<double>(run.broken_ticks_by_distance)).c_str(),
             grouped(static_cast<double>(run.broken_ticks_by_occlusion)).c_str());
  if (run.broken_ticks_by_death > 0) text += ", by death " + grouped(static_cast<double>(run.broken_ticks_by_death));
  return text;
}

std::string network_text(const measure::Run& run, bool line_of_sight) {
  const bool split = run.split_ticks > 0 || run.split_ticks_by_distance > 0;
  std::string text = split ? "split in " + plural(run.split_ticks, "tick") : "in one piece at every tick";
  if (split && line_of_sight)
    text +=
        format(" (%s if nothing blocked the radio)", grouped(static_cast<double>(run.split_ticks_by_distance)).c_str());
  if (run.start_parts > 1)
    text += format("; at the start in %u parts by links of which both ends hear each other", run.start_parts);
  return text;
}

std::string robots_text(const measure::Run& run) {
  std::string text = format("%u of %u committed; at least %u are needed", run.committed, run.robots, run.robots_bound);
  if (run.robots_bound > 0)
    text += format(" (%.2f times the bound)", static_cast<double>(run.committed) / run.robots_bound);
  if (run.oracle_robots > 0)
    text += format(", an oracle has %s%u (%.2f times)", run.oracle_exact ? "" : "at most ", run.oracle_robots,
                   run.oracle_ratio);
  return text;
}

// The first few of what is separated by commas, and how many more there are.
std::string first_few(const std::string& list) {
  constexpr int few = 8;
  std::size_t end = 0;
  for (int k = 0; k < few && end != std::string::npos; ++k) end = list.find(", ", k == 0 ? 0 : end + 1);
  if (end == std::string::npos) return list;
  const auto more = std::count(list.begin() + static_cast<std::ptrdiff_t>(end), list.end(), ',');
  return list.substr(0, end) + format(" and %td more (run.json)", more);
}

std::string targets_text(const measure::Run& run, std::size_t targets) {
  std::string text = format("%u of %zu held in the end", run.held_targets, targets);
  if (!run.missed_targets.empty()) text += "; not: " + first_few(run.missed_targets);
  if (run.oracle_robots > 0 && run.oracle_targets < targets)
    text += format("; %u robots are too few: an oracle holds %u with them, and needs %u for all (swarm.robots)",
                   run.robots, run.oracle_targets, run.oracle_robots);
  return text;
}

std::string paths_text(const measure::Run& run) {
  const std::string wanted = plural(run.link_redundancy, "disjoint path");
  std::string text =
      run.redundant_time_ratio < 0.0
          ? wanted + " asked for"
          : format("%s between targets and root for %.2f %% of the time from a drive after completion on",
                   wanted.c_str(), 100.0 * run.redundant_time_ratio);
  text += "; " + plural(run.companions, "companion");
  if (!run.single_targets.empty()) text += "; in the end fewer to targets " + run.single_targets;
  return text;
}

// Only where something was lost: most deaths cost no target anything.
std::string lost_time_text(const measure::Run& run) {
  if (run.unheld_time_ratio_by_death <= 0.0) return {};
  const double unheld = 1.0 - run.held_time_ratio;
  return format("targets not held for %.2f %% of the time once complete, %.2f %% by their own workers' deaths; ",
                100.0 * unheld, 100.0 * run.unheld_time_ratio_by_death);
}

std::string deaths_text(const measure::Run& run, double drive_s) {
  std::string text =
      format("%u of %s died, the last at %.1f s; ", run.deaths, plural(run.robots, "robot").c_str(), run.last_death_s);
  if (run.held_again_s >= 0.0)
    text += format("%s lost a worker, held again after %.1f s (median); ", plural(run.lost_holders, "target").c_str(),
                   run.held_again_s);
  text += lost_time_text(run);
  if (run.recovered) return text + format("whole again %.1f s later", run.recovery_time_s);
  const double watched_s = std::min(run.time_s - run.last_death_s, measure::recovery_limit_drives * drive_s);
  text += format("not whole again in the %.1f s after it", watched_s);
  return run.survivors_suffice ? text : text + format("; the %u left are too few for the targets", run.survivors);
}

std::string power_text(const measure::Run& run) {
  std::string text = format(
      "at least %.0f %% in every living robot, %.0f %% on average at the end; %s, %s with a broken edge; %s of %s to a "
      "charging place arrived",
      100.0 * run.least_charge, 100.0 * run.mean_charge, plural(run.swaps, "swap").c_str(),
      grouped(static_cast<double>(run.broken_swaps)).c_str(), grouped(static_cast<double>(run.trips_arrived)).c_str(),
      plural(run.trips, "trip").c_str());
  if (run.emptied > 0) text += "; " + plural(run.emptied, "robot") + " ran down";
  if (run.lasts_s >= 0.0)
    text += format("; fewer are charged than it takes: the swarm lasts for another %.0f s at most", run.lasts_s);
  return text;
}

std::string work_text(const measure::Run& run) {
  std::string text = plural(run.insertions, "insertion") + ", " + plural(run.handovers, "hand-over") +
                     " of the root, " + plural(run.repairs, "repair") + ", " + plural(run.epochs, "tree") + " grown";
  if (run.elections > 0) text += ", " + plural(run.elections, "root") + " elected";
  if (run.replacements > 0) text += ", " + plural(run.replacements, "worker") + " replaced";
  return text;
}

std::string refused_text(const measure::Run& run) {
  const bool one = run.rejected_by.find(',') == std::string::npos;
  return plural(run.rejected, "impossible reading") + ", by " + (one ? "robot " : "robots ") +
         first_few(run.rejected_by);
}

std::string computing_text(const measure::Run& run, const SummaryExtras& extras) {
  const double steps = static_cast<double>(run.ticks) * run.robots / std::max(extras.wall_s, 1e-9);
  std::string text =
      summary_line("speed", format("%.2f s of computing, %s robot-steps per second, %d %s", extras.wall_s,
                                   grouped(steps).c_str(), extras.threads, extras.threads == 1 ? "thread" : "threads"));
  return text + summary_line("hash", format("%016" PRIx64 " (the same for the same scenario and seed, on any machine)",
                                            run.hash));
}

}  // namespace

std::string summary_text(const record::RunRow& row, const Configuration& configuration, const RunOutputs& outputs,
                         const SummaryExtras& extras) {
  const auto& run = row.run;
  const auto& scenario = configuration.scenario;
  std::string text = scenario.name + ": " + verdict(row, extras) + "\n\n";
  text += summary_line("algorithm", format("%s (%s), %u robots, %zu targets, seed %" PRIu64, row.id.algorithm.c_str(),
                                           row.id.reading.c_str(), run.robots, extras.targets, row.id.seed));
  text += summary_line("time", time_text(run));
  text += summary_line("tree", tree_text(run));
  text += summary_line("network", network_text(run, scenario.radio.line_of_sight));
  text += summary_line("robots", robots_text(run));
  if (!run.complete) text += summary_line("targets", targets_text(run, extras.targets));
  if (run.link_redundancy > 1) text += summary_line("paths", paths_text(run));
  if (scenario.battery.on()) text += summary_line("charge", power_text(run));
  if (run.deaths > 0) text += summary_line("deaths", deaths_text(run, world::drive_s(scenario)));
  text += summary_line("work", work_text(run));
  text += summary_line("radio", format("%.0f bytes per robot and second", run.bytes_per_robot_s));
  if (run.overlap_ticks > 0)
    text += summary_line("bodies", "overlap in " + plural(static_cast<std::uint64_t>(run.overlap_ticks), "tick") +
                                       ": robot.body = \"linear\" has no contacts");
  if (run.rejected > 0) text += summary_line("refused", refused_text(run));
  text += extras.remarks.empty() ? computing_text(run, extras) : extras.remarks;
  text += "\nResults in " + outputs.directory() + "/\n";
  for (const record::OutputFormat* kept : extras.written) {
    const bool recording = kept->key == "record";
    const std::string more = recording ? "; opens in Foxglove and Lichtblick, or draw a moment of it:" : "";
    text += summary_line(std::string(kept->file).c_str(), std::string(kept->what) + more);
    if (recording) {
      text += summary_line(
          "", format("banyan draw %s --at %.0f -o frame.svg", outputs.path(*kept).c_str(), std::floor(run.time_s / 2)));
    }
  }
  return text;
}

}  // namespace banyan::cli
