// SPDX-License-Identifier: MIT
#include "banyan/algorithms/tree_algorithm.hpp"

namespace banyan {
namespace {

template <class Params, class Rows>
void add(std::vector<BoundParameter>& bound, Params& params, const Rows& rows) {
  for (const auto& row : rows) bound.push_back({&row, &(params.*row.member)});
}

}  // namespace

std::vector<BoundParameter> bind(HealingParams& params) {
  std::vector<BoundParameter> bound;
  add(bound, params, tree_parameters());
  add(bound, params, healing_parameters());
  add(bound, params, platform_parameters());
  return bound;
}

std::vector<BoundParameter> bind(ConvoyParams& params) {
  std::vector<BoundParameter> bound;
  add(bound, params, tree_parameters());
  add(bound, params, convoy_parameters());
  add(bound, params, healing_parameters());
  add(bound, params, platform_parameters());
  return bound;
}

void apply(const Setup& setup, bool follows_range, std::span<const BoundParameter> rows, TreeParams& params) {
  constexpr double nominal_range_m = 2.0;
  const double c = static_cast<double>(setup.platform.communication_range_m);
  const double scale = setup.scale * (follows_range ? c / nominal_range_m : 1.0);
  for (const BoundParameter& row : rows)
    if (row.info->scaling == Scaling::mission) *row.value *= static_cast<float>(scale);
  static_cast<Platform&>(params) = setup.platform;
  params.arrival_distance_m = static_cast<float>(setup.arrival_distance_m);
  for (const auto& [key, value] : setup.parameters)
    for (const BoundParameter& row : rows)
      if (row.info->key == key) *row.value = static_cast<float>(value);
}

std::string range_fault(std::span<const BoundParameter> rows) {
  for (const BoundParameter& row : rows)
    if (!(*row.value >= row.info->minimum && *row.value <= row.info->maximum)) return std::string(row.info->key);  // NaN fails too
  return {};
}

}  // namespace banyan
