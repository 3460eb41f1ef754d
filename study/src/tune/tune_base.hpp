// SPDX-License-Identifier: MIT
// Tune files that share most of what they say: one of them names the other as its base.
#pragma once

#include <string>
#include <vector>

#include "banyan/config/document.hpp"

namespace banyan::study {

// Lays a tune file over the one that its key `base` names, relative to `path`: tables are joined key by key, anything
// else of the file replaces what the base has. The base's name, and the key itself, are left out. What is wrong with
// the base goes to `problems`; the file is then returned as it is.
[[nodiscard]] config::Node with_base(config::Node file, const std::string& path, std::vector<config::Problem>& problems);

}  // namespace banyan::study
