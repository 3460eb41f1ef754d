// SPDX-License-Identifier: MIT
// What is wrong with a radio. Two make it so: the wires of network namespaces (network.hpp), by the kernel, and a relay
// between the real sockets (relay.hpp). They mean the same by it; docs/robots.md says where they differ.
#pragma once

#include <cstddef>

namespace banyan::udp {

// Of one hop: from a robot to the hub, or back.
struct Impairment {
  double loss = 0.0;  // probability
  double delay_s = 0.0;
  double jitter_s = 0.0;      // uniform in +- this
  double duplicate = 0.0;     // probability
  double reorder = 0.0;       // probability that a datagram is not delayed
  double rate_bytes_s = 0.0;  // of each robot, either way, of what datagrams contain; 0: no limit
  [[nodiscard]] bool any() const noexcept {
    return loss > 0.0 || delay_s > 0.0 || jitter_s > 0.0 || duplicate > 0.0 || reorder > 0.0 || rate_bytes_s > 0.0;
  }
};
// The same of the way from robot to robot, which is two hops: both together lose, delay and double as much as given.
[[nodiscard]] Impairment per_hop(const Impairment& way) noexcept;

// Datagrams under way in one direction of a robot; more are lost.
inline constexpr std::size_t most_under_way = 10000;

}  // namespace banyan::udp
