// SPDX-License-Identifier: MIT
// A robot of its own: one step of the installed controller without the rest of the house.
#include <banyan/controller/paper/paper.hpp>

#include <array>
#include <span>

int main() {
  using banyan::paper::Message;
  const banyan::paper::Params params = banyan::paper::outwards_column();
  banyan::paper::State state = banyan::paper::initial(7, false, true);
  const auto output = banyan::paper::step(banyan::paper::outwards, banyan::paper::corrected, params, state,
                                          {{}, {}, banyan::Platform{}});
  std::array<std::uint8_t, banyan::wire_size<Message>()> wire;
  const std::span<const std::uint8_t> sent = std::span(wire).first(banyan::encode_fields(output.message, wire));
  return output.message.id == 7 && banyan::decode_fields<Message>(sent) == output.message ? 0 : 1;
}
