// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/bases.hpp"

#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace banyan::ros2 {
namespace {

constexpr double still_after_s = 0.5;
constexpr std::size_t longest_line = 4096;

int listen_at(const udp::Address& address) {
  const int door = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  if (door >= 0 && ::setsockopt(door, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
      ::bind(door, reinterpret_cast<const sockaddr*>(&address.raw), sizeof address.raw) == 0 && ::listen(door, 4) == 0)
    return door;
  const std::string reason = std::strerror(errno);
  if (door >= 0) ::close(door);
  throw udp::SocketError("tcp:" + udp::to_string(address) + ": " + reason);
}

bool is_still(const Velocity& v) noexcept {
  return v.forward_m_s == 0.0F && v.sideways_m_s == 0.0F && v.turn_rad_s == 0.0F;
}

}  // namespace

Bases::Bases(const udp::Address& first, std::size_t robots) : Bases(robots) {
  if (first.port() != 0 && first.port() + robots > 65536)
    throw udp::SocketError(udp::to_string(first) + ": there are not " + std::to_string(robots) +
                           " ports from there on");
  udp::Address address = first;
  for (Base& base : bases_) {
    base.door = listen_at(address);
    if (first.port() != 0) address.raw.sin_port = htons(static_cast<std::uint16_t>(address.port() + 1));
  }
}

Bases::~Bases() {
  for (Base& base : bases_) {
    hang_up(base);
    if (base.door >= 0) ::close(base.door);
  }
}

void Bases::hang_up(Base& base) {
  if (base.wire >= 0) ::close(base.wire);
  base.wire = -1;
  base.begun.clear();
  base.unsent.clear();
}

// A robot that comes while another is there has been started again.
void Bases::accept(Base& base) {
  for (int wire = -1; (wire = ::accept4(base.door, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)) >= 0;) {
    hang_up(base);
    base.wire = wire;
    const int on = 1;
    static_cast<void>(::setsockopt(wire, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on));
  }
}

void Bases::read(std::size_t place, double now_s, const Drive& drive) {
  Base& base = bases_[place];
  std::array<char, 1024> room{};
  while (base.wire >= 0) {
    const ssize_t size = ::read(base.wire, room.data(), room.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == EAGAIN) return;
    if (size <= 0) return hang_up(base);
    base.begun.append(room.data(), static_cast<std::size_t>(size));
    for (std::size_t end = base.begun.find('\n'); end != std::string::npos; end = base.begun.find('\n')) {
      if (const auto velocity = udp::parse_drive_line(std::string_view(base.begun).substr(0, end))) {
        base.heard_s = now_s;
        base.moves = !is_still(*velocity);
        drive(place, *velocity);
      }
      base.begun.erase(0, end + 1);
    }
    if (base.begun.size() > longest_line) base.begun.clear();
  }
}

void Bases::listen(double now_s, const Drive& drive) {
  for (std::size_t k = 0; k < bases_.size(); ++k) {
    accept(bases_[k]);
    read(k, now_s, drive);
    if (!bases_[k].moves || (bases_[k].wire >= 0 && now_s - bases_[k].heard_s <= still_after_s)) continue;
    bases_[k].moves = false;
    drive(k, {});
  }
}

// False: the robot has gone.
bool Bases::send(Base& base) {
  while (!base.unsent.empty()) {
    const ssize_t size = ::send(base.wire, base.unsent.data(), base.unsent.size(), MSG_NOSIGNAL);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return errno == EAGAIN;
    base.unsent.erase(0, static_cast<std::size_t>(size));
  }
  return true;
}

void Bases::tell(std::size_t place, const udp::OdometricPose& pose) {
  Base& base = bases_[place];
  if (base.wire < 0) return;
  // One that does not read gets the rest of a line that was begun, and misses those in between.
  if (base.unsent.empty()) base.unsent = udp::base_pose_line(pose);
  if (!send(base)) hang_up(base);
}

void Bases::add_descriptors(std::vector<int>& list) const {
  for (const Base& base : bases_) {
    list.push_back(base.door);
    if (base.wire >= 0) list.push_back(base.wire);
  }
}

std::uint16_t Bases::port(std::size_t place) const {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  static_cast<void>(::getsockname(bases_[place].door, reinterpret_cast<sockaddr*>(&address), &length));
  return ntohs(address.sin_port);
}

}  // namespace banyan::ros2
