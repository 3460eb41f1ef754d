// SPDX-License-Identifier: MIT
// Random missions, one after the other, watched at every tick (docs/soak.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace banyan::soak {

struct SoakOptions {
  std::string file;  // a scenario to watch instead; "": random missions
  std::uint64_t seed = 1;
  std::uint64_t from = 0;                 // the first mission
  std::optional<std::uint64_t> missions;  // how many; none: as many as there is time for
  double seconds = 0.0;                   // of wall time; 0: until it is stopped, or missions are done
  std::string out;                        // "": out/soak-<seed>
  int threads = 0;                        // missions at once; 0: all cores
  bool whole = false;                     // missions with findings are kept as they are
  bool force = false;
  bool quiet = false;
};

// Returns an exit code (terminal.hpp).
int run_soak(const SoakOptions& options);

}  // namespace banyan::soak
