// SPDX-License-Identifier: MIT
// A message as bytes, and as its receiver reads it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "banyan/controller/core/wire.hpp"

namespace banyan {

template <class Message> using WireOf = std::array<std::uint8_t, wire_size<Message>()>;

template <class Message> WireOf<Message> encoded(const Message& message) {
  WireOf<Message> bytes{};
  encode_fields(message, bytes);
  return bytes;
}

template <class Message> std::optional<Message> over_the_wire(const Message& message) {
  return decode_fields<Message>(encoded(message));
}

}  // namespace banyan
