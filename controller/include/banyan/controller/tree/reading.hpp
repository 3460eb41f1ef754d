// SPDX-License-Identifier: MIT
// How the paper's misprints and gaps are read (protocol 2, docs/algorithms.md). Its two values are the
// whole difference between `literal` and `corrected` within tree/. The steps of the algorithms show that
// `corrected` also heals, guards its edges and keeps away from obstacles.
#pragma once

#include <string_view>

namespace banyan {

struct Reading {
  std::string_view name;
  bool keeps_margin;         // a parent is chosen within delta - parent_margin; printed: within C
  bool keeps_links;          // a robot without a parent stays with those that tie it to the root; printed: no such rule
  bool slides_beyond_safe;   // beyond S only the motion away from the parent is dropped; printed: all but the springs
  bool asks_while_wanted;    // an edge asks for a spare only while a worker below still has to travel; printed: always
  bool calls_spares;         // needs that no spare answers call spares from out of sight; printed: no such rule
  bool spares_stand_still;   // near their reference; printed: they orbit it
  bool avoids_obstacles;     // obstacle points repel, too; printed: no such rule
  bool prefers_safe_parent;  // inwards: among candidates those within S first; printed: the smallest distance to the
                             // root
  bool filters_positions;    // noisy measurements of neighbours are filtered; printed: no such rule
  bool counts_edges_once;    // an edge of both trees has one force; printed: u_tree,old + u_tree,new
  bool renews_labels;        // in GROW TREE a label that exceeds the way to the root shrinks; printed: it never does
};

inline constexpr Reading literal_reading{.name = "literal",
                                         .keeps_margin = false,
                                         .keeps_links = false,
                                         .slides_beyond_safe = false,
                                         .asks_while_wanted = false,
                                         .calls_spares = false,
                                         .spares_stand_still = false,
                                         .avoids_obstacles = false,
                                         .prefers_safe_parent = false,
                                         .filters_positions = false,
                                         .counts_edges_once = false,
                                         .renews_labels = false};
inline constexpr Reading corrected_reading{.name = "corrected",
                                           .keeps_margin = true,
                                           .keeps_links = true,
                                           .slides_beyond_safe = true,
                                           .asks_while_wanted = true,
                                           .calls_spares = true,
                                           .spares_stand_still = true,
                                           .avoids_obstacles = true,
                                           .prefers_safe_parent = true,
                                           .filters_positions = true,
                                           .counts_edges_once = true,
                                           .renews_labels = true};

}  // namespace banyan
