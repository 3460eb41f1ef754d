// SPDX-License-Identifier: MIT
// A bad radio between real sockets, made by the relay and by the kernel: the same tests for both, in both directions.
// Those of the kernel are skipped where it has no netem; ./check --full runs them in a kernel that has
// (test/in_another_kernel).
#include "banyan/hosts/udp/impairment.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <ostream>
#include <vector>

#include "banyan/hosts/udp/network.hpp"
#include "banyan/hosts/udp/relay.hpp"

namespace banyan::udp {
namespace {

constexpr std::uint32_t greeting = 0xFFFFFFFF;

// A robot's socket, a hub's, and what is between them.
class Way {
 public:
  Way(Socket robot, Socket hub) : robot_(std::move(robot)), hub_(std::move(hub)) {}
  virtual ~Way() = default;
  Way(const Way&) = delete;
  Way& operator=(const Way&) = delete;
  virtual void pass(double seconds) = 0;
  [[nodiscard]] virtual Address hub_for_robot() const = 0;

  [[nodiscard]] const Socket& robot() const { return robot_; }
  [[nodiscard]] const Socket& hub() const { return hub_; }
  // Where the hub finds the robot: from where it hears it.
  [[nodiscard]] Address robot_for_hub() {
    std::array<std::uint8_t, 100> room;
    Address from;
    for (int tries = 0; tries < 1000; ++tries) {
      Bytes hello;
      DatagramWriter(hello).put(greeting);
      robot_.send(hello, hub_for_robot());
      pass(0.01);
      if (hub_.receive(room, from)) return from;
    }
    ADD_FAILURE() << "the hub hears nothing";
    return from;
  }

 private:
  Socket robot_, hub_;
};

const Address some_port = parse_address("127.0.0.1:0");

class ByRelay final : public Way {
 public:
  ByRelay(const Impairment& hop, double speed)
      : Way(Socket(some_port), Socket(some_port)), relay_(some_port, hub().local(), hop, 5, speed) {}
  void pass(double seconds) override { relay_.pump(seconds); }
  [[nodiscard]] Address hub_for_robot() const override { return relay_.local(); }

 private:
  Relay relay_;
};

// A process that does nothing, in a network of its own, and a socket in that network.
class FarEnd {
 public:
  FarEnd(const Impairment& hop, double speed) {
    std::array<int, 2> ready{};
    EXPECT_EQ(::pipe2(ready.data(), O_CLOEXEC), 0);
    Wire wire(0, hop, speed);
    process_ = ::fork();
    if (process_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      const char byte = 0;
      if (!wire.become_far_end() || ::write(ready[1], &byte, 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    ::close(ready[1]);
    char byte = 0;
    EXPECT_TRUE(wire.join(process_) && ::read(ready[0], &byte, 1) == 1);
    ::close(ready[0]);
  }
  ~FarEnd() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  FarEnd(const FarEnd&) = delete;
  FarEnd& operator=(const FarEnd&) = delete;
  [[nodiscard]] Socket socket() const {
    const int here = ::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
    const int there = ::open(("/proc/" + std::to_string(process_) + "/ns/net").c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_EQ(::setns(there, CLONE_NEWNET), 0);
    Socket socket(parse_address("10.77.0.3:0"));
    EXPECT_EQ(::setns(here, CLONE_NEWNET), 0);
    ::close(there);
    ::close(here);
    return socket;
  }

 private:
  pid_t process_ = 0;
};

class ByNetem final : public Way {
 public:
  explicit ByNetem(std::unique_ptr<FarEnd> far)
      : Way(far->socket(), Socket(parse_address(std::string(bridge_address) + ":0"))), far_(std::move(far)) {}
  void pass(double seconds) override { ::usleep(static_cast<useconds_t>(seconds * 1e6)); }
  [[nodiscard]] Address hub_for_robot() const override { return hub().local(); }

 private:
  std::unique_ptr<FarEnd> far_;
};

struct Made {
  const char* name;
  bool by_netem, to_hub;
};
void PrintTo(const Made& made, std::ostream* out) { *out << made.name; }

struct Arrival {
  std::size_t number = 0;
  double after_s = 0.0;  // of the wall, since it was sent
  double at_s = 0.0;     // since the first was
};

class BadRadio : public testing::TestWithParam<Made> {
 protected:
  // This process goes into the network once and stays there; what other tests need is there, too.
  void SetUp() override {
    if (!GetParam().by_netem) return;
    static const bool entered = enter_network();
    if (!entered) GTEST_SKIP() << "this machine does not allow network namespaces";
    if (const std::string fault = netem_fault({}, 1.0); !fault.empty()) GTEST_SKIP() << "no netem: " << fault;
  }
  static std::unique_ptr<Way> make(const Impairment& hop, double speed) {
    if (GetParam().by_netem) return std::make_unique<ByNetem>(std::make_unique<FarEnd>(hop, speed));
    return std::make_unique<ByRelay>(hop, speed);
  }
  // Numbered datagrams, in the order in which they arrive.
  static std::vector<Arrival> sent_through(const Impairment& hop, std::size_t count, double wait_s,
                                           double speed = 1.0) {
    constexpr std::size_t bytes = 40;
    const auto way = make(hop, speed);
    const Address robot = way->robot_for_hub();
    const Clock clock;
    std::vector<Arrival> arrivals;
    std::vector<double> sent_s;
    const auto collect = [&] {
      std::array<std::uint8_t, 2000> room;
      Address from;
      while (const auto datagram = (GetParam().to_hub ? way->hub() : way->robot()).receive(room, from))
        if (const auto number = DatagramReader(*datagram).take<std::uint32_t>(); number != greeting)
          arrivals.push_back({number, clock.now_s() - sent_s[number], clock.now_s() - sent_s[0]});
    };
    for (std::size_t k = 0; k < count; ++k) {
      Bytes datagram;
      DatagramWriter(datagram).put(static_cast<std::uint32_t>(k));
      datagram.resize(bytes);
      sent_s.push_back(clock.now_s());
      if (GetParam().to_hub) way->robot().send(datagram, way->hub_for_robot());
      else way->hub().send(datagram, robot);
      if (k % 20 == 19) way->pass(0.001);
      collect();
    }
    while (clock.now_s() < sent_s.back() + wait_s) {
      way->pass(0.001);
      collect();
    }
    return arrivals;
  }
  // A machine that is held up makes everything late: what should be early has to be so in one of three tries.
  template <class Early>
  static std::vector<Arrival> sent_early(const Early& early, const Impairment& hop, std::size_t count, double wait_s,
                                         double speed = 1.0) {
    auto arrivals = sent_through(hop, count, wait_s, speed);
    for (int tries = 1; tries < 3 && !early(arrivals); ++tries) arrivals = sent_through(hop, count, wait_s, speed);
    EXPECT_TRUE(early(arrivals));
    return arrivals;
  }
  static bool in_order(const std::vector<Arrival>& arrivals) {
    return std::ranges::is_sorted(arrivals, {}, &Arrival::number);
  }
  static double shortest_s(const std::vector<Arrival>& arrivals) {
    return std::ranges::min(arrivals, {}, &Arrival::after_s).after_s;
  }
  static double mean_s(const std::vector<Arrival>& arrivals) {
    double sum = 0.0;
    for (const Arrival& arrival : arrivals) sum += arrival.after_s;
    return sum / static_cast<double>(arrivals.size());
  }
};

TEST_P(BadRadio, LosesAndDoublesAsManyAsItShould) {
  constexpr std::size_t count = 4000;
  const auto lost = sent_through({.loss = 0.3}, count, 0.05);
  EXPECT_NEAR(static_cast<double>(lost.size()), 0.7 * count, 5.0 * std::sqrt(0.3 * 0.7 * count));
  const auto doubled = sent_through({.duplicate = 0.2}, count, 0.05);
  EXPECT_NEAR(static_cast<double>(doubled.size()), 1.2 * count, 5.0 * std::sqrt(0.2 * 0.8 * count));
}

TEST_P(BadRadio, DelaysInOrder) {
  const auto still =
      sent_early([](const auto& arrivals) { return mean_s(arrivals) < 0.05; }, {.delay_s = 0.03}, 100, 0.2);
  ASSERT_EQ(still.size(), 100U);
  EXPECT_TRUE(in_order(still));
  EXPECT_GE(shortest_s(still), 0.03);
  // In a clock that is ten times as fast.
  const auto fast =
      sent_early([](const auto& arrivals) { return mean_s(arrivals) < 0.08; }, {.delay_s = 0.5}, 10, 0.2, 10.0);
  ASSERT_EQ(fast.size(), 10U);
  EXPECT_GE(shortest_s(fast), 0.05);
}

// What is uniform between 10 and 50 ms is 30 ms in the mean of 200, give or take three times 0.8 ms.
TEST_P(BadRadio, VariesTheDelayAsMuchAsItShould) {
  const auto jittered = sent_early([](const auto& arrivals) { return mean_s(arrivals) < 0.04; },
                                   {.delay_s = 0.03, .jitter_s = 0.02}, 200, 0.2);
  ASSERT_EQ(jittered.size(), 200U);
  EXPECT_GE(shortest_s(jittered), 0.01);
  EXPECT_LT(shortest_s(jittered), 0.02);
  EXPECT_GT(mean_s(jittered), 0.027);
  EXPECT_FALSE(in_order(jittered));
}

TEST_P(BadRadio, LetsSomeOvertakeOthers) {
  const auto half_at_once = [](const std::vector<Arrival>& arrivals) {
    const auto at_once = std::ranges::count_if(arrivals, [](const Arrival& arrival) { return arrival.after_s < 0.05; });
    return std::abs(static_cast<double>(at_once) - 100.0) < 5.0 * std::sqrt(50.0);
  };
  const auto overtaken = sent_early(half_at_once, {.delay_s = 0.05, .reorder = 0.5}, 200, 0.2);
  ASSERT_EQ(overtaken.size(), 200U);
  EXPECT_FALSE(in_order(overtaken));
}

// Of what datagrams contain: with their headers, 400 of 40 bytes would take twice as long.
TEST_P(BadRadio, LimitsTheRate) {
  const auto arrivals =
      sent_early([](const auto& all) { return all.back().at_s < 0.6; }, {.rate_bytes_s = 4e4}, 400, 0.9);
  ASSERT_EQ(arrivals.size(), 400U);
  EXPECT_TRUE(in_order(arrivals));
  EXPECT_GE(arrivals.back().at_s, 0.39);
}

INSTANTIATE_TEST_SUITE_P(Each, BadRadio,
                         testing::Values(Made{"RelayToHub", false, true}, Made{"RelayFromHub", false, false},
                                         Made{"NetemToHub", true, true}, Made{"NetemFromHub", true, false}),
                         [](const testing::TestParamInfo<Made>& info) { return info.param.name; });

TEST(Impairment, TwoHopsMakeTheWay) {
  const Impairment hop =
      per_hop({.loss = 0.3, .delay_s = 0.02, .jitter_s = 0.01, .duplicate = 0.1, .reorder = 0.0, .rate_bytes_s = 7.0});
  EXPECT_NEAR((1.0 - hop.loss) * (1.0 - hop.loss), 0.7, 1e-12);
  EXPECT_NEAR((1.0 - hop.duplicate) * (1.0 - hop.duplicate), 0.9, 1e-12);
  EXPECT_EQ(hop.delay_s, 0.01);
  EXPECT_EQ(hop.jitter_s, 0.005);
  EXPECT_EQ(hop.rate_bytes_s, 7.0);
}

TEST(Impairment, InTheWordsOfTc) {
  EXPECT_EQ(netem_words({}, 1.0), "netem limit 10000");
  EXPECT_EQ(
      netem_words(
          {.loss = 0.25, .delay_s = 0.02, .jitter_s = 0.01, .duplicate = 0.1, .reorder = 0.05, .rate_bytes_s = 1250.0},
          5.0),
      "netem limit 10000 delay 4000us 2000us reorder 5.000000% loss random 25.000000% duplicate 10.000000% rate "
      "50000bit -42");
  EXPECT_EQ(netem_words({.reorder = 0.5}, 1.0), "netem limit 10000");  // nothing is delayed that could be overtaken
}

}  // namespace
}  // namespace banyan::udp
