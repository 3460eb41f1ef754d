// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/contact.hpp"

namespace banyan::udp {
namespace {

constexpr double hello_every_s = 0.2;
constexpr int patience_s = 5;

class HubContact final : public Contact {
 public:
  explicit HubContact(const ContactEnds& ends)
      : ends_(ends), hub_(parse_address(ends.options.hub)), channel_(ends.options.id, hub_node, new_session()) {}

  std::optional<Drop> take(const Envelope& envelope, const Address& from, double now_s) override {
    const SecureChannel::Taken taken = channel_.take(envelope, now_s, ends_.keys);
    if (!taken.reply.empty()) ends_.socket.send(taken.reply, from);
    // One that still waits for others says nothing else.
    if (taken.counts || (envelope.kind == EnvelopeKind::answer && !taken.drop)) greeted_ = 0;
    if (!taken.counts) return taken.drop;
    const auto at = ends_.driver.pose_at(now_s - ends_.options.delay_s);
    switch (envelope.kind) {
      case EnvelopeKind::frame:
        if (const auto frame = decode_frame(envelope.payload)) return ends_.robot.take(*frame, now_s, at), std::nullopt;
        return Drop::malformed;
      case EnvelopeKind::heard:
        if (const auto heard = decode_heard(envelope.payload)) return ends_.robot.take(*heard, at), std::nullopt;
        return Drop::malformed;
      case EnvelopeKind::stop:
        stopped_ = true;
        say(EnvelopeKind::stopped, {});
        return std::nullopt;
      default: return Drop::malformed;
    }
  }
  void guide(double /*now_s*/) override {}
  void tell(const Status& status) override { say(EnvelopeKind::status, encode(status)); }
  // Without an answer: what is lost is noticed by its silence.
  void leave() override {
    constexpr int times = 3;
    for (int k = 0; k < times && !stopped_; ++k) say(EnvelopeKind::stopped, {});
  }
  void greet(double now_s) override {
    if (now_s < next_hello_s_) return;
    if (greeted_++ == patience_s / hello_every_s)
      ends_.refusals.once("the hub at " + to_string(hub_) + " has not answered for " + std::to_string(patience_s) +
                          " s");
    next_hello_s_ = now_s + hello_every_s;
    ends_.socket.send(channel_.ask(now_s, ends_.keys), hub_);
  }

 private:
  void say(EnvelopeKind kind, const Bytes& payload) {
    ends_.socket.send(channel_.seal(kind, payload, ends_.keys), hub_);
  }

  ContactEnds ends_;
  Address hub_;
  SecureChannel channel_;
  double next_hello_s_ = 0.0;
  int greeted_ = 0;  // since it was heard last
};

}  // namespace

std::unique_ptr<Contact> contact_with_hub(const ContactEnds& ends) { return std::make_unique<HubContact>(ends); }

}  // namespace banyan::udp
