// SPDX-License-Identifier: MIT
// What surrounds every datagram of a fleet, so that nobody else takes part:
//
//   offset  bytes  field
//   0       1      0xBA
//   1       1      version, 2
//   2       1      kind (messages.hpp)
//   3       1      number of the key
//   4       2      sender: a robot's id, 0xFFFE the hub
//   6       2      receiver, likewise; 0xFFFF everybody
//   8       8      session of the sender: a random number above 0, another one whenever its program starts
//   16      8      session of the receiver as the sender knows it; 0 to everybody and if it is unknown
//   24      4      counter: 1, 2, 3, ... of this sender's session to this receiver
//   28      n      payload
//   28 + n  16     MAC: BLAKE2b with the fleet's key, over everything before
//
// A session is believed once it has answered a question that was asked just now: a hello carries a random number, and
// the answer repeats it. So nothing that was recorded earlier makes anybody believe in a sender, and nobody needs a
// clock. Of a session that is believed each packet counts once. An id belongs to the session that has it until that
// one has been silent for a second.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "banyan/hosts/udp/bytes.hpp"
#include "banyan/hosts/udp/key.hpp"

namespace banyan::udp {

using NodeId = std::uint16_t;  // who sends and receives
inline constexpr NodeId hub_node = 0xFFFE;
inline constexpr NodeId everybody = 0xFFFF;
inline constexpr std::size_t most_fleet_robots = hub_node;

enum class EnvelopeKind : std::uint8_t { hello, status, frame, heard, stop, stopped, answer, spoken, account };
inline constexpr EnvelopeKind last_kind = EnvelopeKind::account;

inline constexpr std::size_t header_bytes = 28;
inline constexpr std::size_t mac_bytes = 16;
inline constexpr std::size_t largest_datagram = 1472;  // what one Ethernet frame carries

// Why a datagram was dropped.
enum class Drop : std::uint8_t { foreign, forged, misaddressed, stale, replayed, malformed, in_use };
inline constexpr std::size_t drop_kinds = 7;
[[nodiscard]] const char* name_of(Drop drop) noexcept;
using DropCounts = std::array<std::uint64_t, drop_kinds>;

struct Envelope {
  EnvelopeKind kind = EnvelopeKind::hello;
  NodeId sender = 0;
  NodeId receiver = 0;
  std::uint64_t session = 0;
  std::uint64_t echo = 0;
  std::uint32_t counter = 0;
  ByteView payload;  // into the datagram
};

// The header and the MAC, both checked; nothing of whether it is new. Nothing and the reason, if it is not ours.
[[nodiscard]] std::optional<Envelope> authenticate(ByteView datagram, const KeyRing& keys, Drop& reason) noexcept;
[[nodiscard]] Bytes seal(const Envelope& envelope, const SecretKey& key);

// Which packets of one session have been accepted: its highest counter, and which of those before have arrived; a
// packet that comes more than `reach` after a later one is dropped.
class ReplayWindow {
 public:
  static constexpr std::uint32_t reach = 1024;
  // Whether the packet is new; remembers it if it is.
  [[nodiscard]] std::optional<Drop> admit(std::uint32_t counter) noexcept;

 private:
  std::uint32_t highest_ = 0;
  std::bitset<reach> seen_;  // [k]: highest_ - k
};

// One end of the way between two nodes.
class SecureChannel {
 public:
  // `session`: the own one, above 0.
  SecureChannel(NodeId self, NodeId peer, std::uint64_t session) noexcept
      : self_(self), peer_(peer), session_(session) {}

  // Of any kind but hello and answer.
  [[nodiscard]] Bytes seal(EnvelopeKind kind, ByteView payload, const KeyRing& keys);
  // A hello: asks the peer whether it is there, by a number that only its next answer may repeat.
  [[nodiscard]] Bytes ask(double now_s, const KeyRing& keys);

  struct Taken {
    bool counts = false;        // the payload is new, and from a session that is believed
    bool is_met = false;        // another session of the peer is believed from now on
    bool is_contested = false;  // another session, too, says that it is the peer's, while this one is running
    std::optional<Drop> drop{};
    Bytes reply{};  // for whoever has sent it; empty: none
  };
  // An authentic packet. `now_s` in seconds of any clock that does not go back.
  [[nodiscard]] Taken take(const Envelope& envelope, double now_s, const KeyRing& keys);
  [[nodiscard]] std::uint64_t peer_session() const noexcept { return believed_; }  // 0: none is believed

 private:
  [[nodiscard]] Bytes seal(EnvelopeKind kind, std::uint64_t echo, ByteView payload, const KeyRing& keys);
  [[nodiscard]] bool has_owner(double now_s) const noexcept;
  [[nodiscard]] bool may_ask(double now_s) const noexcept { return question_ == 0 || now_s - asked_s_ >= ask_every_s; }
  [[nodiscard]] std::uint64_t question(double now_s);
  [[nodiscard]] Bytes answer(const Envelope& to, std::uint64_t question, double now_s, const KeyRing& keys);
  [[nodiscard]] Taken take_hello(const Envelope& hello, double now_s, const KeyRing& keys);
  [[nodiscard]] Taken take_answer(const Envelope& answer, double now_s, const KeyRing& keys);
  [[nodiscard]] Taken take_from_stranger(double now_s, const KeyRing& keys);

  NodeId self_;
  NodeId peer_;
  std::uint64_t session_;
  std::uint32_t counter_ = 0;
  std::uint64_t believed_ = 0;                // the peer's session; 0: none
  double heard_s_ = 0.0;                      // when something of it counted last
  ReplayWindow direct_, to_any_;              // what it sends to this node, and to whoever listens
  static constexpr double ask_every_s = 0.2;  // a stranger, at most
  std::uint64_t question_ = 0;                // that the peer has not answered; 0: none
  double made_s_ = 0.0;                       // when it was asked first,
  double asked_s_ = 0.0;                      // and last by a hello
  std::optional<double> rival_s_;             // when another session was refused first because this one has the id
};

// A random number above 0.
[[nodiscard]] std::uint64_t new_session();

}  // namespace banyan::udp
