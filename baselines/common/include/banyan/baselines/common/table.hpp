// SPDX-License-Identifier: MIT
// The neighbour table of a baseline: which robots were heard, where, and the whole last message of each.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan::baselines {

template <class Message> struct Table : Neighbors {
  std::array<Message, neighbor_capacity> messages{};

  [[nodiscard]] const Message& message(int k) const noexcept { return messages[static_cast<std::size_t>(k)]; }

  // One tick: files what was heard and forgets robots silent for longer than `liveness_ticks`. If more are
  // heard than there is room for, those of which `ties(id)` is true stay, and of the others the nearest.
  template <class Heard, class Ties>
  void renew(RobotId me, std::span<Heard> heard, const Carry& carry, int elapsed_ticks, int liveness_ticks,
             const Machine& machine, const Ties& ties) noexcept {
    begin(elapsed_ticks, machine.way_in_a_round());
    for (Heard& h : heard) {
      const Message& m = *h.message;
      if (m.id == me || m.id == nobody) continue;
      Vec2 before;
      int k = file(m.id, h.position, before, carry);
      if (k < 0) k = enter(m.id, h.position, ties(m.id), [&](int j) { return ties(id(j)); });
      if (k >= 0) messages[static_cast<std::size_t>(k)] = m;
    }
    for (int k = 0; (k = remove_next(k, carry, liveness_ticks, [](int) { return false; })) >= 0;)
      close_gap(messages, k, size() + 1);
  }

  void add_to(Digest& digest) const noexcept {
    FieldDigest fields{digest};
    digest.add(size());
    for (int k = 0; k < size(); ++k) {
      digest.add(id(k));
      digest.add(age(k));
      digest.add(position(k));
      digest.add(measurements(k));
      visit_fields(fields, message(k));
    }
    filter().visit([&](const auto& field) { digest.add(field); });
  }
};

}  // namespace banyan::baselines
