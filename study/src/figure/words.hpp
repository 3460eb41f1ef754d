// SPDX-License-Identifier: MIT
// What figures call things that have no title of their own.
#pragma once

#include <string>
#include <string_view>

namespace banyan::study {

// Of a column of a run: "disconnected_time_ratio" is the "share of time with a broken edge". Others lose their
// underscores.
[[nodiscard]] std::string words_of_metric(std::string_view metric);

// Of a name: "radius_m" is "radius (m)", "line_of_sight" is "line of sight".
[[nodiscard]] std::string words_of_name(std::string_view name);

// One value of what `title` names: "target radius r (m)" and "3" are "target radius r = 3 m", "line of sight" and "on"
// are "line of sight on", "reading" and "literal" are "reading: literal".
[[nodiscard]] std::string with_value(std::string_view title, std::string_view label);

}  // namespace banyan::study
