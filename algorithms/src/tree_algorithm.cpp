// SPDX-License-Identifier: MIT
#include "banyan/algorithms/tree_algorithm.hpp"

#include <algorithm>

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

namespace {

bool in_units_of_range(const ParameterInfo& info) { return info.scaling == Scaling::range || info.scaling == Scaling::body; }

}  // namespace

std::vector<float> values_of(const Setup& setup, bool follows_range, std::span<const BoundParameter> rows, Platform& platform,
                             float& arrival_distance_m) {
  const double c = static_cast<double>(setup.platform.communication_range_m);
  const double scale = setup.scale * (follows_range ? c / static_cast<double>(nominal_range_m) : 1.0);
  platform = setup.platform;
  arrival_distance_m = static_cast<float>(setup.arrival_distance_m);
  std::vector<float> values;
  for (const BoundParameter& row : rows) {
    float value = *row.value;
    if (row.info->scaling == Scaling::mission) value *= static_cast<float>(scale);
    if (in_units_of_range(*row.info)) value /= nominal_range_m;
    for (const auto& [key, own] : setup.parameters)
      if (row.info->key == key) value = static_cast<float>(own);
    values.push_back(value);
  }
  return values;
}

void resolve(std::span<const float> values, std::span<const BoundParameter> rows, const Platform& platform) {
  const float range_m = platform.communication_range_m;
  // The range for which this body is as large as the nominal one for the nominal range.
  const float body_range_m = nominal_range_m * platform.wheel_distance_m / Platform{}.wheel_distance_m;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const float unit_m = rows[k].info->scaling == Scaling::body ? std::max(range_m, body_range_m) : range_m;
    *rows[k].value = in_units_of_range(*rows[k].info) ? values[k] * unit_m : values[k];
  }
}

std::string range_fault(std::span<const float> values, std::span<const BoundParameter> rows) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!(values[k] >= rows[k].info->minimum && values[k] <= rows[k].info->maximum)) return std::string(rows[k].info->key);  // NaN fails too
  return {};
}

}  // namespace banyan
