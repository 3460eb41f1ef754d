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
#include "banyan/controller/paper/paper.hpp"

namespace {

using namespace banyan;

void require(bool holds) {
  if (!holds) std::abort();
}

template <class Message> bool is_written_back(const Message& message, std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, wire_size<Message>()> wire;
  return encode_fields(message, wire) == bytes.size() && std::memcmp(wire.data(), bytes.data(), bytes.size()) == 0;
}

// Three ticks of a robot that hears nothing but this. `step(state, inputs)`.
template <class Heard, class Message, class State, class Step>
void hear(Step step, State state, const Message& message, std::uint8_t place) {
  for (int tick = 0; tick < 3; ++tick) {
    Heard heard{&message, {0.01F * static_cast<float>(place), 0.5F}};
    Senses senses;
    senses.orders.sent = state.is_worker;
    senses.orders.target = Vec2{1.0F, 1.0F};
    const Output<Message> output = step(state, Inputs<Heard>({&heard, 1}, senses, Platform{}));
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
  if (const auto message = decode_fields<paper::Message>(bytes)) {
    require(is_written_back(*message, bytes));
    for (const paper::Growth* growth : {&paper::outwards, &paper::inwards})
      for (const paper::Reading* reading : {&paper::literal, &paper::corrected})
        hear<paper::Heard>(
            [&](paper::State& state, const Inputs<paper::Heard>& inputs) {
              return paper::step(*growth, *reading, paper::outwards_column(), state, inputs);
            },
            paper::initial(3, data[2] % 2 == 1, data[2] % 4 > 1), *message, data[3]);
  }
  if (const auto message = decode_fields<ConvoyMessage>(bytes)) {
    require(is_written_back(*message, bytes));
    hear<Heard>(
        [](ConvoyState& state, const Inputs<Heard>& inputs) { return convoy_step(convoy_defaults(), state, inputs); },
        initial_convoy_state(3, data[2] % 2 == 1, data[2] % 4 > 1), *message, data[3]);
  }
  return 0;
}
