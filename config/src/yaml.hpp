// SPDX-License-Identifier: MIT
// YAML as the tree of values that TOML and JSON become, too.
#pragma once

#include <string>
#include <string_view>

#include "banyan/config/document.hpp"

namespace banyan::config {

// The first document of the text. `path` names it in messages. Anchors and keys that are no text are refused. Throws
// DocumentError; always where this was built without libyaml.
[[nodiscard]] Node parse_yaml(const std::string& path, std::string_view text);

}  // namespace banyan::config
