// SPDX-License-Identifier: MIT
// What all figures check before they are drawn.
#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace banyan::study {

inline void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("figure: ") + what);
}

// The given ends of an axis.
inline void require_ends(std::optional<double> minimum, std::optional<double> maximum) {
  require(std::isfinite(minimum.value_or(0.0)) && std::isfinite(maximum.value_or(0.0)),
          "the ends of the axis must be finite");
  require(!minimum || !maximum || *minimum < *maximum, "the axis must end above where it begins");
}

}  // namespace banyan::study
