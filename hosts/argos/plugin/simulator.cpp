// SPDX-License-Identifier: MIT
#include "simulator.hpp"

#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/simulator/simulator.h>

#include <filesystem>

namespace banyan::argos {

using namespace ::argos;
namespace fs = std::filesystem;

double tick_of_simulator_s() { return CPhysicsEngine::GetSimulationClockTick(); }

std::vector<Attribute> attributes_of_node(TConfigurationNode& node) {
  std::vector<Attribute> attributes;
  ticpp::Iterator<ticpp::Attribute> attribute;
  for (attribute = attribute.begin(&node); attribute != attribute.end(); ++attribute) {
    std::string name, value;
    attribute->GetName(&name);
    attribute->GetValue(&value);
    attributes.push_back({name, value});
  }
  return attributes;
}

std::string place_in_experiment(TConfigurationNode& node) {
  return CSimulator::GetInstance().GetExperimentFileName() + ":" + std::to_string(node.Row());
}

std::string path_in_experiment(const std::string& path) {
  if (path.empty() || fs::path(path).is_absolute()) return path;
  return (fs::absolute(CSimulator::GetInstance().GetExperimentFileName()).parent_path() / path)
      .lexically_normal()
      .string();
}

}  // namespace banyan::argos
