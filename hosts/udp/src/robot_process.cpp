// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/robot_process.hpp"

#include <signal.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "banyan/controller/core/printable.hpp"
#include "banyan/hosts/udp/contact.hpp"
#include "banyan/hosts/udp/line_base.hpp"
#include "banyan/hosts/udp/mavlink_base.hpp"

namespace banyan::udp {
namespace {

std::atomic<int> caught{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): all that a handler can reach
std::atomic<bool> reread{false};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void catch_signals() {
  struct sigaction action {};
  ::sigemptyset(&action.sa_mask);
  action.sa_handler = [](int number) { caught = number; };
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = [](int) { reread = true; };
  ::sigaction(SIGHUP, &action, nullptr);
  ::signal(SIGPIPE, SIG_IGN);  // a base that goes away is noticed when it is read
}

constexpr double longest_wait_s = 0.05;  // however long a step is, the base may have something to do
constexpr double linger_s = 0.5;         // after a stop: to answer it if it is repeated because the answer was lost

const Algorithm& known_algorithm(const RobotOptions& options, const AlgorithmList& algorithms) {
  const Algorithm* algorithm = algorithms.find(options.algorithm);
  if (algorithm == nullptr) throw OptionError("--algorithm \"" + options.algorithm + "\" is unknown");
  for (const auto& [key, value] : options.setup.parameters) {
    const auto& rows = algorithms.parameters();
    if (std::none_of(rows.begin(), rows.end(), [&key = key](const ParameterInfo& row) { return row.key == key; }))
      throw OptionError("--set " + key + " is unknown");
  }
  if (const std::string fault = algorithm->fault(options.setup); !fault.empty()) throw OptionError(fault);
  if (options.max_payload > 0)
    if (const auto fault = payload_fault(*algorithm, options.setup, options.max_payload, algorithms); !fault.empty())
      throw OptionError("--max-payload: " + fault);
  return *algorithm;
}

class Process {
 public:
  Process(const RobotOptions& options, const Algorithm& algorithm)
      : options_(options),
        keys_(options.key_file),
        socket_(options.listen.empty() ? Address{} : parse_address(options.listen)),
        driver_(make_driver(options)),
        robot_(algorithm, options.setup, options.id, options.stop_after_s, options.proximity_m),
        contact_(make_contact({options_, socket_, *driver_, robot_, keys_.keys(), refusals_})),
        clock_(options.speed),
        next_step_s_(clock_.now_s()) {
    refusals_.tell([this](const std::string& text) { say(text); });
  }
  ~Process() { driver_->drive({}); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int run() {
    const std::array<int, 2> descriptors{socket_.descriptor(), driver_->descriptor()};
    while (caught == 0 && !driver_->lost() &&
           (stopped_s_ < 0.0 || clock_.now_s() < stopped_s_ + linger_s * options_.speed)) {
      clock_.wait(descriptors, std::min(next_step_s_, clock_.now_s() + longest_wait_s));
      if (reread.exchange(false)) refresh_keys(true);
      driver_->listen(clock_.now_s());
      tell_fault();
      hear();
      if (clock_.now_s() >= next_step_s_) act(clock_.now_s());
    }
    if (caught != 0 || driver_->lost()) contact_->leave();
    return caught != 0 ? 128 + caught : driver_->lost() ? 1 : 0;
  }

 private:
  static std::unique_ptr<Driver> make_driver(const RobotOptions& options) {
    if (options.base.empty()) return std::make_unique<SimulatedWheels>();
    return is_mavlink(options.base) ? open_mavlink_base(options) : open_line_base(options.base);
  }
  static std::unique_ptr<Contact> make_contact(const ContactEnds& ends) {
    return ends.options.peers.empty() ? contact_with_hub(ends) : contact_with_peers(ends);
  }

  void refresh_keys(bool anyway = false) {
    if (const std::string fault = keys_.refresh(anyway); !fault.empty()) say(fault);
  }

  void say(const std::string& text) const {
    std::fprintf(stderr, "banyan-robot %d: %s\n", options_.id, printable(text).c_str());
  }

  void tell_fault() {
    if (driver_->fault() == told_fault_) return;
    told_fault_ = driver_->fault();
    say(told_fault_.empty() ? "its base is all right again" : told_fault_ + "; it is told to stand still");
  }

  void hear() {
    std::array<std::uint8_t, largest_datagram + 1> room;
    Address from;
    while (const auto datagram = socket_.receive(room, from)) {
      const double now_s = clock_.now_s();
      Drop reason{};
      const auto envelope = authenticate(*datagram, keys_.keys(), reason);
      const std::optional<Drop> drop = envelope ? contact_->take(*envelope, from, now_s) : reason;
      if (drop) {
        ++dropped_;
        refusals_.refuse(*drop, from, envelope ? std::optional(envelope->sender) : std::nullopt);
      }
      if (!contact_->is_stopped() || stopped_s_ >= 0.0) continue;
      driver_->drive({});
      stopped_s_ = now_s;
    }
  }

  void act(double now_s) {
    const double tick_s = static_cast<double>(options_.setup.platform.tick_s);
    next_step_s_ += tick_s;
    if (next_step_s_ < now_s) next_step_s_ = now_s + tick_s;  // it was held up
    refresh_keys();
    if (stopped_s_ >= 0.0) return driver_->drive({});
    contact_->guide(now_s);
    if (!robot_.is_guided(now_s)) {
      driver_->drive({});
      return contact_->greet(now_s);
    }
    Status status = robot_.step(now_s, driver_->pose_at(now_s), driver_->obstacles());
    status.dropped = dropped_ + robot_.refused();
    driver_->drive(status.velocity);
    contact_->tell(status);
  }

  RobotOptions options_;
  KeyFile keys_;
  Socket socket_;
  std::unique_ptr<Driver> driver_;
  UdpRobot robot_;
  Refusals refusals_;
  std::unique_ptr<Contact> contact_;
  Clock clock_;
  double next_step_s_;
  double stopped_s_ = -1.0;
  std::uint32_t dropped_ = 0;
  std::string told_fault_;
};

}  // namespace

int run_robot(const RobotOptions& options, const AlgorithmList& algorithms) {
  catch_signals();
  return Process(options, known_algorithm(options, algorithms)).run();
}

}  // namespace banyan::udp
