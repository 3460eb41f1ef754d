// SPDX-License-Identifier: MIT
// Algorithms as hosts meet them: how their tables, readings and steps become an Algorithm. An algorithm over the tree's
// blocks needs nothing else; any other Params need a bind() and a cross_fault() beside them (rivals.cpp).
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/controller/convoy/params.hpp"
#include "banyan/controller/core/algorithm.hpp"
#include "banyan/controller/core/swarm_of.hpp"

namespace banyan {

// A row of the table and its number.
struct BoundParameter {
  const ParameterInfo* info;
  float* value;
};
[[nodiscard]] std::vector<BoundParameter> bind(HealingParams& params);
[[nodiscard]] std::vector<BoundParameter> bind(ConvoyParams& params);

// The values in the units of the table: defaults, which `rows` have, scaled; platform and arrival distance, which the
// rows point into, as the setup has them; the setup's own values.
// `follows_range`: the lengths among the defaults stand for C = 2 m and grow with it; Table I's are absolute.
[[nodiscard]] std::vector<float> values_of(const Setup& setup, bool follows_range, std::span<const BoundParameter> rows, Platform& platform,
                                          float& arrival_distance_m);
// Gives them to the parameters; lengths in units of C become metres, once and for all.
void resolve(std::span<const float> values, std::span<const BoundParameter> rows, const Platform& platform);
// The first value out of its range, by its key.
[[nodiscard]] std::string range_fault(std::span<const float> values, std::span<const BoundParameter> rows);
// The first fault among values that depend on each other.
[[nodiscard]] inline std::string_view cross_fault(const HealingParams& params) { return tree_fault(params); }
[[nodiscard]] inline std::string_view cross_fault(const ConvoyParams& params) {
  const std::string_view text = tree_fault(params);
  return text.empty() ? convoy_fault(params) : text;
}

// An algorithm with these parameters; what is missing is make().
template <class Params>
class TreeAlgorithm : public Algorithm {
 public:
  constexpr TreeAlgorithm(std::string_view name, std::string_view summary, Params (*defaults)() noexcept, bool follows_range = false)
      : name_(name), summary_(summary), defaults_(defaults), follows_range_(follows_range) {}
  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] std::string_view summary() const noexcept override { return summary_; }
  [[nodiscard]] std::vector<const ParameterInfo*> parameters() const override {
    Params params = defaults_();
    const auto bound = bind(params);
    std::vector<const ParameterInfo*> rows(bound.size());
    std::transform(bound.begin(), bound.end(), rows.begin(), [](const BoundParameter& row) { return row.info; });
    return rows;
  }
  [[nodiscard]] std::vector<float> values(const Setup& setup) const override {
    Params params = defaults_();
    return values_of(setup, follows_range_, bind(params), params, params.arrival_distance_m);
  }
  [[nodiscard]] std::string fault(const Setup& setup) const override {
    Params params = defaults_();
    const auto bound = bind(params);
    const auto values = values_of(setup, follows_range_, bound, params, params.arrival_distance_m);
    std::string text = range_fault(values, bound);
    if (!text.empty()) return text;
    resolve(values, bound, params);
    return std::string(cross_fault(params));
  }

 protected:
  [[nodiscard]] Params params(const Setup& setup) const {
    Params params = defaults_();
    const auto bound = bind(params);
    const auto values = values_of(setup, follows_range_, bound, params, params.arrival_distance_m);
    resolve(values, bound, params);
    return params;
  }

 private:
  std::string_view name_;
  std::string_view summary_;
  Params (*defaults_)() noexcept;
  bool follows_range_;
};

// All of this for an A (core/swarm_of.hpp) that has one reading.
template <class A>
class TreeAlgorithmOf final : public TreeAlgorithm<typename A::Params> {
 public:
  using TreeAlgorithm<typename A::Params>::TreeAlgorithm;
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    return std::make_unique<SwarmOf<A>>(this->params(setup), members, setup.history);
  }
};

}  // namespace banyan
