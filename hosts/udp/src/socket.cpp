// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/socket.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <vector>

namespace banyan::udp {
namespace {

constexpr int buffer_bytes = 1 << 20;  // a tick of a large swarm

[[noreturn]] void fail(const std::string& what) { throw SocketError(what + ": " + std::strerror(errno)); }

// In microseconds of the wall, for ppoll.
timespec duration(double seconds) noexcept {
  const double sound = std::clamp(seconds, 0.0, 3600.0);
  const double whole = std::floor(sound);
  return {static_cast<time_t>(whole), static_cast<long>((sound - whole) * 1e9)};
}

}  // namespace

Address parse_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0)
    throw SocketError("\"" + text + "\" is no address: one such as 192.168.1.10:4600 is");
  const char* const end = text.data() + text.size();
  std::uint16_t port = 0;
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, port);
  Address address;
  address.raw.sin_family = AF_INET;
  address.raw.sin_port = htons(port);
  if (error != std::errc{} || rest != end ||
      ::inet_pton(AF_INET, text.substr(0, colon).c_str(), &address.raw.sin_addr) != 1)
    throw SocketError("\"" + text + "\" is no address: one such as 192.168.1.10:4600 is");
  return address;
}

std::vector<Address> parse_addresses(const std::string& text) {
  std::vector<Address> list;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    list.push_back(parse_address(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return list;
}

std::string to_string(const Address& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &address.raw.sin_addr, text.data(), text.size());
  return std::string(text.data()) + ":" + std::to_string(address.port());
}

Socket::Socket(const Address& local) : descriptor_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  if (descriptor_ < 0) fail("socket");
  // Smaller buffers would do, only less well.
  static_cast<void>(::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof buffer_bytes));
  static_cast<void>(::setsockopt(descriptor_, SOL_SOCKET, SO_SNDBUF, &buffer_bytes, sizeof buffer_bytes));
  const int on = 1;
  static_cast<void>(::setsockopt(descriptor_, SOL_SOCKET, SO_BROADCAST, &on, sizeof on));
  if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&local.raw), sizeof local.raw) == 0) return;
  const int error = errno;
  ::close(descriptor_);
  errno = error;
  fail(to_string(local));
}

Socket& Socket::operator=(Socket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

Socket::~Socket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Socket::send(ByteView datagram, const Address& to) const noexcept {
  static_cast<void>(::sendto(descriptor_, datagram.data(), datagram.size(), MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(&to.raw), sizeof to.raw));
}

std::optional<ByteView> Socket::receive(std::span<std::uint8_t> room, Address& from) const noexcept {
  for (;;) {
    socklen_t length = sizeof from.raw;
    const ssize_t size =
        ::recvfrom(descriptor_, room.data(), room.size(), 0, reinterpret_cast<sockaddr*>(&from.raw), &length);
    if (size >= 0) return room.first(static_cast<std::size_t>(size));
    // What is left of an earlier send to somebody who was not there.
    if (errno != ECONNREFUSED && errno != EINTR) return std::nullopt;
  }
}

Address Socket::local() const noexcept {
  Address address;
  socklen_t length = sizeof address.raw;
  static_cast<void>(::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address.raw), &length));
  return address;
}

bool Clock::wait(std::span<const int> descriptors, double until_s) const noexcept {
  std::vector<pollfd> polled;
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  const timespec left = duration((until_s - now_s()) / speed_);
  return ::ppoll(polled.data(), polled.size(), &left, nullptr) > 0;
}

}  // namespace banyan::udp
