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

std::vector<float> values_of(const Setup& setup, bool follows_range, std::span<const BoundParameter> rows, TreeParams& params) {
  const double c = static_cast<double>(setup.platform.communication_range_m);
  const double scale = setup.scale * (follows_range ? c / static_cast<double>(nominal_range_m) : 1.0);
  static_cast<Platform&>(params) = setup.platform;
  params.arrival_distance_m = static_cast<float>(setup.arrival_distance_m);
  std::vector<float> values;
  for (const BoundParameter& row : rows) {
    float value = *row.value;
    if (row.info->scaling == Scaling::mission) value *= static_cast<float>(scale);
    if (row.info->scaling == Scaling::range) value /= nominal_range_m;
    for (const auto& [key, own] : setup.parameters)
      if (row.info->key == key) value = static_cast<float>(own);
    values.push_back(value);
  }
  return values;
}

void resolve(std::span<const float> values, std::span<const BoundParameter> rows, float communication_range_m) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    *rows[k].value = rows[k].info->scaling == Scaling::range ? values[k] * communication_range_m : values[k];
}

std::string range_fault(std::span<const float> values, std::span<const BoundParameter> rows) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!(values[k] >= rows[k].info->minimum && values[k] <= rows[k].info->maximum)) return std::string(rows[k].info->key);  // NaN fails too
  return {};
}

}  // namespace banyan
