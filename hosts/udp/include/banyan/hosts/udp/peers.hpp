// SPDX-License-Identifier: MIT
// Robots that talk to each other without a hub: what one says is for everybody, so it cannot carry the session of its
// receiver. It counts once its session is believed (envelope.hpp), each packet once.
#pragma once

#include <map>

#include "banyan/hosts/udp/envelope.hpp"

namespace banyan::udp {

class Peers {
 public:
  // `session`: the own one, above 0.
  Peers(NodeId self, std::uint64_t session) noexcept : self_(self), session_(session) {}

  // A datagram for everybody.
  [[nodiscard]] Bytes speak(ByteView message, const KeyRing& keys);
  // One for whoever listens (listener.hpp), who is asked and believed likewise.
  [[nodiscard]] Bytes tell(ByteView account, const KeyRing& keys);

  struct Taken {
    enum class What : std::uint8_t { nothing, message, account, stop } what = What::nothing;
    bool is_contested = false;   // two programs say that they are its sender
    std::optional<Drop> drop{};  // why it was not accepted
    Bytes reply{};               // a datagram for whoever has sent it; empty: none
  };
  // An authentic packet. A message or an account is its payload.
  [[nodiscard]] Taken take(const Envelope& envelope, double now_s, const KeyRing& keys);

 private:
  NodeId self_;
  std::uint64_t session_;
  std::uint32_t spoken_ = 0;
  std::map<NodeId, SecureChannel> peers_;  // whoever has a key
};

// Stops robots without a hub: says hello to everybody, and stop to each one that answers, until it has confirmed that.
class Stopper {
 public:
  explicit Stopper(std::uint64_t session) noexcept : session_(session) {}
  [[nodiscard]] Bytes call(const KeyRing& keys);
  // What goes to whoever has answered: an answer to its own question, if it has one, and the stop. None: it was no
  // answer.
  [[nodiscard]] std::vector<Bytes> take(const Envelope& envelope, const KeyRing& keys);
  // True: that robot has stopped. False: it has answered and not yet confirmed.
  [[nodiscard]] const std::map<NodeId, bool>& robots() const noexcept { return robots_; }

 private:
  std::uint64_t session_;
  std::uint32_t counter_ = 0;
  std::map<NodeId, bool> robots_;
};

}  // namespace banyan::udp
