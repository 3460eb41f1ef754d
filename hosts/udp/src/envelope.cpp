// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/envelope.hpp"

#include <sodium.h>

#include <chrono>

namespace banyan::udp {
namespace {

constexpr std::uint8_t magic = 0xBA;
constexpr std::uint8_t version = 1;

static_assert(mac_bytes >= crypto_generichash_BYTES_MIN && mac_bytes <= crypto_generichash_BYTES_MAX);
static_assert(sizeof(SecretKey::secret) == crypto_generichash_KEYBYTES);

using Mac = std::array<std::uint8_t, mac_bytes>;

Mac mac_of(ByteView bytes, const SecretKey& key) noexcept {
  Mac mac{};
  // Fails for impossible sizes only, and those are checked above.
  static_cast<void>(
      ::crypto_generichash(mac.data(), mac.size(), bytes.data(), bytes.size(), key.secret.data(), key.secret.size()));
  return mac;
}

}  // namespace

const char* name_of(Drop drop) noexcept {
  switch (drop) {
    case Drop::foreign: return "foreign";
    case Drop::forged: return "forged";
    case Drop::misaddressed: return "misaddressed";
    case Drop::stale: return "stale";
    case Drop::replayed: return "replayed";
    case Drop::malformed: return "malformed";
  }
  return "?";
}

std::optional<Envelope> authenticate(ByteView datagram, const KeyRing& keys, Drop& reason) noexcept {
  reason = Drop::foreign;
  if (datagram.size() < header_bytes + mac_bytes) return std::nullopt;
  const ByteView sealed = datagram.first(datagram.size() - mac_bytes);
  DatagramReader in(sealed);
  if (in.take<std::uint8_t>() != magic || in.take<std::uint8_t>() != version) return std::nullopt;
  const auto kind = in.take<std::uint8_t>();
  const SecretKey* key = keys.find(in.take<std::uint8_t>());
  if (key == nullptr) return std::nullopt;
  reason = Drop::forged;
  const Mac mac = mac_of(sealed, *key);
  if (::sodium_memcmp(mac.data(), datagram.data() + sealed.size(), mac_bytes) != 0) return std::nullopt;
  reason = Drop::malformed;
  if (kind > static_cast<std::uint8_t>(last_kind)) return std::nullopt;
  Envelope envelope;
  envelope.kind = static_cast<EnvelopeKind>(kind);
  envelope.sender = in.take<NodeId>();
  envelope.receiver = in.take<NodeId>();
  envelope.boot = in.take<std::uint64_t>();
  envelope.echo = in.take<std::uint64_t>();
  envelope.counter = in.take<std::uint32_t>();
  envelope.payload = sealed.subspan(header_bytes);
  return envelope;
}

Bytes seal(const Envelope& envelope, const SecretKey& key) {
  Bytes datagram;
  datagram.reserve(header_bytes + envelope.payload.size() + mac_bytes);
  DatagramWriter out(datagram);
  out.put(magic);
  out.put(version);
  out.put(static_cast<std::uint8_t>(envelope.kind));
  out.put(key.number);
  out.put(envelope.sender);
  out.put(envelope.receiver);
  out.put(envelope.boot);
  out.put(envelope.echo);
  out.put(envelope.counter);
  out.put(envelope.payload);
  const Mac mac = mac_of(datagram, key);
  out.put(ByteView(mac));
  return datagram;
}

std::optional<Drop> ReplayWindow::admit(std::uint64_t boot, std::uint32_t counter) noexcept {
  if (boot < boot_ || boot == 0) return Drop::stale;
  if (counter == 0) return Drop::malformed;
  if (boot > boot_) {
    boot_ = boot;
    highest_ = 0;
    seen_.reset();
  }
  if (counter > highest_) {
    seen_ <<= counter - highest_;
    seen_.set(0);
    highest_ = counter;
    return std::nullopt;
  }
  const std::uint32_t behind = highest_ - counter;
  if (behind >= reach || seen_.test(behind)) return Drop::replayed;
  seen_.set(behind);
  return std::nullopt;
}

Bytes SecureChannel::seal(EnvelopeKind kind, ByteView payload, const KeyRing& keys) {
  const std::uint64_t echo = kind == EnvelopeKind::hello ? 0 : window_.boot();
  return udp::seal({kind, self_, peer_, boot_, echo, ++counter_, payload}, keys.signing());
}

std::optional<Drop> SecureChannel::admit(const Envelope& envelope) noexcept {
  if (envelope.sender != peer_ || envelope.receiver != self_) return Drop::misaddressed;
  const bool answers_me = envelope.kind == EnvelopeKind::hello ? envelope.echo == 0 : envelope.echo == boot_;
  if (!answers_me) return Drop::stale;
  return window_.admit(envelope.boot, envelope.counter);
}

std::uint64_t new_boot() noexcept {
  using namespace std::chrono;
  return static_cast<std::uint64_t>(duration_cast<microseconds>(system_clock::now().time_since_epoch()).count());
}

}  // namespace banyan::udp
