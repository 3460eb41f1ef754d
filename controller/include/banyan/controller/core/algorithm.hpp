// SPDX-License-Identifier: MIT
// An algorithm as a host meets it: a name, a table of parameters, and swarms.
#pragma once

#include <algorithm>
#include <initializer_list>
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
  std::string reading = "corrected";  // or "literal" (docs/algorithms.md)
  Platform platform;
  double arrival_distance_m = 0.2;                         // the mission's tolerance
  int link_redundancy = 1;                                 // paths between any two targets that share no other robot
  std::vector<std::pair<std::string, double>> parameters;  // by key, in the units of the table
  std::size_t history = 1;                                 // longest time from sending to hearing, ticks
};

class Algorithm {
 public:
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;

  [[nodiscard]] virtual std::string_view name() const noexcept = 0;     // as in mission.algorithm
  [[nodiscard]] virtual std::string_view summary() const noexcept = 0;  // one sentence
  // Tells it from others of the same name; nothing for those that come with a program, whose version does.
  [[nodiscard]] virtual std::string_view fingerprint() const noexcept { return {}; }
  // The rows of its table, in the order in which they are listed. Static lifetime.
  [[nodiscard]] virtual std::vector<const ParameterInfo*> parameters() const = 0;
  // Their values in that setup, one per row, in the units of the table. Keys that the algorithm does not
  // know are ignored.
  [[nodiscard]] virtual std::vector<float> values(const Setup& setup) const = 0;
  // The first fault in words ("recruitment_distance (E) must be below safe_range (S), else ..."), or nothing.
  [[nodiscard]] virtual std::string fault(const Setup& setup) const = 0;
  // Whether it has rules for Setup::link_redundancy above 1.
  [[nodiscard]] virtual bool knows_redundancy() const noexcept { return false; }
  // Whether Setup::reading makes a difference; else there is one reading only.
  [[nodiscard]] virtual bool knows_readings() const noexcept { return false; }
  // The setup must have no fault.
  [[nodiscard]] virtual std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const = 0;

 protected:
  constexpr Algorithm() = default;
  ~Algorithm() = default;
};

// Bytes of each message that its robots send. The setup must have no fault.
[[nodiscard]] inline std::size_t message_bytes(const Algorithm& algorithm, const Setup& setup) {
  const Member alone{.id = 0, .root = true};
  return algorithm.make(setup, std::span(&alone, 1))->message_bytes();
}

// The algorithms that a program has, in the order in which they are listed. The program hands its list
// down: algorithms/ has the list of those that come with Banyan.
class AlgorithmList {
 public:
  // They must outlive the list. `usual`: the name of the one that a user means who names none; "": the first.
  AlgorithmList(std::initializer_list<const Algorithm*> algorithms, std::string_view usual = {})
      : AlgorithmList(std::vector<const Algorithm*>(algorithms), usual) {}
  explicit AlgorithmList(std::vector<const Algorithm*> algorithms, std::string_view usual = {})
      : algorithms_(std::move(algorithms)), usual_(usual) {
    for (const Algorithm* algorithm : algorithms_) names_.push_back(algorithm->name());
    if (usual_.empty() && !names_.empty()) usual_ = names_.front();
    // In the order of the longest table, so that the texts of configurations keep theirs.
    const auto longest = std::max_element(
        algorithms_.begin(), algorithms_.end(),
        [](const Algorithm* a, const Algorithm* b) { return a->parameters().size() < b->parameters().size(); });
    if (longest != algorithms_.end()) add_parameters(**longest);
    for (const Algorithm* algorithm : algorithms_) add_parameters(*algorithm);
  }

  [[nodiscard]] auto begin() const noexcept { return algorithms_.begin(); }
  [[nodiscard]] auto end() const noexcept { return algorithms_.end(); }
  [[nodiscard]] std::span<const std::string_view> names() const noexcept { return names_; }
  [[nodiscard]] std::string_view usual() const noexcept { return usual_; }
  // By name; null if there is none.
  [[nodiscard]] const Algorithm* find(std::string_view name) const noexcept {
    const auto at = std::find(names_.begin(), names_.end(), name);
    return at == names_.end() ? nullptr : algorithms_[static_cast<std::size_t>(at - names_.begin())];
  }
  // The rows of all their tables, each key once.
  [[nodiscard]] std::span<const ParameterInfo> parameters() const noexcept { return parameters_; }

 private:
  void add_parameters(const Algorithm& algorithm) {
    for (const ParameterInfo* info : algorithm.parameters())
      if (std::none_of(parameters_.begin(), parameters_.end(),
                       [&](const ParameterInfo& row) { return row.key == info->key; }))
        parameters_.push_back(*info);
  }

  std::vector<const Algorithm*> algorithms_;
  std::vector<std::string_view> names_;
  std::string_view usual_;
  std::vector<ParameterInfo> parameters_;
};

// Why a radio whose packets carry at most `limit` bytes is none for that algorithm, and for which of `others` it is; or
// nothing. The setup must have no fault.
[[nodiscard]] inline std::string payload_fault(const Algorithm& algorithm, const Setup& setup, std::size_t limit,
                                               const AlgorithmList& others) {
  const std::size_t bytes = message_bytes(algorithm, setup);
  if (bytes <= limit) return {};
  std::string fitting;
  for (const Algorithm* other : others) {
    Setup of_other = setup;
    of_other.parameters.clear();  // which are of the algorithm that does not fit
    if (!other->fault(of_other).empty()) continue;
    if (const std::size_t size = message_bytes(*other, of_other); size <= limit)
      fitting += (fitting.empty() ? "" : ", ") + std::string(other->name()) + " (" + std::to_string(size) + ")";
  }
  return "a message of " + std::string(algorithm.name()) + " has " + std::to_string(bytes) +
         " bytes, and the radio carries " + std::to_string(limit) + "; " +
         (fitting.empty() ? "no algorithm has a shorter one" : "these fit: " + fitting);
}

}  // namespace banyan
