// SPDX-License-Identifier: MIT
// The colours of everything Banyan shows, the same in pictures, recordings and the viewer: Okabe &
// Ito's colour-blind-safe set, told apart in grey print by lightness and, in pictures, by shape.
#pragma once

#include <cstdint>
#include <string_view>

#include "banyan/controller/core/report.hpp"

namespace banyan::record {

struct Color {
  std::uint8_t red, green, blue;
  std::string_view hex;  // "#d55e00"
};

namespace palette {
inline constexpr Color root{0xD5, 0x5E, 0x00, "#d55e00"};       // vermillion
inline constexpr Color worker{0x00, 0x72, 0xB2, "#0072b2"};     // blue
inline constexpr Color connector{0x00, 0x9E, 0x73, "#009e73"};  // bluish green
inline constexpr Color spare{0xF0, 0xE4, 0x42, "#f0e442"};      // yellow
inline constexpr Color dead{0x59, 0x59, 0x59, "#595959"};       // dark grey
inline constexpr Color target{0xCC, 0x79, 0xA7, "#cc79a7"};     // reddish purple
inline constexpr Color tree{0x1A, 0x1A, 0x1A, "#1a1a1a"};       // parent edges
inline constexpr Color old_tree{0xE6, 0x9F, 0x00, "#e69f00"};   // old parent edges: orange
inline constexpr Color link{0xB8, 0xB8, 0xB8, "#b8b8b8"};       // radio links
inline constexpr Color blocked{0x56, 0xB4, 0xE9, "#56b4e9"};    // in range, no line of sight: sky blue
inline constexpr Color trail{0xB0, 0xA0, 0x10, "#b0a010"};      // of spares: their yellow, dark enough for a line
inline constexpr Color obstacle{0xA6, 0xA0, 0x98, "#a6a098"};

// What a picture on light or on dark ground is drawn in, as "#rrggbb". Roles have the same colours on both; only what
// would drown in a dark ground is turned round. The web viewer's themes.ts has the same.
struct Theme {
  std::string_view paper, ink, faint_ink, outline, dead, target, target_ink;
  std::string_view tree, old_tree, broken, link, blocked, connector, obstacle, spare_trail;
  std::string_view trail;  // attributes of trails
};
inline constexpr Theme light{.paper = "#fdfdfc",
                             .ink = "#1a1a1a",
                             .faint_ink = "#5f5f5c",
                             .outline = "#1a1a1a",
                             .dead = dead.hex,
                             .target = target.hex,
                             .target_ink = "#8f3f6d",
                             .tree = tree.hex,
                             .old_tree = old_tree.hex,
                             .broken = root.hex,
                             .link = link.hex,
                             .blocked = blocked.hex,
                             .connector = connector.hex,
                             .obstacle = obstacle.hex,
                             .spare_trail = trail.hex,
                             .trail = " stroke-opacity=\"0.5\""};
inline constexpr Theme dark{.paper = "#14171a",
                            .ink = "#eceae6",
                            .faint_ink = "#a3a7ab",
                            .outline = "#0b0d0f",
                            .dead = "#8c8f93",
                            .target = target.hex,
                            .target_ink = "#e8b3d0",
                            .tree = "#eceae6",
                            .old_tree = old_tree.hex,
                            .broken = "#f0732a",
                            .link = "#5a6168",
                            .blocked = blocked.hex,
                            .connector = connector.hex,
                            .obstacle = "#56534e",
                            .spare_trail = trail.hex,
                            .trail = " stroke-opacity=\"0.8\""};
}  // namespace palette

constexpr const Color& color_of(Role role, bool alive = true) noexcept {
  if (!alive) return palette::dead;
  switch (role) {
    case Role::root: return palette::root;
    case Role::worker: return palette::worker;
    case Role::connector: return palette::connector;
    case Role::spare: break;
  }
  return palette::spare;
}

}  // namespace banyan::record
