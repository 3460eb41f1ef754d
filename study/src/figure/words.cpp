// SPDX-License-Identifier: MIT
// What figures call things (words.hpp).
#include "words.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

namespace banyan::study {

namespace {

constexpr std::pair<std::string_view, std::string_view> metric_words[] = {
    {"loss", "packet loss"},
    {"target_radius_m", "farthest target (m)"},
    {"range_m", "radio range C (m)"},
    {"tick_s", "length of a tick (s)"},
    {"time_s", "simulated time (s)"},
    {"complete", "complete missions (share)"},
    {"interrupted", "stopped runs (share)"},
    {"completion_time_s", "completion time (s)"},
    {"time_limit_s", "time limit (s)"},
    {"normalized_time", "completion time / limit"},
    {"time_bound_s", "lower bound of the completion time (s)"},
    {"time_ratio", "completion time / lower bound"},
    {"held_time_ratio", "share of targets held once complete"},
    {"robots_bound", "lower bound of the robots in the tree"},
    {"oracle_robots", "robots of the oracle"},
    {"redundancy_ratio", "robots with companions / bound for k paths"},
    {"redundant_time_ratio", "time with k disjoint paths (share)"},
    {"oracle_exact", "oracle known to be best (share)"},
    {"oracle_time_s", "time of the oracle (s)"},
    {"steiner_length_m", "shortest network (m)"},
    {"star_length_m", "shortest star (m)"},
    {"committed", "robots in the tree at the end"},
    {"mean_committed", "robots in the tree, mean over time"},
    {"committed_ratio", "robots in the tree / lower bound"},
    {"oracle_ratio", "robots in the tree / oracle's"},
    {"deployment_ratio", "most in the tree, deploying / lower bound"},
    {"network_length_m", "length of the tree (m)"},
    {"broken_ticks", "ticks with a broken edge"},
    {"broken_ticks_by_distance", "ticks with an edge too long"},
    {"broken_ticks_by_occlusion", "ticks with a hidden edge"},
    {"broken_ticks_by_death", "ticks with an edge to a dead robot"},
    {"disconnected_time_ratio", "share of time with a broken edge"},
    {"disconnected_time_ratio_by_distance", "share of time with an edge too long"},
    {"disconnected_time_ratio_by_occlusion", "share of time with a hidden edge"},
    {"start_parts", "parts of the network at the start"},
    {"split_ticks", "ticks with a split network"},
    {"split_ticks_by_distance", "ticks with a split network, occlusion aside"},
    {"fiedler_time_ratio", "share of time with λ₂ < 0.001"},
    {"fiedler_time_ratio_by_distance", "share of time with λ₂ < 0.001, occlusion aside"},
    {"two_roots_ticks", "ticks with two roots"},
    {"longest_two_roots_s", "longest time with two roots (s)"},
    {"start_phase_ticks", "phase START (ticks)"},
    {"select_phase_ticks", "phase SELECT PARENT (ticks)"},
    {"bytes_per_robot_s", "bytes per robot and second"},
    {"driven_m", "metres driven per robot"},
    {"last_death_s", "last death (s)"},
    {"recovered", "recovered networks (share)"},
    {"recovery_time_s", "recovery time (s)"},
    {"lost_holders", "workers that died at their targets"},
    {"held_again_s", "target held again after (s, median)"},
    {"survivors_suffice", "enough survivors (share)"},
};

constexpr std::pair<std::string_view, std::string_view> units[] = {{"_m_s", "m/s"}, {"_rad_s", "rad/s"}, {"_m", "m"},
                                                                   {"_s", "s"},     {"_deg", "°"},       {"_cm", "cm"}};

bool is_number(std::string_view text) {
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size();
}

}  // namespace

std::string words_of_name(std::string_view name) {
  std::string unit;
  for (const auto& [suffix, words] : units) {
    if (!unit.empty() || !name.ends_with(suffix) || name.size() == suffix.size()) continue;
    unit = " (" + std::string(words) + ")";
    name.remove_suffix(suffix.size());
  }
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text + unit;
}

std::string words_of_metric(std::string_view metric) {
  const auto* at = std::find_if(std::begin(metric_words), std::end(metric_words),
                                [&](const auto& entry) { return entry.first == metric; });
  return at == std::end(metric_words) ? words_of_name(metric) : std::string(at->second);
}

std::string with_value(std::string_view title, std::string_view label) {
  const std::string name(title), value(label);
  if (label == "on" || label == "off") return name + " " + value;
  if (!is_number(label)) return name + ": " + value;
  const std::size_t bracket = name.rfind(" (");
  if (bracket == std::string::npos || !name.ends_with(')')) return name + " = " + value;
  const std::string unit = name.substr(bracket + 2, name.size() - bracket - 3);
  return name.substr(0, bracket) + " = " + value + " " + unit;
}

}  // namespace banyan::study
