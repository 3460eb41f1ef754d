// SPDX-License-Identifier: MIT
#include "banyan/controller/state.hpp"

#include "banyan/controller/digest.hpp"

namespace banyan {
namespace {

void add(Digest& d, const Neighborhood& table) noexcept {
  d.add(table.size());
  for (int k = 0; k < table.size(); ++k) {
    d.add(table.id(k));
    d.add(table.age(k));
    d.add(table.position(k));
    for (const std::uint8_t byte : encode(Message{table.message(k), {}})) d.add(byte);
  }
}

void add(Digest& d, const Task& task) noexcept {
  d.add(task.serves);
  d.add(task.holder);
  d.add(task.beat);
  d.add(task.age_ticks);
  d.add(task.host);
  d.add(task.target);
}

}  // namespace

std::uint64_t hash(const State& s) noexcept {
  Digest d;
  for (const int v : {static_cast<int>(s.id), static_cast<int>(s.is_worker), static_cast<int>(s.serves), static_cast<int>(s.role), static_cast<int>(s.epoch),
                      static_cast<int>(s.phase), static_cast<int>(s.phase_ticks), static_cast<int>(s.root.sequence),
                      static_cast<int>(s.root.id), static_cast<int>(s.root_size), static_cast<int>(s.done_ticks), static_cast<int>(s.label_cm),
                      static_cast<int>(s.label_wait_ticks), static_cast<int>(s.flood_parent), static_cast<int>(s.flood_done),
                      static_cast<int>(s.flood_robots), static_cast<int>(s.flood_workers), static_cast<int>(s.parent),
                      static_cast<int>(s.old_parent), static_cast<int>(s.committed),
                      static_cast<int>(s.search_ticks), static_cast<int>(s.orphan_ticks), static_cast<int>(s.childless_ticks),
                      static_cast<int>(s.pulse), static_cast<int>(s.wish), static_cast<int>(s.wish_ticks), static_cast<int>(s.warned), static_cast<int>(s.depth), static_cast<int>(s.tree_hops), static_cast<int>(s.subtree),
                      static_cast<int>(s.subtree_workers), static_cast<int>(s.count), static_cast<int>(s.centroid_known),
                      static_cast<int>(s.new_root), static_cast<int>(s.offer_ticks), static_cast<int>(s.need),
                      static_cast<int>(s.grant), static_cast<int>(s.grant_ticks),
                      static_cast<int>(s.inserted_child), static_cast<int>(s.inserted_ticks), static_cast<int>(s.spare_state),
                      static_cast<int>(s.request), static_cast<int>(s.request_ticks), static_cast<int>(s.ungranted_ticks),
                      static_cast<int>(s.reference), static_cast<int>(s.called), static_cast<int>(s.unserved_ticks),
                      static_cast<int>(s.call_hops), static_cast<int>(s.stalled_ticks), static_cast<int>(s.liveness_ticks), static_cast<int>(s.heartbeat), static_cast<int>(s.silence_ticks),
                      static_cast<int>(s.heart.sequence), static_cast<int>(s.heart.id), static_cast<int>(s.root_known),
                      static_cast<int>(s.turn), static_cast<int>(s.above), static_cast<int>(s.below), static_cast<int>(s.errand), static_cast<int>(s.led_from), static_cast<int>(s.errand_ticks),
                      static_cast<int>(s.settled_ticks), static_cast<int>(s.unsettled_ticks), static_cast<int>(s.plan_ticks), static_cast<int>(s.stub_ticks), static_cast<int>(s.task_count)})
    d.add(v);
  d.add(s.q);
  d.add(s.want_m);
  d.add(s.least_want_m);
  d.add(s.pull);
  d.add(s.centroid);
  d.add(s.expected_packets);
  d.add(s.missed_packets);
  d.add(s.root_at);
  d.add(s.stub);
  for (int k = 0; k < s.task_count; ++k) add(d, s.tasks[k]);
  d.add(static_cast<int>(s.detour.side));
  d.add(s.detour.contact);
  d.add(s.detour.origin);
  d.add(s.detour.goal);
  d.add(s.detour.leave_m);
  d.add(s.detour.span_m);
  d.add(static_cast<int>(s.pinned));
  d.add(s.seen_from);
  for (int k = 0; k < s.landmarks.size; ++k) d.add(s.landmarks.points[static_cast<std::size_t>(k)]);
  d.add(s.tally.insertions);
  d.add(s.tally.handovers);
  d.add(s.tally.repairs);
  d.add(s.tally.elections);
  d.add(s.tally.replacements);
  add(d, s.neighbors);
  return d.value();
}

}  // namespace banyan
