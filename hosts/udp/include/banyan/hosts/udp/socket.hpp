// SPDX-License-Identifier: MIT
// A UDP socket that never blocks, and a clock. What cannot be sent now is lost, as on the radio.
#pragma once

#include <netinet/in.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "banyan/hosts/udp/bytes.hpp"

namespace banyan::udp {

class SocketError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// IPv4.
struct Address {
  sockaddr_in raw{};
  [[nodiscard]] std::uint16_t port() const noexcept { return ntohs(raw.sin_port); }
  friend bool operator==(const Address& a, const Address& b) noexcept {
    return a.raw.sin_addr.s_addr == b.raw.sin_addr.s_addr && a.raw.sin_port == b.raw.sin_port;
  }
};
// "127.0.0.1:4000"; no names, which a static program cannot look up. Throws SocketError.
[[nodiscard]] Address parse_address(const std::string& text);
// Several, with commas between. Throws SocketError.
[[nodiscard]] std::vector<Address> parse_addresses(const std::string& text);
[[nodiscard]] std::string to_string(const Address& address);

class Socket {
 public:
  // Bound to `local`; port 0: any that is free. Throws SocketError.
  explicit Socket(const Address& local);
  Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Socket& operator=(Socket&& other) noexcept;
  ~Socket();

  void send(ByteView datagram, const Address& to) const noexcept;
  // The next datagram, into `room`; nothing if there is none. A longer one than `room` is cut.
  [[nodiscard]] std::optional<ByteView> receive(std::span<std::uint8_t> room, Address& from) const noexcept;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] Address local() const noexcept;

 private:
  int descriptor_ = -1;
};

// Seconds of the mission, which may pass faster than those of the wall: for tests, and for clocks that drift.
class Clock {
 public:
  explicit Clock(double speed = 1.0) noexcept : speed_(speed) {}
  [[nodiscard]] double now_s() const noexcept {
    return speed_ * std::chrono::duration<double>(Wall::now() - start_).count();
  }
  // Waits until a descriptor can be read, at most until that moment; signals end it, too. True: one can be read.
  bool wait(std::span<const int> descriptors, double until_s) const noexcept;

 private:
  using Wall = std::chrono::steady_clock;
  double speed_;
  Wall::time_point start_ = Wall::now();
};

}  // namespace banyan::udp
