// SPDX-License-Identifier: MIT
// Any bytes at all: decode_fields() must reject them or give a message that encode_fields() writes back as
// the same bytes, and a robot that hears the message must survive it. The sanitizers this is built with see
// reads past the end.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/healing/tick.hpp"
#include "banyan/controller/inwards.hpp"
#include "banyan/controller/outwards.hpp"

namespace {

using namespace banyan;

void require(bool holds) {
  if (!holds) std::abort();
}

template <class Message> bool is_written_back(const Message& message, std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, wire_size<Message>()> wire;
  return encode_fields(message, wire) == bytes.size() && std::memcmp(wire.data(), bytes.data(), bytes.size()) == 0;
}

// Three ticks of a robot that hears nothing but this.
template <class Message, class Params, class State>
void hear(Output<Message> (*step)(const Params&, State&, const Inputs<Heard>&) noexcept, const Params& params,
          State state, const Message& message, std::uint8_t place) {
  for (int tick = 0; tick < 3; ++tick) {
    Heard heard{&message, {0.01F * static_cast<float>(place), 0.5F}};
    Senses senses;
    senses.orders.sent = state.is_worker;
    senses.orders.target = Vec2{1.0F, 1.0F};
    const Output<Message> output = step(params, state, {{&heard, 1}, senses, Platform{}});
    require(std::isfinite(output.motion.forward) && std::isfinite(output.motion.turn));
    std::array<std::uint8_t, wire_size<Message>()> wire;
    const std::size_t size = encode_fields(output.message, wire);
    require(decode_fields<Message>(std::span(wire).first(size)) == output.message);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A copy of exactly `size` bytes on the heap, so that the sanitizer sees the first byte beyond.
  const auto copy = std::make_unique<std::uint8_t[]>(size);
  if (size > 0) std::memcpy(copy.get(), data, size);
  const std::span<const std::uint8_t> bytes(copy.get(), size);
  if (const auto message = decode_fields<TreeMessage>(bytes)) {
    require(is_written_back(*message, bytes));
    const TreeState state = initial_tree_state(3, data[2] % 2 == 1, data[2] % 4 > 1);
    hear<TreeMessage, TreeParams>(outwards_literal_step, outwards_defaults(), state, *message, data[3]);
    hear<TreeMessage, TreeParams>(inwards_literal_step, inwards_defaults(), state, *message, data[3]);
  }
  if (const auto message = decode_fields<HealingMessage>(bytes)) {
    require(is_written_back(*message, bytes));
    const HealingState state = initial_healing_state(3, data[2] % 2 == 1, data[2] % 4 > 1);
    hear(outwards_step, outwards_defaults(), state, *message, data[3]);
    hear(inwards_step, inwards_defaults(), state, *message, data[3]);
  }
  if (const auto message = decode_fields<ConvoyMessage>(bytes)) {
    require(is_written_back(*message, bytes));
    hear(convoy_step, convoy_defaults(), initial_convoy_state(3, data[2] % 2 == 1, data[2] % 4 > 1), *message, data[3]);
  }
  return 0;
}
