// SPDX-License-Identifier: MIT
// An algorithm as a host meets it: a name, a table of parameters, and swarms.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"
#include "banyan/controller/core/swarm.hpp"

namespace banyan {

// How a robot begins.
struct Member {
  RobotId id = nobody;
  bool worker = false;  // it will be sent to a target
  bool root = false;    // exactly one
};

// What a swarm is made for.
struct Setup {
  std::string reading = "corrected";                        // or "literal" (docs/algorithms.md)
  double scale = 1.0;                                       // on the lengths of Table I (paper Sec. IV-C, "rescaled")
  Platform platform;
  double arrival_distance_m = 0.2;                          // the mission's tolerance
  std::vector<std::pair<std::string, double>> parameters;   // by key, in the units of the table
  std::size_t history = 1;                                  // packets are heard at most so many ticks after they were sent
};

class Algorithm {
 public:
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;

  [[nodiscard]] virtual std::string_view name() const noexcept = 0;     // as in mission.algorithm
  [[nodiscard]] virtual std::string_view summary() const noexcept = 0;  // one sentence
  // The rows of its table, in the order in which they are listed. Static lifetime.
  [[nodiscard]] virtual std::vector<const ParameterInfo*> parameters() const = 0;
  // Their values in that setup, one per row, in the units of the table. Keys that the algorithm does not
  // know are ignored.
  [[nodiscard]] virtual std::vector<float> values(const Setup& setup) const = 0;
  // The first fault in words ("recruitment_distance_m (E) must be below safe_range_m (S)"), or nothing.
  [[nodiscard]] virtual std::string fault(const Setup& setup) const = 0;
  // The setup must have no fault.
  [[nodiscard]] virtual std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const = 0;

 protected:
  constexpr Algorithm() = default;
  ~Algorithm() = default;
};

// The algorithms of the program, in the order in which they are listed. A program decides which it has:
// algorithms/ defines this function, or the program itself does.
[[nodiscard]] std::span<const Algorithm* const> algorithms() noexcept;
// The rows of all their tables, each key once. Static lifetime.
[[nodiscard]] std::span<const ParameterInfo> parameter_table() noexcept;
// By name; null if there is none.
[[nodiscard]] const Algorithm* find_algorithm(std::string_view name) noexcept;

}  // namespace banyan
