// SPDX-License-Identifier: MIT
// What a user writes in <params> of a controller: the algorithm by name, each of its parameters, and what it must know
// of the robot. Names, ranges and units are those of scenario files; what is wrong is said all at once.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::argos {

struct Attribute {
  std::string name;
  std::string value;
};

class SettingsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// How a robot begins if there are no loop functions that say it.
enum class StartRole : unsigned char { spare, worker, root };

struct Settings {
  const Algorithm* algorithm = nullptr;
  Setup setup;
  // The same as options of `banyan run --set`: "mission.algorithm=convoy". Only what was written.
  std::vector<std::string> assignments;
  bool knows_wheels = false;  // wheel_distance_m was written
  StartRole part = StartRole::spare;
  std::optional<BasicVec2<double>> target;  // m, in the arena's frame
  double light_intensity_m = 2.0;           // of the light that is the target
};

// `tick_s`: of the simulator. `list` must outlive the settings. Throws SettingsError.
[[nodiscard]] Settings read_settings(std::span<const Attribute> attributes, const AlgorithmList& list, double tick_s);

// The attributes for read_settings() that stand for this scenario.
[[nodiscard]] std::vector<Attribute> attributes_of(const world::Scenario& scenario);

}  // namespace banyan::argos
