// SPDX-License-Identifier: MIT
// Studies and tunings that share most of what they say: a file of one names another as its base.
#pragma once

#include <string>
#include <vector>

#include "banyan/config/document.hpp"

namespace banyan::study {

// Lays a file over the one that its key `base` names, relative to `path`: tables are joined key by key, anything else
// of the file replaces what the base has. The base's name, and the key itself, are left out. The base may have a base.
// What is wrong with it goes to `problems`; the rest of the file is then returned alone.
[[nodiscard]] config::Node with_base(config::Node file, const std::string& path,
                                     std::vector<config::Problem>& problems);

// A file that another one names. It is beside the one in which the name is written, which may be the base of the file
// `path`; "-" is standard input, whose names are relative to the current directory.
[[nodiscard]] std::string beside(const config::Place& written, const std::string& path, const std::string& reference);

}  // namespace banyan::study
