// SPDX-License-Identifier: MIT
// The metrics of a run. Another one is a header with its class (moment.hpp says what it needs), a source, and its name
// in this list.
#pragma once

#include <span>
#include <tuple>

#include "banyan/measure/connectivity.hpp"
#include "banyan/measure/course.hpp"
#include "banyan/measure/deaths.hpp"
#include "banyan/measure/edges.hpp"
#include "banyan/measure/effort.hpp"
#include "banyan/measure/held_targets.hpp"
#include "banyan/measure/lasting.hpp"
#include "banyan/measure/network_parts.hpp"
#include "banyan/measure/oracle.hpp"
#include "banyan/measure/overlaps.hpp"
#include "banyan/measure/redundancy.hpp"
#include "banyan/measure/roots.hpp"
#include "banyan/measure/tallies.hpp"
#include "banyan/measure/tree_size.hpp"

namespace banyan::measure {

// In the order of their columns, and in which they look: whoever reads what another has found comes after it.
using Metrics = std::tuple<Course, HeldTargets, Oracle, TreeSize, Redundancy, Edges, NetworkParts, Roots, Tallies,
                           Effort, Overlaps, Lasting, Deaths, Connectivity>;

template <class> struct RowOf;
template <class... Metric> struct RowOf<std::tuple<Metric...>> : Metric::Row... {};

// A run so far. Means, sums over robots and ratios are filled in by Observer::result.
struct Run : RowOf<Metrics> {};

[[nodiscard]] std::span<const ColumnIn<Run>> run_columns();

}  // namespace banyan::measure
