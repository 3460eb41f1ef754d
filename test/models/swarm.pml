/* SPDX-License-Identifier: MIT */
/* What all models share: a swarm of ROBOTS robots, and stale copies of what they say. */

#include "sizes.h"

inline choose(x) {
  if
  :: x = 0
  :: x = 1
  :: x = 2
#if ROBOTS > 3
  :: x = 3
#endif
#if ROBOTS > 4
  :: x = 4
#endif
#if ROBOTS > 5
  :: x = 5
#endif
  fi
}

inline choose_other(x) {
  if
  :: x = (me + 1) % ROBOTS
  :: x = (me + 2) % ROBOTS
#if ROBOTS > 3
  :: x = (me + 3) % ROBOTS
#endif
#if ROBOTS > 4
  :: x = (me + 4) % ROBOTS
#endif
#if ROBOTS > 5
  :: x = (me + 5) % ROBOTS
#endif
  fi
}

inline choose_copy(x) {
  if
  :: x = 0
  :: x = 1
#if COPIES > 1
  :: x = 2
#endif
#if COPIES > 2
  :: x = 3
#endif
  fi
}

/* One of the connected graphs. */
inline choose_graph(x) {
  c_code { find_graphs(); now.graph_count = graph_total; };
  do
  :: x < graph_count - 1 -> x++
  :: break
  od;
  graph_count = 0
}
