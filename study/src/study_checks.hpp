// SPDX-License-Identifier: MIT
// What several parts of a study's file are checked for.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/config/table_reader.hpp"
#include "banyan/study/study.hpp"

namespace banyan::study {

// A value as a label: "9", "on", the text itself; "" for lists and tables.
[[nodiscard]] std::string label_of(const config::Node& value);

// The names of the axes of these parts, each once: views of the parts' own texts.
[[nodiscard]] std::vector<std::string_view> axis_names(std::span<const Part> parts);

// A fault at the key "name" unless the name, where there is one, is fit for files.
void check_name(config::TableReader& table, const std::string& name);

// A fault at the key `name` unless `metric` is a column of numbers or booleans, or `axis` one of the known; "" is not
// looked at.
void check_metric(config::TableReader& table, std::string_view name, const std::string& metric);
void check_axis(config::TableReader& table, std::string_view name, const std::string& axis,
                const std::vector<std::string_view>& known);

}  // namespace banyan::study
