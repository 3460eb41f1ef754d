// SPDX-License-Identifier: MIT
// A message as bytes, and as its receiver reads it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "banyan/controller/core/wire.hpp"

namespace banyan {

template <class Message> std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(wire_size<Message>());
  bytes.resize(encode_fields(message, bytes));
  return bytes;
}

template <class Message> std::optional<Message> over_the_wire(const Message& message) {
  return decode_fields<Message>(encoded(message));
}

}  // namespace banyan
