// SPDX-License-Identifier: MIT
// What a robot broadcast, as numbers with names: the one table of a message's fields for whoever shows
// them. The names are those of docs/protocol.md, section 1.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "banyan/controller/message.hpp"
#include "text.hpp"

namespace banyan::record {

struct MessageField {
  std::string_view name;          // with its unit: "label_cm"
  std::string_view meaning;       // what the numbers stand for
  double (*get)(const Message&);  // nobody, unknown, unreachable: -1
  int decimals = 0;               // worth writing; 0: a whole number
  // Where a recording has it. /banyan/frame has what is also state under the same name (want_cm as want_m;
  // id is the index). Vectors to an addressee that changes at every tick are noise to any compression: the
  // four of them would take as much room as all the rest, and say nothing without their addressee.
  enum class Kept : std::uint8_t { in_messages, in_frame, nowhere };
  Kept kept = Kept::in_messages;
};

// In the order of the wire format; `version` is not among them. Valid for the whole program.
[[nodiscard]] std::span<const MessageField> message_fields() noexcept;

// One object with all fields in their order; role, phase and need by name.
void write_message(Text& out, const Message& message);

}  // namespace banyan::record
