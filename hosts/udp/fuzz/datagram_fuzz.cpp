// SPDX-License-Identifier: MIT
// Any bytes at all as what arrives on a socket: nothing is read beyond them, and what is accepted can be written and
// read again. The first byte says as what they are read: payloads of datagrams, whole datagrams, packets of
// MAVLink, lines of a tracker.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "banyan/hosts/udp/envelope.hpp"
#include "banyan/hosts/udp/mavlink.hpp"
#include "banyan/hosts/udp/messages.hpp"
#include "banyan/hosts/udp/pose_stream.hpp"

namespace {

using namespace banyan::udp;

void require(bool holds) {
  if (!holds) std::abort();
}

template <class Message>
void is_stable(const std::optional<Message>& message, std::optional<Message> (*decode)(ByteView)) {
  if (!message) return;
  const Bytes once = encode(*message);
  const auto again = decode(once);
  require(again.has_value() && encode(*again) == once);
}

void read(std::uint8_t as, ByteView bytes) {
  switch (as % 6) {
    case 0: return is_stable(decode_frame(bytes), decode_frame);
    case 1: return is_stable(decode_heard(bytes), decode_heard);
    case 2: return is_stable(decode_status(bytes), decode_status);
    case 3: {
      Drop reason{};
      const SecretKey key{};  // the fuzzer cannot know a MAC: what is accepted here has been forged
      require(!authenticate(bytes, KeyRing({key}), reason));
      return;
    }
    case 4: {  // in two pieces, as from a serial port
      MavlinkReader reader;
      for (const ByteView piece : {bytes.first(bytes.size() / 2), bytes.subspan(bytes.size() / 2)}) {
        reader.feed(piece);
        while (const auto word = reader.next())
          if (const auto* attitude = std::get_if<MavlinkAttitude>(&word->message))
            require(std::isfinite(attitude->yaw_rad));
      }
      return;
    }
    default: static_cast<void>(parse_poses({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  // A copy of exactly that size on the heap, so that the sanitizer sees the first byte beyond.
  const auto copy = std::make_unique<std::uint8_t[]>(size - 1);
  std::copy(data + 1, data + size, copy.get());
  read(data[0], {copy.get(), size - 1});
  return 0;
}
