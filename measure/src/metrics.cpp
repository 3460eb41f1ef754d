// SPDX-License-Identifier: MIT
#include "banyan/measure/metrics.hpp"

#include <vector>

namespace banyan::measure {
namespace {

template <class Metric> void add_columns(std::vector<ColumnIn<Run>>& columns) {
  constexpr auto part = [](const Run& run) -> const typename Metric::Row& { return run; };
  for (const auto& column : Metric::columns()) columns.push_back(column_in<Run, part>(column));
}

template <class... Metric> std::vector<ColumnIn<Run>> columns_of(std::tuple<Metric...>* /*metrics*/) {
  std::vector<ColumnIn<Run>> columns;
  (add_columns<Metric>(columns), ...);
  return columns;
}

}  // namespace

std::span<const ColumnIn<Run>> run_columns() {
  static const std::vector<ColumnIn<Run>> columns = columns_of(static_cast<Metrics*>(nullptr));
  return columns;
}

}  // namespace banyan::measure
