// SPDX-License-Identifier: MIT
// What the plugin asks of the running ARGoS and of its configuration.
#pragma once

#include <argos3/core/utility/configuration/argos_configuration.h>

#include <string>
#include <vector>

#include "banyan/hosts/argos/settings.hpp"

namespace banyan::argos {

[[nodiscard]] double tick_of_simulator_s();
// In the order of the file.
[[nodiscard]] std::vector<Attribute> attributes_of_node(::argos::TConfigurationNode& node);
// "medium.argos:14": where an element is written.
[[nodiscard]] std::string place_in_experiment(::argos::TConfigurationNode& node);
// A path of the experiment: relative ones begin where its file is, wherever argos3 was started.
[[nodiscard]] std::string path_in_experiment(const std::string& path);

}  // namespace banyan::argos
