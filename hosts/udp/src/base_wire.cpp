// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/base_wire.hpp"

#include <fcntl.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {
namespace {

constexpr std::array<std::pair<int, speed_t>, 6> serial_speeds{
    {{38400, B38400}, {57600, B57600}, {115200, B115200}, {230400, B230400}, {460800, B460800}, {921600, B921600}}};

speed_t speed_of(const std::string& path, int baud) {
  const auto* const found =
      std::find_if(serial_speeds.begin(), serial_speeds.end(), [=](const auto& speed) { return speed.first == baud; });
  if (found != serial_speeds.end()) return found->second;
  std::string known;
  for (const auto& speed : serial_speeds) known += (known.empty() ? "" : ", ") + std::to_string(speed.first);
  throw BaseError(path + ": " + std::to_string(baud) + " baud is unknown; known are " + known);
}

}  // namespace

int connect_tcp(const std::string& name) {
  Address address;
  try {
    address = parse_address(name);
  } catch (const SocketError& error) { throw BaseError(error.what()); }
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0 ||
      ::connect(descriptor, reinterpret_cast<const sockaddr*>(&address.raw), sizeof address.raw) != 0) {
    const int error = errno;
    if (descriptor >= 0) ::close(descriptor);
    throw BaseError("tcp:" + name + ": " + std::strerror(error));
  }
  const int on = 1;
  static_cast<void>(::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on));
  static_cast<void>(::fcntl(descriptor, F_SETFL, O_NONBLOCK));
  return descriptor;
}

int open_serial(const std::string& path, int baud) {
  const speed_t speed = speed_of(path, baud);
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) throw BaseError(path + ": " + std::strerror(errno));
  termios settings{};
  if (::tcgetattr(descriptor, &settings) == 0) {
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, speed);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);  // whoever used it before may have set them
    if (::tcsetattr(descriptor, TCSANOW, &settings) == 0) return descriptor;
  }
  const int error = errno;
  ::close(descriptor);
  throw BaseError(path + ": is no serial device: " + std::strerror(error));
}

}  // namespace banyan::udp
