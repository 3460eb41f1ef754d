// SPDX-License-Identifier: MIT
// Foxglove's schemas (src/foxglove/), compiled in.
#pragma once

#include <string_view>

namespace banyan::record {

extern const std::string_view scene_update_schema;
extern const std::string_view log_schema;

}  // namespace banyan::record
