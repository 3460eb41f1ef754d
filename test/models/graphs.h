/* SPDX-License-Identifier: MIT */
/* The connected graphs of ROBOTS robots: who can hear whom. Up to 4 robots each labelled graph, since ids decide
   ties; beyond, one of each shape. */
#pragma once

#include "sizes.h"

static unsigned graphs[1024];
static int graph_total;

static int edge_bit(int a, int b) { return a < b ? b * (b - 1) / 2 + a : a * (a - 1) / 2 + b; }

/* Those of `among` that `from` reaches. */
static unsigned reach(unsigned graph, int from, unsigned among) {
  unsigned seen = 1U << from;
  for (int round = 0; round < ROBOTS; ++round)
    for (int a = 0; a < ROBOTS; ++a)
      for (int b = 0; b < ROBOTS; ++b)
        if (a != b && (seen >> a & 1) && (among >> b & 1) && (graph >> edge_bit(a, b) & 1)) seen |= 1U << b;
  return seen;
}

static int smallest_of_shape(unsigned graph, int* order, unsigned used, int placed) {
  if (placed == ROBOTS) {
    unsigned other = 0;
    for (int b = 1; b < ROBOTS; ++b)
      for (int a = 0; a < b; ++a)
        if (graph >> edge_bit(a, b) & 1) other |= 1U << edge_bit(order[a], order[b]);
    return graph <= other;
  }
  for (int k = 0; k < ROBOTS; ++k) {
    order[placed] = k;
    if (!(used >> k & 1) && !smallest_of_shape(graph, order, used | 1U << k, placed + 1)) return 0;
  }
  return 1;
}

static void find_graphs(void) {
  const unsigned all = (1U << ROBOTS) - 1;
  int order[ROBOTS];
  graph_total = 0;
  for (unsigned graph = 0; graph < 1U << (ROBOTS * (ROBOTS - 1) / 2); ++graph)
    if (reach(graph, 0, all) == all && (ROBOTS <= 4 || smallest_of_shape(graph, order, 0, 0))) graphs[graph_total++] = graph;
}
