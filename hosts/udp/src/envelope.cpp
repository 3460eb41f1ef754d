// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/envelope.hpp"

#include <sodium.h>

#include <array>

namespace banyan::udp {
namespace {

constexpr std::uint8_t magic = 0xBA;
constexpr std::uint8_t version = 2;

constexpr double answer_in_s = 10.0;  // later, it is none
constexpr double keeps_id_s = 1.0;    // without being heard
constexpr double overtaken_s = 0.3;   // what a session has sent is under way for less

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
    case Drop::in_use: return "of an id in use";
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
  envelope.session = in.take<std::uint64_t>();
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
  out.put(envelope.session);
  out.put(envelope.echo);
  out.put(envelope.counter);
  out.put(envelope.payload);
  const Mac mac = mac_of(datagram, key);
  out.put(ByteView(mac));
  return datagram;
}

std::optional<Drop> ReplayWindow::admit(std::uint32_t counter) noexcept {
  if (counter == 0) return Drop::malformed;
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

Bytes SecureChannel::seal(EnvelopeKind kind, std::uint64_t echo, ByteView payload, const KeyRing& keys) {
  return udp::seal({kind, self_, peer_, session_, echo, ++counter_, payload}, keys.signing());
}

Bytes SecureChannel::seal(EnvelopeKind kind, ByteView payload, const KeyRing& keys) {
  return seal(kind, believed_, payload, keys);
}

Bytes SecureChannel::ask(double now_s, const KeyRing& keys) {
  Bytes payload;
  DatagramWriter(payload).put(question(now_s));
  asked_s_ = now_s;
  return seal(EnvelopeKind::hello, 0, payload, keys);
}

bool SecureChannel::has_owner(double now_s) const noexcept { return believed_ != 0 && now_s - heard_s_ < keeps_id_s; }

// The same one as long as its answer may be under way.
std::uint64_t SecureChannel::question(double now_s) {
  if (question_ == 0 || now_s - made_s_ > answer_in_s) {
    question_ = new_session();
    made_s_ = now_s;
  }
  return question_;
}

// Asks back in the same packet if the one who asks is not known, every time: if recorded packets of somebody could use
// up the question, whoever is there now would not get it.
Bytes SecureChannel::answer(const Envelope& to, std::uint64_t question, double now_s, const KeyRing& keys) {
  const bool asks = to.session != believed_ && !has_owner(now_s);
  const std::uint64_t back = asks ? this->question(now_s) : 0;
  Bytes payload;
  DatagramWriter out(payload);
  out.put(question);
  out.put(back);
  return seal(EnvelopeKind::answer, to.session, payload, keys);
}

SecureChannel::Taken SecureChannel::take_hello(const Envelope& hello, double now_s, const KeyRing& keys) {
  DatagramReader in(hello.payload);
  const auto question = in.take<std::uint64_t>();
  if (!in.at_end() || question == 0) return {.drop = Drop::malformed};
  Taken taken;
  if (hello.session != believed_ && has_owner(now_s)) {
    if (!rival_s_) rival_s_ = now_s;
    taken.drop = Drop::in_use;
  }
  taken.reply = answer(hello, question, now_s, keys);
  return taken;
}

SecureChannel::Taken SecureChannel::take_answer(const Envelope& answer, double now_s, const KeyRing& keys) {
  DatagramReader in(answer.payload);
  const auto answered = in.take<std::uint64_t>(), asked = in.take<std::uint64_t>();
  if (!in.at_end()) return {.drop = Drop::malformed};
  const bool is_timely = question_ != 0 && answered == question_ && now_s - made_s_ <= answer_in_s;
  if (answer.echo != session_ || !is_timely) return {.drop = Drop::stale};
  question_ = 0;
  Taken taken;
  if (answer.session != believed_) {
    believed_ = answer.session;
    direct_ = to_any_ = {};
    rival_s_.reset();
    taken.is_met = true;
  }
  heard_s_ = now_s;
  if (asked != 0) taken.reply = this->answer(answer, asked, now_s, keys);
  return taken;
}

SecureChannel::Taken SecureChannel::take_from_stranger(double now_s, const KeyRing& keys) {
  if (has_owner(now_s)) {
    if (!rival_s_) rival_s_ = now_s;
    return {.drop = Drop::in_use};
  }
  Taken taken;
  if (believed_ != 0) taken.drop = Drop::stale;  // else it is the first that is heard of the peer
  if (may_ask(now_s)) taken.reply = ask(now_s, keys);
  return taken;
}

SecureChannel::Taken SecureChannel::take(const Envelope& envelope, double now_s, const KeyRing& keys) {
  const bool is_to_any = envelope.kind == EnvelopeKind::spoken || envelope.kind == EnvelopeKind::account;
  const bool is_call = envelope.kind == EnvelopeKind::hello && envelope.sender == hub_node;
  const bool is_for_me = envelope.receiver == self_ ||
                         (envelope.receiver == everybody && (envelope.kind == EnvelopeKind::spoken || is_call));
  if (envelope.sender != peer_ || !is_for_me) return {.drop = Drop::misaddressed};
  if (envelope.session == 0) return {.drop = Drop::malformed};
  if (envelope.kind == EnvelopeKind::hello) return take_hello(envelope, now_s, keys);
  if (envelope.kind == EnvelopeKind::answer) return take_answer(envelope, now_s, keys);
  if (envelope.session != believed_) return take_from_stranger(now_s, keys);
  if (!is_to_any && envelope.echo != session_) return {.drop = Drop::stale};
  if (const auto reason = (is_to_any ? to_any_ : direct_).admit(envelope.counter)) return {.drop = reason};
  heard_s_ = now_s;
  Taken taken;
  taken.counts = true;
  if (rival_s_ && now_s - *rival_s_ >= overtaken_s) {
    taken.is_contested = true;
    rival_s_.reset();
  }
  return taken;
}

std::uint64_t new_session() {
  std::uint64_t session = 0;
  while (session == 0) ::randombytes_buf(&session, sizeof(session));
  return session;
}

}  // namespace banyan::udp
