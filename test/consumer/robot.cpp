// SPDX-License-Identifier: MIT
// A robot of its own: one step of the installed controller without the rest of the house.
#include <banyan/controller/healing/tick.hpp>
#include <banyan/controller/outwards.hpp>

#include <array>
#include <span>

int main() {
  using Message = banyan::HealingMessage;
  const banyan::HealingParams params = banyan::outwards_defaults();
  banyan::HealingState state = banyan::initial_healing_state(7, false, true);
  const auto output = banyan::outwards_step(params, state, {{}, {}, banyan::Platform{}});
  std::array<std::uint8_t, banyan::wire_size<Message>()> wire;
  const std::span<const std::uint8_t> sent = std::span(wire).first(banyan::encode_fields(output.message, wire));
  return output.message.id == 7 && banyan::decode_fields<Message>(sent) == output.message ? 0 : 1;
}
