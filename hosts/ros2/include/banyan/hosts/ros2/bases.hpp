// SPDX-License-Identifier: MIT
// The other end of banyan-robot's line protocol (banyan/hosts/udp/line_base.hpp) over TCP, for several robots: each has
// a port of its own. A robot that has said nothing for half a second, or has gone, stands still.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "banyan/hosts/udp/line_base.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::ros2 {

class Bases {
 public:
  using Drive = std::function<void(std::size_t place, const Velocity&)>;

  // The first listens at `first`, the others at the ports that follow; port 0: any, for each. Throws udp::SocketError.
  Bases(const udp::Address& first, std::size_t robots);
  ~Bases();
  Bases(const Bases&) = delete;
  Bases& operator=(const Bases&) = delete;

  // Takes in what has come, and calls `drive` for each command, and once for a robot that is to stand still.
  void listen(double now_s, const Drive& drive);
  // Tells a robot its odometry, if it is there.
  void tell(std::size_t place, const udp::OdometricPose& pose);
  // Of all sockets that are to be watched.
  void add_descriptors(std::vector<int>& list) const;
  [[nodiscard]] std::uint16_t port(std::size_t place) const;

 private:
  explicit Bases(std::size_t robots) : bases_(robots) {}
  struct Base {
    int door = -1;      // listens
    int wire = -1;      // to the robot, if it is there
    std::string begun;  // a line whose end has not come
    std::string unsent;
    bool moves = false;
    double heard_s = 0.0;
  };
  static void accept(Base& base);
  static void hang_up(Base& base);
  static bool send(Base& base);
  void read(std::size_t place, double now_s, const Drive& drive);
  std::vector<Base> bases_;
};

}  // namespace banyan::ros2
