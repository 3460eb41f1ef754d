// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/robot_process.hpp"

#include <signal.h>

#include <array>
#include <atomic>

#include "banyan/hosts/udp/driver.hpp"
#include "banyan/hosts/udp/envelope.hpp"
#include "banyan/hosts/udp/line_base.hpp"
#include "banyan/hosts/udp/robot.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {
namespace {

std::atomic<int> caught{0};     // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): all that a handler can reach
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

constexpr double hello_every_s = 0.2;
constexpr double linger_s = 0.5;  // after a stop: to answer it if it is repeated because the answer was lost

const Algorithm& known_algorithm(const RobotOptions& options, const AlgorithmList& algorithms) {
  const Algorithm* algorithm = algorithms.find(options.algorithm);
  if (algorithm == nullptr) throw OptionError("--algorithm \"" + options.algorithm + "\" is unknown");
  for (const auto& [key, value] : options.setup.parameters) {
    const auto& rows = algorithms.parameters();
    if (std::none_of(rows.begin(), rows.end(), [&key = key](const ParameterInfo& row) { return row.key == key; }))
      throw OptionError("--set " + key + " is unknown");
  }
  if (const std::string fault = algorithm->fault(options.setup); !fault.empty()) throw OptionError(fault);
  return *algorithm;
}

class Process {
 public:
  Process(const RobotOptions& options, const Algorithm& algorithm)
      : options_(options),
        keys_(read_keys(options.key_file)),
        hub_(parse_address(options.hub)),
        socket_(Address{}),
        driver_(options.base.empty() ? std::unique_ptr<Driver>(std::make_unique<SimulatedWheels>()) : open_line_base(options.base)),
        channel_(options.id, hub_node, new_boot()),
        robot_(algorithm, options.setup, options.id, options.stop_after_s),
        clock_(options.speed),
        next_step_s_(clock_.now_s()) {}
  ~Process() { driver_->drive({}); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int run() {
    const std::array<int, 2> descriptors{socket_.descriptor(), driver_->descriptor()};
    while (caught == 0 && !driver_->lost() && (stopped_s_ < 0.0 || clock_.now_s() < stopped_s_ + linger_s * options_.speed)) {
      clock_.wait(descriptors, next_step_s_);
      if (reread.exchange(false)) reread_keys();
      driver_->listen(clock_.now_s());
      hear();
      if (clock_.now_s() >= next_step_s_) act(clock_.now_s());
    }
    return caught != 0 ? 128 + caught : driver_->lost() ? 1 : 0;
  }

 private:
  // A file that is wrong changes nothing: a robot on its way keeps the keys that it has.
  void reread_keys() {
    try {
      keys_ = read_keys(options_.key_file);
    } catch (const KeyError& error) {
      std::fprintf(stderr, "banyan-robot %d: %s; the keys stay as they were\n", options_.id, error.what());
    }
  }

  void hear() {
    std::array<std::uint8_t, largest_datagram + 1> room;
    Address from;
    while (const auto datagram = socket_.receive(room, from)) {
      Drop reason{};
      const auto envelope = authenticate(*datagram, keys_, reason);
      if (!envelope || channel_.admit(*envelope) || !take(*envelope)) ++dropped_;
    }
  }

  bool take(const Envelope& envelope) {
    const double now_s = clock_.now_s();
    const auto at = driver_->pose_at(now_s - options_.delay_s);
    switch (envelope.kind) {
      case Kind::frame:
        if (const auto frame = decode_frame(envelope.payload)) return robot_.take(*frame, now_s, at), true;
        return false;
      case Kind::heard:
        if (const auto heard = decode_heard(envelope.payload)) return robot_.take(*heard, at), true;
        return false;
      case Kind::stop:
        driver_->drive({});
        if (stopped_s_ < 0.0) stopped_s_ = now_s;
        say(Kind::stopped, {});
        return true;
      default: return false;
    }
  }

  void act(double now_s) {
    next_step_s_ += static_cast<double>(options_.setup.platform.tick_s);
    if (next_step_s_ < now_s) next_step_s_ = now_s + static_cast<double>(options_.setup.platform.tick_s);  // it was held up
    if (stopped_s_ >= 0.0 || !robot_.is_guided(now_s)) {
      driver_->drive({});
      if (stopped_s_ < 0.0) greet(now_s);
      return;
    }
    Status status = robot_.step(now_s, driver_->pose_at(now_s), driver_->obstacles());
    status.dropped = dropped_;
    driver_->drive(status.velocity);
    say(Kind::status, encode(status));
  }

  void greet(double now_s) {
    if (now_s < next_hello_s_) return;
    next_hello_s_ = now_s + hello_every_s;
    say(Kind::hello, {});
  }

  void say(Kind kind, const Bytes& payload) { socket_.send(channel_.seal(kind, payload, keys_), hub_); }

  RobotOptions options_;
  KeyRing keys_;
  Address hub_;
  Socket socket_;
  std::unique_ptr<Driver> driver_;
  Channel channel_;
  Robot robot_;
  Clock clock_;
  double next_step_s_;
  double next_hello_s_ = 0.0;
  double stopped_s_ = -1.0;
  std::uint32_t dropped_ = 0;
};

}  // namespace

int run_robot(const RobotOptions& options, const AlgorithmList& algorithms) {
  catch_signals();
  return Process(options, known_algorithm(options, algorithms)).run();
}

}  // namespace banyan::udp
