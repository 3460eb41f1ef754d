// SPDX-License-Identifier: MIT
// Maps that a scenario names as files become cells in its tree, so that whatever is written of it later needs no file.
#pragma once

#include <vector>

#include "banyan/config/document.hpp"

namespace banyan::config {

// `map = "floor.yaml"` at the top becomes the last of [[obstacles]], and every `file` of one the cells in it, with what
// the file says of resolution, origin and angle where the scenario does not. Paths are seen from the file that names
// them, or else from where the program runs.
void put_maps(Node& root, std::vector<Problem>& problems);

}  // namespace banyan::config
