// SPDX-License-Identifier: MIT
// What surrounds every datagram of a fleet, so that nobody else takes part:
//
//   offset  bytes  field
//   0       1      0xBA
//   1       1      version, 1
//   2       1      kind (messages.hpp)
//   3       1      number of the key
//   4       2      sender: a robot's id, 0xFFFE the hub
//   6       2      receiver, likewise; 0xFFFF everybody
//   8       8      boot of the sender: grows whenever its program starts again
//   16      8      boot of the receiver as the sender knows it; 0 in a hello, from a sender that does not, and to
//   everybody 24      4      counter: 1, 2, 3, ... to this receiver since the sender's boot 28      n      payload 28 +
//   n  16     MAC: BLAKE2b with the fleet's key, over everything before
//
// A packet is accepted once. It must carry the receiver's present boot, so what was recorded before the receiver
// started is worthless; and the newest boot of its sender, so a robot that has started again is accepted and its old
// packets are not. A hello proves nothing of this: it only says that somebody is there. A broadcast has no
// receiver whose boot it could carry; peers.hpp says when it is accepted.
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
enum class Drop : std::uint8_t { foreign, forged, misaddressed, stale, replayed, malformed };
inline constexpr std::size_t drop_kinds = 6;
[[nodiscard]] const char* name_of(Drop drop) noexcept;
using DropCounts = std::array<std::uint64_t, drop_kinds>;

struct Envelope {
  EnvelopeKind kind = EnvelopeKind::hello;
  NodeId sender = 0;
  NodeId receiver = 0;
  std::uint64_t boot = 0;
  std::uint64_t echo = 0;
  std::uint32_t counter = 0;
  ByteView payload;  // into the datagram
};

// The header and the MAC, both checked; nothing of whether it is new. Nothing and the reason, if it is not ours.
[[nodiscard]] std::optional<Envelope> authenticate(ByteView datagram, const KeyRing& keys, Drop& reason) noexcept;
[[nodiscard]] Bytes seal(const Envelope& envelope, const SecretKey& key);

// Which packets of one sender have been accepted: the newest boot, its highest counter, and which of those before
// have arrived; a packet that comes more than `reach` after a later one is dropped.
class ReplayWindow {
 public:
  static constexpr std::uint32_t reach = 1024;
  // Whether the packet is new; remembers it if it is.
  [[nodiscard]] std::optional<Drop> admit(std::uint64_t boot, std::uint32_t counter) noexcept;
  [[nodiscard]] std::uint64_t boot() const noexcept { return boot_; }  // 0: none accepted yet

 private:
  std::uint64_t boot_ = 0;
  std::uint32_t highest_ = 0;
  std::bitset<reach> seen_;  // [k]: highest_ - k
};

// One end of the way between two nodes.
class SecureChannel {
 public:
  // `boot`: the own one, above 0.
  SecureChannel(NodeId self, NodeId peer, std::uint64_t boot) noexcept : self_(self), peer_(peer), boot_(boot) {}

  [[nodiscard]] Bytes seal(EnvelopeKind kind, ByteView payload, const KeyRing& keys);
  // Whether an authentic packet is from the peer, for this node, and new.
  [[nodiscard]] std::optional<Drop> admit(const Envelope& envelope) noexcept;
  [[nodiscard]] std::uint64_t peer_boot() const noexcept { return window_.boot(); }  // 0: not yet heard

 private:
  NodeId self_;
  NodeId peer_;
  std::uint64_t boot_;
  std::uint32_t counter_ = 0;
  ReplayWindow window_;
};

// A number that is larger than any earlier one of this computer, as long as its clock is not set back: microseconds
// since 1970.
[[nodiscard]] std::uint64_t new_boot() noexcept;

}  // namespace banyan::udp
