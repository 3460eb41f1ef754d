// SPDX-License-Identifier: MIT
// Robots that talk to each other without a hub: what one says is for everybody, so it cannot carry the boot number of
// its receiver. Whom a robot hears for the first time, or for the first time since that one has started again, it sends
// a hello with its own boot number, which nobody has seen before. An answer that carries this number shows that the
// other one is running now. Only then counts what it says, each packet once.
#pragma once

#include <map>

#include "banyan/hosts/udp/envelope.hpp"

namespace banyan::udp {

class Peers {
 public:
  // `boot`: the own one, above 0.
  Peers(NodeId self, std::uint64_t boot) noexcept : self_(self), boot_(boot) {}

  // A datagram for everybody.
  [[nodiscard]] Bytes speak(ByteView message, const KeyRing& keys);
  // One for whoever listens (listener.hpp), who is asked and believed likewise.
  [[nodiscard]] Bytes tell(ByteView account, const KeyRing& keys);

  struct Taken {
    enum class What : std::uint8_t { nothing, message, account, stop } what = What::nothing;
    std::optional<Drop> drop{};  // why it was not accepted
    Bytes reply{};               // a datagram for whoever has sent it; empty: none
  };
  // An authentic packet. A message or an account is its payload.
  [[nodiscard]] Taken take(const Envelope& envelope, double now_s, const KeyRing& keys);

 private:
  struct Peer {
    SecureChannel channel;
    ReplayWindow spoken;
    std::uint64_t running = 0;  // the boot that has answered; 0: none
    double ask_again_s = 0.0;   // when it may be sent the next hello
  };
  Peer& peer(NodeId node);
  [[nodiscard]] static Taken take_spoken(Peer& from, const Envelope& envelope, double now_s, const KeyRing& keys);

  NodeId self_;
  std::uint64_t boot_;
  std::uint32_t spoken_ = 0;
  std::map<NodeId, Peer> peers_;  // whoever has a key
};

// Stops robots without a hub: says hello to everybody, and stop to each one that answers, until it has confirmed that.
class Stopper {
 public:
  explicit Stopper(std::uint64_t boot) noexcept : boot_(boot) {}
  [[nodiscard]] Bytes call(const KeyRing& keys);
  // The stop for whoever has answered; empty: it was no answer.
  [[nodiscard]] Bytes take(const Envelope& envelope, const KeyRing& keys);
  // True: that robot has stopped. False: it has answered and not yet confirmed.
  [[nodiscard]] const std::map<NodeId, bool>& robots() const noexcept { return robots_; }

 private:
  std::uint64_t boot_;
  std::uint32_t counter_ = 0;
  std::map<NodeId, bool> robots_;
};

}  // namespace banyan::udp
