// SPDX-License-Identifier: MIT
// The parameters and their defaults.
#include "banyan/controller/paper/params.hpp"

#include "banyan/controller/core/speed_parameter.hpp"

namespace banyan::paper {
namespace {

// The units of the paper as ours: C is 200 cm (row 8), a drive 10 s and a round 0.1 s (row 9).
constexpr double cm = 200.0;
constexpr double drive_s = 10.0;
constexpr double round_s = 0.1;

// "Optimized Design Parameters" (paper Table I), as printed.
struct Line {
  float Params::*symbol;
  double outwards, inwards, unit;
};
constexpr Line table_1[] = {
    {&Params::safe_range, 138.93, 135.25581, cm},            // S
    {&Params::avoidance_range, 43.16, 40.99, cm},            // A
    {&Params::ideal_distance, 190.0, 154.0841, cm},          // delta
    {&Params::interaction_gain, 10.0, 10.0, cm},             // epsilon; its force is of lengths in cm
    {&Params::target_gain, 0.49, 0.2539, 1.0},               // tau
    {&Params::reconfiguration_drives, 38.8, 44.0, drive_s},  // R
    {&Params::liveness_rounds, 1.2, 0.5, round_s},           // I
    {&Params::recruitment_distance, 132.09, 132.1353, cm},   // E
    {&Params::insertion_distance, 9.79, 6.6395, cm},         // J
};

constexpr Params column(double Line::*values) noexcept {
  Params params;
  for (const Line& line : table_1) params.*line.symbol = static_cast<float>(line.*values / line.unit);
  return params;
}

// clang-format off
constexpr Parameter<Params> rows[] = {
    {{"safe_range", "S", "C", "beyond it a robot no longer moves away from its parent",
      "Lower it for a radio that loses links early; slower.", "Table I", 0.025F, 1.0F}, &Params::safe_range},
    {{"avoidance_range", "A", "C", "robots that are not tree neighbours repel each other within it",
      "About three body diameters; larger takes more room.", "Table I", 0.0F, 1.0F}, &Params::avoidance_range},
    {{"ideal_distance", "delta", "C", "ideal length of a tree edge, and the emergency range",
      "As near to 1 as the radio is reliable.", "Table I", 0.025F, 1.0F}, &Params::ideal_distance},
    {{"interaction_gain", "epsilon", "C", "gain of the force between parent and child",
      "Larger, and springs hold against a stronger pull.", "Table I", 0.0F, 5.0F}, &Params::interaction_gain},
    {{"target_gain", "tau", "", "magnitude of the attraction to a target",
      "Larger is faster; the springs must still hold.", "Table I", 0.0F, 1.9F}, &Params::target_gain},
    {{"reconfiguration_drives", "R", "drives", "time between two reconstructions of the tree",
      "Each costs about 20 rounds of progress.", "Table I", 0.1F, 360.0F}, &Params::reconfiguration_drives},
    {{"liveness_rounds", "I", "rounds", "a neighbour not heard for longer counts as gone",
      "At least five; longer with packet loss.", "Table I", 1.0F, 600.0F}, &Params::liveness_rounds},
    {{"recruitment_distance", "E", "C", "a tree edge longer than this asks for a spare",
      "Shorter asks sooner, for more robots.", "Table I", 0.005F, 1.0F}, &Params::recruitment_distance},
    {{"insertion_distance", "J", "C", "a spare this near to an edge's midpoint joins the edge",
      "Larger joins sooner, with a bend in the chain.", "Table I", 0.0005F, 1.0F}, &Params::insertion_distance},
    {{"avoidance_gain", "", "", "gain of the repulsion within A",
      "Raise it if bodies touch.", "protocol 9", 0.0F, 100.0F}, &Params::avoidance_gain},
    {{"guard_rate", "", "1/drive", "each end may lengthen an edge at (delta - d)/2 times this (corrected)",
      "Lower is safer with latency and noise.", "protocol 2, row 4", 0.1F, 100.0F}, &Params::guard_rate},
    {{"arrival_distance", "", "C", "a worker's pull fades within this; the mission's target tolerance unless set",
      "Leave it to the mission.", "protocol 5", 0.005F, 5.0F}, &Params::arrival_distance},
    speed_parameter<Params>[0],
};
// clang-format on

}  // namespace

Params outwards_column() noexcept {
  static constexpr Params params = column(&Line::outwards);
  return params;
}
Params inwards_column() noexcept {
  static constexpr Params params = column(&Line::inwards);
  return params;
}

std::span<const Parameter<Params>> parameters() noexcept { return rows; }

std::string_view fault(const Params& p) noexcept {
  constexpr float longest = 30'000.0F;  // rounds: the sequence numbers of one epoch stay comparable (core/serial.hpp)
  if (!(p.reconfiguration_drives * p.rounds_per_drive < longest))
    return "reconfiguration_drives (R) must be below 30,000 rounds, else the numbers of its messages run out";
  if (!(p.avoidance_range < p.recruitment_distance))
    return "avoidance_range (A) must be below recruitment_distance (E), else an edge's ends would push away the spare "
           "that "
           "it asks for";
  if (!(p.recruitment_distance < p.safe_range))
    return "recruitment_distance (E) must be below safe_range (S), else an edge would stop growing before it asks for "
           "a "
           "spare";
  if (!(p.safe_range < p.ideal_distance))
    return "safe_range (S) must be below ideal_distance (delta), else a robot would still move away from its parent "
           "where "
           "the edge is in danger";
  if (!(p.ideal_distance <= 1.0F))
    return "ideal_distance (delta) must not exceed the radio range, 1 C: beyond it robots do not hear each other";
  return {};
}

}  // namespace banyan::paper
