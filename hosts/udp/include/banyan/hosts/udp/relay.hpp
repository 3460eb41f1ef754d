// SPDX-License-Identifier: MIT
// A bad radio between real sockets, where the kernel's own cannot be had (network.hpp): takes datagrams of robots,
// loses, delays, doubles and reorders them, and hands them to the hub; and those of the hub likewise.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <queue>
#include <vector>

#include "banyan/hosts/udp/impairment.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {

class Relay {
 public:
  // `speed`: of the clock in which delays and rates are meant.
  Relay(const Address& listen, const Address& hub, const Impairment& hop, std::uint64_t seed, double speed);
  // Takes in and hands on what is due, for at most that long, s of the wall.
  void pump(double seconds);
  [[nodiscard]] Address local() const noexcept { return front_.local(); }
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_; }
  [[nodiscard]] std::uint64_t handed_on() const noexcept { return handed_on_; }
  [[nodiscard]] std::size_t under_way() const noexcept { return flights_.size(); }

 private:
  struct Side {  // of one robot
    Address robot;
    Socket socket;          // towards the hub, which so knows robots apart
    double free_s[2] = {};  // when its line is free again, by direction: from the hub, to it
    std::size_t under_way[2] = {};
  };
  struct Flight {
    double due_s = 0.0;
    std::uint64_t number = 0;  // of equal moments the first comes first
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
