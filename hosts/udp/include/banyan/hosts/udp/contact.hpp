// SPDX-License-Identifier: MIT
// From whom a robot's process learns what its robot hears and where it is to go: a hub, or its base and its peers.
#pragma once

#include <memory>
#include <optional>

#include "banyan/hosts/udp/driver.hpp"
#include "banyan/hosts/udp/envelope.hpp"
#include "banyan/hosts/udp/refusals.hpp"
#include "banyan/hosts/udp/robot.hpp"
#include "banyan/hosts/udp/robot_options.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {

class Contact {
 public:
  virtual ~Contact() = default;
  // An authentic datagram; why it is dropped, if it is.
  virtual std::optional<Drop> take(const Envelope& envelope, const Address& from, double now_s) = 0;
  // Before each step: what the robot has to know of this moment.
  virtual void guide(double now_s) = 0;
  // After a step.
  virtual void tell(const Status& status) = 0;
  // Instead of a step, while nothing guides the robot.
  virtual void greet(double now_s) = 0;
  // Its program ends unasked: it will not be heard again.
  virtual void leave() {}
  // It was told to stop, and not to go on.
  [[nodiscard]] bool is_stopped() const noexcept { return stopped_; }

 protected:
  Contact() = default;
  bool stopped_ = false;
};

// What a contact has to do with; all of it must outlive it.
struct ContactEnds {
  const RobotOptions& options;
  const Socket& socket;
  const Driver& driver;
  UdpRobot& robot;
  const KeyRing& keys;
  Refusals& refusals;
};
[[nodiscard]] std::unique_ptr<Contact> contact_with_hub(const ContactEnds& ends);    // throws SocketError
[[nodiscard]] std::unique_ptr<Contact> contact_with_peers(const ContactEnds& ends);  // throws SocketError

}  // namespace banyan::udp
