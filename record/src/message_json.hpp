// SPDX-License-Identifier: MIT
// What robots broadcast, as numbers with names, whatever the algorithm (Swarm::message_fields()). The names
// are those of docs/protocol.md, section 1.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "banyan/controller/core/swarm.hpp"
#include "text.hpp"

namespace banyan::record {

// The last broadcasts of all robots of a swarm.
struct MessageNumbers {
  std::span<const FieldInfo> fields;  // valid for the whole program
  std::vector<double> numbers;        // robot by robot, as many as there are fields
  [[nodiscard]] bool empty() const noexcept { return numbers.empty(); }
};
// Reuses the memory of `into`.
void capture_messages(const Swarm& swarm, std::size_t robots, MessageNumbers& into);  // of the first so many

// Whether /banyan/messages has the field. /banyan/frame has what is also in a report (label and want in
// metres; id is the index). Vectors to an addressee that changes at every tick do not compress: these four would take
// as much room as all the rest, and mean nothing without their addressee.
[[nodiscard]] bool is_recorded(const FieldInfo& field) noexcept;

// One object with all fields of robot i in their order; role, phase and need by name.
void write_message(Text& out, const Swarm& swarm, std::size_t i);

}  // namespace banyan::record
