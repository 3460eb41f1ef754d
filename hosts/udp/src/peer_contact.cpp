// SPDX-License-Identifier: MIT
// Situated communication without anybody's help: the radio brings a message, the base's sensor says where its sender
// is. A message counts only with a measurement that is young enough, and within C, as in the world.
#include <cmath>
#include <set>

#include "banyan/controller/core/wire.hpp"
#include "banyan/hosts/udp/contact.hpp"
#include "banyan/hosts/udp/peers.hpp"

namespace banyan::udp {
namespace {

constexpr double measured_lately_s = 0.3;  // older ones, and their senders, may be anywhere

class PeerContact final : public Contact {
 public:
  explicit PeerContact(const ContactEnds& ends)
      : ends_(ends), addresses_(parse_addresses(ends.options.peers)), peers_(ends.options.id, new_session()) {
    if (!ends.options.tell.empty()) listener_ = parse_address(ends.options.tell);
  }

  std::optional<Drop> take(const Envelope& envelope, const Address& from, double now_s) override {
    const Peers::Taken taken = peers_.take(envelope, now_s, ends_.keys);
    if (!taken.reply.empty()) ends_.socket.send(taken.reply, from);
    if (taken.what == Peers::Taken::What::stop) stopped_ = true;
    if (taken.is_contested && envelope.sender == ends_.options.id)
      ends_.refusals.once("another program at " + to_string(from) + " says that it is robot " +
                          std::to_string(ends_.options.id) + ", too; one of them needs another --id");
    else if (taken.is_contested) ends_.refusals.rival(envelope.sender, from);
    if (taken.what == Peers::Taken::What::message) return hear(envelope, now_s);
    return taken.drop;
  }

  // The frame that a hub would send, of what the base says; none while the base is silent.
  void guide(double now_s) override {
    const auto pose_s = ends_.driver.last_pose_s();
    if (!pose_s || now_s - *pose_s > ends_.options.stop_after_s) return;
    const auto target = ends_.driver.target();
    now_s_ = now_s;
    SensorFrame frame;
    frame.tick =
        static_cast<std::uint32_t>(std::lround(now_s / static_cast<double>(ends_.options.setup.platform.tick_s))) + 1;
    frame.root = ends_.options.root;
    frame.worker = ends_.options.worker;
    frame.sent = frame.has_target = frame.worker && target;
    frame.line_of_sight = ends_.options.setup.platform.line_of_sight;
    if (target) frame.target = target->position;
    ends_.robot.take(frame, now_s, ends_.driver.pose_at(target ? target->s : now_s));
  }

  void tell(const Status& status) override {
    const Bytes datagram = peers_.speak(status.message, ends_.keys);
    for (const Address& address : addresses_) ends_.socket.send(datagram, address);
    if (listener_) ends_.socket.send(peers_.tell(encode(account_of(status)), ends_.keys), *listener_);
  }
  void greet(double /*now_s*/) override {}

 private:
  std::optional<Drop> hear(const Envelope& envelope, double now_s) {
    if (envelope.payload.size() > largest_wire) return Drop::malformed;
    others_.insert(envelope.sender);
    const auto measured = ends_.driver.neighbour(envelope.sender);
    const bool is_near = measured && now_s - measured->s <= measured_lately_s &&
                         norm(measured->position) <= ends_.options.setup.platform.communication_range_m;
    if (!is_near) return std::nullopt;  // it is there, and not a neighbour
    HeardBundle heard;
    heard.tick = ++heard_;
    heard.packets.push_back({envelope.sender, measured->position, {envelope.payload.begin(), envelope.payload.end()}});
    ends_.robot.take(heard, ends_.driver.pose_at(measured->s));
    return std::nullopt;
  }

  // As of now: what was measured a moment ago is moved on by the wheels.
  [[nodiscard]] Account account_of(const Status& status) const {
    Account account{status, ends_.driver.pose_at(now_s_).value_or(OdometricPose{}), std::nullopt, {}};
    const auto here = [&](const Measured& measured) {
      return account.odometry.inside(
          ends_.driver.pose_at(measured.s).value_or(account.odometry).outside(measured.position));
    };
    if (const auto target = ends_.driver.target(); target && ends_.options.worker) account.target = here(*target);
    for (const NodeId other : others_)
      if (const auto measured = ends_.driver.neighbour(other); measured && now_s_ - measured->s <= measured_lately_s)
        account.seen.push_back({other, here(*measured)});
    return account;
  }

  ContactEnds ends_;
  std::optional<Address> listener_;
  std::set<NodeId> others_;  // that have been heard
  double now_s_ = 0.0;       // of the last step
  std::vector<Address> addresses_;
  Peers peers_;
  std::uint32_t heard_ = 0;  // messages, so that the newest of each sender is known
};

}  // namespace

std::unique_ptr<Contact> contact_with_peers(const ContactEnds& ends) { return std::make_unique<PeerContact>(ends); }

}  // namespace banyan::udp
