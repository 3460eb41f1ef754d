// SPDX-License-Identifier: MIT
// A bad radio between real sockets, for machines whose kernel has none (tc netem): takes datagrams of robots, loses,
// delays, doubles and reorders them, and hands them to the hub; and those of the hub likewise.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <queue>
#include <vector>

#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {

// Of one hop: from a robot to the hub, or back.
struct Impairment {
  double loss = 0.0;            // probability
  double delay_s = 0.0;
  double jitter_s = 0.0;        // uniform in +- this
  double duplicate = 0.0;       // probability
  double reorder = 0.0;         // probability that a datagram is not delayed
  double rate_bytes_s = 0.0;    // of each robot, either way; 0: no limit
  [[nodiscard]] bool any() const noexcept {
    return loss > 0.0 || delay_s > 0.0 || jitter_s > 0.0 || duplicate > 0.0 || reorder > 0.0 || rate_bytes_s > 0.0;
  }
};
// The same of the way from robot to robot, which is two hops: both together lose, delay and double as much as given.
[[nodiscard]] Impairment per_hop(const Impairment& way) noexcept;

class Relay {
 public:
  // `speed`: of the clock in which delays and rates are meant.
  Relay(const Address& listen, const Address& hub, const Impairment& hop, std::uint64_t seed, double speed);
  // Takes in and hands on what is due, for at most that long, s of the wall.
  void pump(double seconds);
  [[nodiscard]] Address local() const noexcept { return front_.local(); }
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_; }
  [[nodiscard]] std::uint64_t handed_on() const noexcept { return handed_on_; }

 private:
  struct Side {               // of one robot
    Address robot;
    Socket socket;            // towards the hub, which so knows robots apart
    double free_s[2] = {};    // when its line is free again, by direction
  };
  struct Flight {
    double due_s = 0.0;
    std::uint64_t number = 0; // of equal moments the first comes first
    std::size_t side = 0;
    bool to_hub = false;
    Bytes bytes;
    friend bool operator>(const Flight& a, const Flight& b) noexcept {
      return a.due_s != b.due_s ? a.due_s > b.due_s : a.number > b.number;
    }
  };

  void take_in();
  void hand_on();
  void impair(std::size_t side, bool to_hub, ByteView datagram);
  [[nodiscard]] std::size_t side_of(const Address& robot);
  [[nodiscard]] double draw() noexcept;  // [0, 1)

  Socket front_;
  Address hub_;
  Impairment hop_;
  Clock clock_;
  double speed_;
  std::uint64_t random_;
  std::vector<Side> sides_;
  std::vector<int> descriptors_;
  std::priority_queue<Flight, std::vector<Flight>, std::greater<>> flights_;
  std::uint64_t taken_ = 0, handed_on_ = 0;
};

}  // namespace banyan::udp
