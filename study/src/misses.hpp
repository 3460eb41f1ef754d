// SPDX-License-Identifier: MIT
// Times that a run may never come to an end of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "banyan/study/results.hpp"

namespace banyan::study {

// A metric of all runs. A miss is a run that did not reach what the metric is the time of. `restricted` has the limit
// in the place of a miss, NaN where it has none.
struct MetricColumn {
  std::string name;
  bool boolean = false, can_miss = false;
  Values value, restricted;
  std::vector<char> missed;
};
[[nodiscard]] MetricColumn metric_column(const Results& results, const std::string& metric);

// Whether a metric is a time, of which less is better and a miss is later than any.
[[nodiscard]] bool is_time(std::string_view metric) noexcept;

// Whether a metric is measured against what no mission can be completed with less of. A run that never completed may
// lie below that, which says nothing.
[[nodiscard]] bool is_over_bound(std::string_view metric) noexcept;

}  // namespace banyan::study
