// SPDX-License-Identifier: MIT
// Any bytes at all: decode() must reject them or give a message that encode() writes back as the
// same bytes, and a robot that hears the message must survive it. The sanitizers this is built
// with see reads past the end.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "banyan/controller/controller.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void hear(const banyan::Message& message, const std::uint8_t* bytes) {
  for (const banyan::Policy* policy : banyan::policies()) {
    for (const auto reading : {banyan::Reading::literal, banyan::Reading::corrected}) {
      const banyan::Params params = policy->defaults(reading);
      banyan::State state = banyan::initial_state(3, bytes[2] % 2 == 1, bytes[2] % 4 > 1);
      const banyan::Vec2 target{1.0F, 1.0F};
      for (int tick = 0; tick < 3; ++tick) {
        const banyan::Heard heard{&message, {0.01F * static_cast<float>(bytes[3]), 0.5F}};
        const banyan::Output output = banyan::step(params, *policy, state, {&heard, 1}, {}, state.is_worker ? &target : nullptr);
        require(std::isfinite(output.velocity.forward_m_s) && std::isfinite(output.velocity.turn_rad_s));
        require(banyan::decode(banyan::encode(output.message)) == output.message);
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A copy of exactly `size` bytes on the heap, so that the sanitizer sees the first byte beyond.
  const auto bytes = std::make_unique<std::uint8_t[]>(size);
  if (size > 0) std::memcpy(bytes.get(), data, size);
  const auto message = banyan::decode({bytes.get(), size});
  if (!message) return 0;
  const banyan::Wire wire = banyan::encode(*message);
  require(size == wire.size() && std::memcmp(wire.data(), data, size) == 0);
  hear(*message, data);
  return 0;
}
