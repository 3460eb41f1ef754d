// SPDX-License-Identifier: MIT
#include "misses.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace banyan::study {
namespace {

constexpr double no_limit = std::numeric_limits<double>::quiet_NaN();

// What tells that a run has not come to the end of a time.
struct Missable {
  std::string_view metric, reached;
  std::string_view condition;  // a column that is empty where there was nothing to reach
  bool is_time = true;         // or a share of it
};
constexpr Missable missable[] = {{"normalized_time", "complete", ""},
                                 {"completion_time_s", "complete", ""},
                                 {"time_ratio", "complete", ""},
                                 {"held_time_ratio", "complete", "", false},
                                 {"unheld_time_ratio_by_death", "complete", "", false},
                                 {"recovery_time_s", "recovered", "last_death_s"}};

const Missable* missable_of(std::string_view metric) noexcept {
  const auto* at =
      std::find_if(std::begin(missable), std::end(missable), [&](const auto& m) { return m.metric == metric; });
  return at == std::end(missable) ? nullptr : at;
}

// The limit on a metric's scale: what a run that never completes would have at its end.
Values limits(const Results& results, std::string_view metric) {
  Values limit(results.rows(), no_limit);
  if (metric == "normalized_time") std::fill(limit.begin(), limit.end(), 1.0);
  if (metric == "completion_time_s" || metric == "time_ratio") limit = results.values("time_limit_s");
  if (metric == "time_ratio") {
    const Values bound = results.values("time_bound_s");
    for (std::size_t row = 0; row < limit.size(); ++row) limit[row] /= bound[row];
  }
  return limit;
}

}  // namespace

bool is_time(std::string_view metric) noexcept {
  const Missable* const known = missable_of(metric);
  return known != nullptr && known->is_time;
}

bool is_over_bound(std::string_view metric) noexcept {
  return metric == "committed_ratio" || metric == "oracle_ratio" || metric == "deployment_ratio";
}

MetricColumn metric_column(const Results& results, const std::string& metric) {
  MetricColumn column{metric, is_boolean(metric), false, results.values(metric), {}, {}};
  column.missed.assign(results.rows(), 0);
  column.restricted = column.value;
  const Missable* rule = missable_of(metric);
  if (rule == nullptr) return column;
  column.can_miss = true;
  const Values reached = results.values(rule->reached), limit = limits(results, metric);
  const Values condition = rule->condition.empty() ? reached : results.values(rule->condition);
  for (std::size_t row = 0; row < results.rows(); ++row) {
    if (reached[row] != 0.0 || std::isnan(condition[row])) continue;  // or failed
    column.missed[row] = 1;
    column.restricted[row] = limit[row];
  }
  return column;
}

}  // namespace banyan::study
