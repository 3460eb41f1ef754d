// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/contact.hpp"

namespace banyan::udp {
namespace {

constexpr double hello_every_s = 0.2;

class HubContact final : public Contact {
 public:
  explicit HubContact(const ContactEnds& ends)
      : ends_(ends), hub_(parse_address(ends.options.hub)), channel_(ends.options.id, hub_node, new_boot()) {}

  bool take(const Envelope& envelope, const Address& /*from*/, double now_s) override {
    if (channel_.admit(envelope)) return false;
    const auto at = ends_.driver.pose_at(now_s - ends_.options.delay_s);
    switch (envelope.kind) {
      case EnvelopeKind::frame:
        if (const auto frame = decode_frame(envelope.payload)) return ends_.robot.take(*frame, now_s, at), true;
        return false;
      case EnvelopeKind::heard:
        if (const auto heard = decode_heard(envelope.payload)) return ends_.robot.take(*heard, at), true;
        return false;
      case EnvelopeKind::stop:
        stopped_ = true;
        say(EnvelopeKind::stopped, {});
        return true;
      default: return false;
    }
  }
  void guide(double /*now_s*/) override {}
  void tell(const Status& status) override { say(EnvelopeKind::status, encode(status)); }
  void greet(double now_s) override {
    if (now_s < next_hello_s_) return;
    next_hello_s_ = now_s + hello_every_s;
    say(EnvelopeKind::hello, {});
  }

 private:
  void say(EnvelopeKind kind, const Bytes& payload) {
    ends_.socket.send(channel_.seal(kind, payload, ends_.keys), hub_);
  }

  ContactEnds ends_;
  Address hub_;
  SecureChannel channel_;
  double next_hello_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Contact> contact_with_hub(const ContactEnds& ends) { return std::make_unique<HubContact>(ends); }

}  // namespace banyan::udp
