// SPDX-License-Identifier: MIT
// The fields of a robot's broadcast (docs/protocol.md, section 1) as numbers. The one table of them.
#pragma once

#include <span>
#include <string_view>

#include "banyan/controller/message.hpp"
#include "text.hpp"

namespace banyan::record {

struct MessageField {
  std::string_view name;  // as in Message, with its unit: "want_cm"
  std::string_view meaning;
  double (*get)(const Message&);  // enumerators by number, truth as 0 and 1; nobody and unknown are -1
};
[[nodiscard]] std::span<const MessageField> message_fields() noexcept;

// One object with all fields in their order; role, phase and need by name.
void write_message(Text& out, const Message& message);

}  // namespace banyan::record
