// SPDX-License-Identifier: MIT
// What a result records of the machine it was made on.
#pragma once

#include <fstream>
#include <string>

namespace banyan::study {

// The processor's name, "" where the system does not provide it.
[[nodiscard]] inline std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "";
}

}  // namespace banyan::study
