// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/peers.hpp"

namespace banyan::udp {

Bytes Peers::speak(ByteView message, const KeyRing& keys) {
  return seal({EnvelopeKind::spoken, self_, everybody, session_, 0, ++spoken_, message}, keys.signing());
}

Bytes Peers::tell(ByteView account, const KeyRing& keys) {
  return seal({EnvelopeKind::account, self_, hub_node, session_, 0, ++spoken_, account}, keys.signing());
}

Peers::Taken Peers::take(const Envelope& envelope, double now_s, const KeyRing& keys) {
  if (envelope.sender == self_) {  // a broadcast that comes back, or somebody of the same id
    if (envelope.session == session_) return {};
    return {.is_contested = true, .drop = Drop::in_use};  // who is believed is up to the others
  }
  const bool is_from_hub = envelope.sender == hub_node;
  switch (envelope.kind) {
    case EnvelopeKind::hello:
    case EnvelopeKind::answer: break;
    case EnvelopeKind::spoken:
      if (is_from_hub || envelope.receiver != everybody) return {.drop = Drop::misaddressed};
      break;
    case EnvelopeKind::account:
      if (self_ != hub_node) return {.drop = Drop::misaddressed};
      break;
    case EnvelopeKind::stop:
      if (is_from_hub) break;
      [[fallthrough]];
    default: return {.drop = Drop::malformed};
  }
  SecureChannel& channel = peers_.try_emplace(envelope.sender, self_, envelope.sender, session_).first->second;
  SecureChannel::Taken of = channel.take(envelope, now_s, keys);
  Taken taken{.is_contested = of.is_contested, .drop = of.drop, .reply = std::move(of.reply)};
  if (!of.counts) return taken;
  if (envelope.kind == EnvelopeKind::spoken) taken.what = Taken::What::message;
  if (envelope.kind == EnvelopeKind::account) taken.what = Taken::What::account;
  if (envelope.kind == EnvelopeKind::stop) {
    taken.what = Taken::What::stop;
    taken.reply = channel.seal(EnvelopeKind::stopped, {}, keys);
  }
  return taken;
}

// Its session is its question.
Bytes Stopper::call(const KeyRing& keys) {
  Bytes question;
  DatagramWriter(question).put(session_);
  return seal({EnvelopeKind::hello, hub_node, everybody, session_, 0, ++counter_, question}, keys.signing());
}

std::vector<Bytes> Stopper::take(const Envelope& envelope, const KeyRing& keys) {
  if (envelope.receiver != hub_node || envelope.echo != session_) return {};
  if (envelope.kind == EnvelopeKind::stopped) robots_[envelope.sender] = true;
  if (envelope.kind != EnvelopeKind::answer) return {};
  DatagramReader in(envelope.payload);
  if (in.take<std::uint64_t>() != session_) return {};
  const auto asked = in.take<std::uint64_t>();
  robots_.try_emplace(envelope.sender, false);
  std::vector<Bytes> replies;
  const auto reply = [&](EnvelopeKind kind, ByteView payload) {
    replies.push_back(
        seal({kind, hub_node, envelope.sender, session_, envelope.session, ++counter_, payload}, keys.signing()));
  };
  if (asked != 0) {
    Bytes answer;
    DatagramWriter out(answer);
    out.put(asked);
    out.put(std::uint64_t{0});
    reply(EnvelopeKind::answer, answer);
  }
  reply(EnvelopeKind::stop, {});
  return replies;
}

}  // namespace banyan::udp
