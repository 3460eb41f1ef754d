// SPDX-License-Identifier: MIT
// A moment of a run in characters, for terminals.
#pragma once

#include <string>

#include "banyan/record/draw.hpp"

namespace banyan::cli {

struct MapStyle {
  int columns = 72, lines = 24;  // at least 10 and 5
  bool colour = true;            // by ANSI sequences, the colours of roles
};

// Lines of UTF-8, each ended by "\n": the tree in braille dots, robots as R, W, o (connectors), . (spares) and x
// (dead), targets as +. `view` fills the map as far as its shape allows; what is outside is left out.
[[nodiscard]] std::string terminal_map(const record::Frame& frame, const record::Viewport& view, const MapStyle& style);

}  // namespace banyan::cli
