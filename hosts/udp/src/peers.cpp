// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/peers.hpp"

namespace banyan::udp {
namespace {

constexpr double ask_every_s = 0.2;

}  // namespace

Peers::Peer& Peers::peer(NodeId node) {
  return peers_.try_emplace(node, Peer{SecureChannel(self_, node, boot_), {}, 0, 0.0}).first->second;
}

Bytes Peers::speak(ByteView message, const KeyRing& keys) {
  return seal({EnvelopeKind::spoken, self_, everybody, boot_, 0, ++spoken_, message}, keys.signing());
}

Bytes Peers::tell(ByteView account, const KeyRing& keys) {
  return seal({EnvelopeKind::account, self_, hub_node, boot_, 0, ++spoken_, account}, keys.signing());
}

Peers::Taken Peers::take_spoken(Peer& from, const Envelope& envelope, double now_s, const KeyRing& keys) {
  Taken taken;
  if (envelope.boot == from.running) {
    taken.drop = from.spoken.admit(envelope.boot, envelope.counter);
    if (!taken.drop) taken.what = Taken::What::message;
  } else if (envelope.boot < from.running) {
    taken.drop = Drop::stale;
  } else if (now_s >= from.ask_again_s) {
    from.ask_again_s = now_s + ask_every_s;
    taken.reply = from.channel.seal(EnvelopeKind::hello, {}, keys);
  }
  return taken;
}

Peers::Taken Peers::take(const Envelope& envelope, double now_s, const KeyRing& keys) {
  if (envelope.sender == self_) return {};  // a broadcast comes back
  Peer& from = peer(envelope.sender);
  if (envelope.kind == EnvelopeKind::spoken) {
    if (envelope.receiver != everybody || envelope.sender == hub_node) return {.drop = Drop::misaddressed};
    return take_spoken(from, envelope, now_s, keys);
  }
  if (envelope.kind == EnvelopeKind::account) {
    if (self_ != hub_node || envelope.receiver != hub_node) return {.drop = Drop::misaddressed};
    Taken told = take_spoken(from, envelope, now_s, keys);
    if (told.what == Taken::What::message) told.what = Taken::What::account;
    return told;
  }
  Envelope direct = envelope;
  const bool calls_all =
      envelope.kind == EnvelopeKind::hello && envelope.sender == hub_node && envelope.receiver == everybody;
  if (calls_all) direct.receiver = self_;
  Taken taken;
  taken.drop = from.channel.admit(direct);
  if (taken.drop) return taken;
  if (envelope.kind == EnvelopeKind::hello) {
    taken.reply = from.channel.seal(EnvelopeKind::answer, {}, keys);
  } else if (envelope.kind == EnvelopeKind::answer) {
    from.running = envelope.boot;
  } else if (envelope.kind == EnvelopeKind::stop && envelope.sender == hub_node) {
    taken.what = Taken::What::stop;
    taken.reply = from.channel.seal(EnvelopeKind::stopped, {}, keys);
  } else {
    taken.drop = Drop::malformed;
  }
  return taken;
}

Bytes Stopper::call(const KeyRing& keys) {
  return seal({EnvelopeKind::hello, hub_node, everybody, boot_, 0, ++counter_, {}}, keys.signing());
}

Bytes Stopper::take(const Envelope& envelope, const KeyRing& keys) {
  if (envelope.receiver != hub_node || envelope.echo != boot_) return {};
  if (envelope.kind == EnvelopeKind::stopped) robots_[envelope.sender] = true;
  if (envelope.kind != EnvelopeKind::answer) return {};
  robots_.try_emplace(envelope.sender, false);
  return seal({EnvelopeKind::stop, hub_node, envelope.sender, boot_, envelope.boot, ++counter_, {}}, keys.signing());
}

}  // namespace banyan::udp
