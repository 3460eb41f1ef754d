// SPDX-License-Identifier: MIT
// An Algorithm of any A (swarm_of.hpp): its name, its parameters and its swarms. For hosts; included where an algorithm
// is defined, and so compiled once for each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/controller/core/swarm_of.hpp"

namespace banyan {

// A row of the table and its number.
struct BoundParameter {
  const ParameterInfo* info;
  float* value;
};

// Tables one after the other. Their rows are of Params or of a base of it.
template <class Params, class... Tables>
[[nodiscard]] std::vector<BoundParameter> bind_all(Params& params, const Tables&... tables) {
  std::vector<BoundParameter> bound;
  const auto bind = [&](const auto& table) {
    for (const auto& row : table) bound.push_back({&row, &(params.*row.member)});
  };
  (bind(tables), ...);
  return bound;
}

// What a designer meets of an algorithm. Its Params are derived from Machine, which the host's platform fills in; an
// arrival_distance among them is the mission's unless it is set.
template <class P> struct Description {
  static P initial_values() noexcept { return {}; }
  static std::vector<BoundParameter> no_table(P&) { return {}; }
  static std::string_view no_fault(const P&) noexcept { return {}; }

  std::string_view name;     // as in mission.algorithm
  std::string_view summary;  // one sentence
  P (*defaults)() noexcept = initial_values;
  std::vector<BoundParameter> (*bind)(P&) = no_table;       // in the order in which they are listed
  std::string_view (*fault)(const P&) noexcept = no_fault;  // the first among values that depend on each other
};

namespace algorithm_detail {

// In the units of the table: the defaults, which `rows` have, and the setup's own.
inline std::vector<float> values_of(const Setup& setup, std::span<const BoundParameter> rows) {
  std::vector<float> values;
  for (const BoundParameter& row : rows) {
    float value = *row.value;
    for (const auto& [key, own] : setup.parameters)
      if (row.info->key == key) value = static_cast<float>(own);
    values.push_back(value);
  }
  return values;
}

// Gives them to the parameters; where bodies need room, large ones get more.
inline void resolve(std::span<const float> values, std::span<const BoundParameter> rows, const Machine& machine) {
  const float growth = std::max(1.0F, machine.body_radius / Machine{}.body_radius);
  for (std::size_t k = 0; k < rows.size(); ++k)
    *rows[k].value = rows[k].info->grows_with_body ? values[k] * growth : values[k];
}

// A number as a user would write it.
inline std::string plain(float number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", static_cast<double>(number));
  return text.data();
}

// The first value out of its range, in words.
inline std::string range_fault(std::span<const float> values, std::span<const BoundParameter> rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ParameterInfo& info = *rows[k].info;
    if (values[k] >= info.minimum && values[k] <= info.maximum) continue;  // NaN fails too
    return std::string(info.key) + " must be between " + plain(info.minimum) + " and " + plain(info.maximum) +
           ", not " + plain(values[k]);
  }
  return {};
}

// Robots count rounds in 16 bits, and some times are sums.
inline constexpr float most_counted_rounds = 50'000.0F;

// The first time that these robots cannot count, in words.
inline std::string time_fault(std::span<const float> values, std::span<const BoundParameter> rows,
                              const Machine& machine) {
  const float most = std::round(10.0F * most_counted_rounds / machine.rounds_per_drive) / 10.0F;  // as it is read
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k].info->unit == "drives" && !(values[k] <= most))
      return std::string(rows[k].info->key) + " must be at most " + plain(most) + " for robots so slow, not " +
             plain(values[k]) + ": they count " + plain(most_counted_rounds) + " control periods";
  return {};
}

// Whether the text has this word, which may be part of another one.
inline bool has_word(std::string_view text, std::string_view word) {
  const auto in_a_name = [&](std::size_t k) {
    return k < text.size() && (text[k] == '_' || (text[k] >= 'a' && text[k] <= 'z'));
  };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1))
    if ((at == 0 || !in_a_name(at - 1)) && !in_a_name(at + word.size())) return true;
  return false;
}

// What the text is about, with the values that hold here: whoever sets one of two parameters has not seen the other.
inline std::string with_values(std::string_view text, const Setup& setup, std::span<const float> values,
                               std::span<const BoundParameter> rows, const Machine& machine) {
  std::string list;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ParameterInfo& info = *rows[k].info;
    if (!has_word(text, info.key)) continue;
    list += (list.empty() ? "; here " : ", ") + std::string(info.key) + " = " + plain(values[k]);
    if (!info.unit.empty()) list += " " + std::string(info.unit);
    if (*rows[k].value != values[k]) list += " (" + plain(*rows[k].value) + " with bodies this large)";
    if (info.unit == "drives") list += " (" + plain(values[k] * machine.rounds_per_drive) + " rounds)";
    const bool own = std::any_of(setup.parameters.begin(), setup.parameters.end(),
                                 [&](const auto& parameter) { return parameter.first == info.key; });
    if (!own) list += " by default";
  }
  return std::string(text) + list;
}

}  // namespace algorithm_detail

template <class A> class AlgorithmOf : public Algorithm {
 public:
  using Params = typename A::Params;

  constexpr explicit AlgorithmOf(const Description<Params>& description) : of_(description) {}
  [[nodiscard]] std::string_view name() const noexcept override { return of_.name; }
  [[nodiscard]] std::string_view summary() const noexcept override { return of_.summary; }
  [[nodiscard]] std::vector<const ParameterInfo*> parameters() const override {
    Params params = of_.defaults();
    const auto bound = of_.bind(params);
    std::vector<const ParameterInfo*> rows(bound.size());
    std::transform(bound.begin(), bound.end(), rows.begin(), [](const BoundParameter& row) { return row.info; });
    return rows;
  }
  [[nodiscard]] std::vector<float> values(const Setup& setup) const override {
    Params params = defaults_on(setup);
    return algorithm_detail::values_of(setup, of_.bind(params));
  }
  [[nodiscard]] std::string fault(const Setup& setup) const override {
    if (const std::string_view text = machine_fault(machine_of(setup.platform)); !text.empty())
      return std::string(text);
    Params params = defaults_on(setup);
    const auto bound = of_.bind(params);
    const auto values = algorithm_detail::values_of(setup, bound);
    std::string text = algorithm_detail::range_fault(values, bound);
    if (text.empty()) text = algorithm_detail::time_fault(values, bound, params);
    if (!text.empty()) return text;
    algorithm_detail::resolve(values, bound, params);
    const std::string_view cross = of_.fault(params);
    return cross.empty() ? std::string() : algorithm_detail::with_values(cross, setup, values, bound, params);
  }
  [[nodiscard]] bool knows_redundancy() const noexcept override {
    return requires(Params params) { params.link_redundancy; };
  }
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    return std::make_unique<SwarmOf<A>>(params(setup), setup.platform, members, setup.history);
  }

 protected:
  [[nodiscard]] Params params(const Setup& setup) const {
    Params params = defaults_on(setup);
    const auto bound = of_.bind(params);
    algorithm_detail::resolve(algorithm_detail::values_of(setup, bound), bound, params);
    return params;
  }

 private:
  // The defaults on the robot, and for the mission, of this setup.
  [[nodiscard]] Params defaults_on(const Setup& setup) const {
    Params params = of_.defaults();
    static_cast<Machine&>(params) = machine_of(setup.platform);
    if constexpr (requires { params.arrival_distance; })
      params.arrival_distance = static_cast<float>(setup.arrival_distance_m) / setup.platform.communication_range_m;
    if constexpr (requires { params.link_redundancy; }) params.link_redundancy = setup.link_redundancy;
    return params;
  }

  Description<Params> of_;
};

}  // namespace banyan
