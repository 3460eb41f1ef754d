// SPDX-License-Identifier: MIT
// What a robot of MST preservation broadcasts (docs/baselines.md).
#pragma once

#include <cstdint>

#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::baselines::mst {

// A link as an edge of the graph: first the end within the own fragment. Shorter comes first, then smaller ids, so
// that no two are equal and the minimum spanning tree is unique.
struct Edge {
  RobotId from = nobody;  // nobody: there is none
  RobotId to = nobody;
  std::uint16_t length = 0;  // in units of 1 mm, where C is longer than 65 m of C / 65,000

  friend bool operator==(const Edge&, const Edge&) = default;
};

struct Message {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  Serial epoch = 0;            // the tree under construction, or the last
  Serial next = 0;             // the epoch after it, once a robot has asked for it; else the same
  std::uint8_t countdown = 0;  // ticks until that begins
  std::uint8_t level = 0;      // Boruvka's round
  RobotId fragment = nobody;   // by its leader
  RobotId up = nobody;         // the next robot on the way to the leader
  bool ready = false;          // all below it have found their shortest edge out of the fragment: best
  bool decided = false;        // the fragment has chosen the edge `choice`
  bool done = false;           // the tree is complete
  bool full = false;           // it has no room for edges that it does not keep yet
  Edge best;
  Edge choice;
  RobotId root = nobody;  // until the tree is complete the smallest id below it that is no worker, then of all
  KeptLinks branches = no_links();  // its edges in the tree under construction

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.flag("ready", "all below have found their shortest edge out of the fragment", m.ready);
  visit.flag("decided", "the fragment has chosen an edge", m.decided);
  visit.flag("done", "the tree is complete", m.done);
  visit.flag("full", "there is no room for edges beside those that it keeps", m.full);
  visit.robot("id", "of the sender", m.id);
  visit.number("epoch", "number of the tree under construction, or of the last", m.epoch);
  visit.number("next", "number of the tree that a robot has asked for", m.next);
  visit.number("countdown", "ticks until its construction begins", m.countdown);
  visit.number("level", "round of the construction", m.level);
  visit.robot("fragment", "leader of the fragment, -1: none yet", m.fragment);
  visit.robot("up", "the next robot on the way to the leader, -1: nobody", m.up);
  visit.robot("best_from", "shortest edge out of the fragment: its end within, -1: none", m.best.from);
  visit.robot("best_to", "its other end", m.best.to);
  visit.number("best_length", "in mm, where C is longer than 65 m in units of C / 65,000", m.best.length);
  visit.robot("choice_from", "the edge that the fragment has chosen: its end within, -1: none", m.choice.from);
  visit.robot("choice_to", "its other end", m.choice.to);
  visit.number("choice_length", "in the same units", m.choice.length);
  visit.robot("root", "the smallest id below the sender that is no worker; of a complete tree of all, -1: none",
              m.root);
  constexpr const char* names[] = {"branch_1", "branch_2", "branch_3", "branch_4",  "branch_5",  "branch_6",
                                   "branch_7", "branch_8", "branch_9", "branch_10", "branch_11", "branch_12"};
  static_assert(std::size(names) == most_kept_links);
  for (std::size_t k = 0; k < most_kept_links; ++k)
    visit.robot(names[k], "the other end of an edge of the tree under construction, -1: none", m.branches[k]);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

}  // namespace banyan::baselines::mst
