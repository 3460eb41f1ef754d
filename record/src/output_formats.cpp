// SPDX-License-Identifier: MIT
// The formats by their keys (output_formats.hpp).
#include "banyan/record/output_formats.hpp"

#include <algorithm>
#include <stdexcept>

namespace banyan::record {

namespace {

std::size_t format_of(std::string_view key) {
  const auto at = std::find_if(std::begin(output_formats), std::end(output_formats),
                               [&](const OutputFormat& format) { return !key.empty() && format.key == key; });
  if (at == std::end(output_formats)) throw std::out_of_range("there is no output \"" + std::string(key) + "\"");
  return static_cast<std::size_t>(at - std::begin(output_formats));
}

}  // namespace

bool& OutputSettings::operator[](std::string_view key) { return wanted[format_of(key)]; }
bool OutputSettings::operator[](std::string_view key) const { return wanted[format_of(key)]; }
bool OutputSettings::wants(const OutputFormat& format) const {
  return format.key.empty() ? results : (*this)[format.key];
}
bool OutputSettings::any() const noexcept { return std::find(wanted.begin(), wanted.end(), true) != wanted.end(); }

}  // namespace banyan::record
