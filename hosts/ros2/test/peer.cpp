// SPDX-License-Identifier: MIT
// Robots of ROS 2 as they would be elsewhere: another implementation of DDS (eProsima Fast DDS), which integrates the
// commands that it hears and publishes where its bodies are. They have no dead man's switch: what is told last, goes
// on.
//
//   banyan_ros2_peer COUNT DOMAIN SPEED MODE [bad] [stamped] [humble]
//
// MODE: pose (PoseStamped in map), odometry (Odometry in map), or both (the latter since the start). "bad": among good
// poses are others, which no program should believe. On standard output, each body at each step as in
// hosts/udp/examples/base.py; after SIGTERM, what it has seen of the other side, for the test to compare.
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <thread>

#include "peer_participant.hpp"

namespace banyan::ros2::peer {
namespace {

std::atomic<bool> peer_stopped{false};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): set by a signal

struct Choice {
  int count = 0;
  std::uint32_t domain = 0;
  double speed = 1.0;
  std::string mode;
  bool bad = false, stamped = false, humble = false;
};

struct Place {
  double x = 0.0, y = 0.0, turn = 0.0;
};
Pose in_space(const Place& at) {
  return {{at.x, at.y, 0.25, 0.0, 0.0, std::sin(at.turn / 2.0), std::cos(at.turn / 2.0)}};
}

Header header(const std::string& frame, double age_s = 0.0) {
  const auto now = std::chrono::system_clock::now().time_since_epoch() -
                   std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * age_s));
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(now);
  return {static_cast<std::int32_t>(whole.count()),
          static_cast<std::uint32_t>(std::chrono::nanoseconds(now - whole).count()), frame};
}

class Body {
 public:
  Body(Participant& participant, const Choice& choice, int number) : choice_(choice), number_(number) {
    const std::string base = "rt/robot_" + std::to_string(number);
    const int side = static_cast<int>(std::ceil(std::sqrt(choice.count)));
    const int column = number % side - side / 2, row = number / side - side / 2;
    at_ = start_ = {0.32 * column, 0.32 * row, 7.0 * number};
    if (choice.mode != "odometry") poses_ = participant.writer<PoseStamped>(base + "/pose");
    if (choice.mode != "pose") odometry_ = participant.writer<Odometry>(base + "/odom");
    commands_ = choice.stamped ? participant.reader<TwistStamped>(base + "/cmd_vel")
                               : participant.reader<Twist>(base + "/cmd_vel");
  }

  void move(double seconds) {
    if (choice_.stamped) take_all<TwistStamped>(commands_, [&](const auto& message) { command_ = message.values; });
    else take_all<Twist>(commands_, [&](const auto& message) { command_ = message.values; });
    const double c = std::cos(at_.turn), s = std::sin(at_.turn);
    at_.x += (c * command_[0] - s * command_[1]) * seconds;
    at_.y += (s * command_[0] + c * command_[1]) * seconds;
    at_.turn += command_[5] * seconds;
  }

  void publish(std::uint64_t step) {
    if (poses_ != nullptr) say({header("map"), in_space(at_)});
    if (choice_.bad && step % 5 == 0) publish_bad(step / 5 % 6);  // and so the last word of this step
    if (odometry_ == nullptr) return;
    Odometry message;
    message.child_frame_id = "robot_" + std::to_string(number_) + "/base_link";
    const bool since_start = choice_.mode == "both";
    message.header = header(since_start ? "robot_" + std::to_string(number_) + "/odom" : "map");
    message.pose = in_space(since_start ? relative() : at_);
    odometry_->write(&message);
  }
  void print() const { std::printf("%d,%.5f,%.5f,%.5f\n", number_, at_.x, at_.y, at_.turn); }
  [[nodiscard]] bool stands() const {
    return std::all_of(std::begin(command_), std::end(command_), [](double value) { return value == 0.0; });
  }

 private:
  void say(PoseStamped message) {
    if (poses_ != nullptr) poses_->write(&message);
  }
  // Each of them far from where the robot is.
  void publish_bad(std::uint64_t kind) {
    const Place wrong{at_.x + 5.0, at_.y - 5.0, at_.turn + 1.0};
    PoseStamped message{header("map"), in_space(wrong)};
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    switch (kind) {
      case 0: message.pose.values[5] = nan; break;
      case 1: message.header.frame_id = "camera"; break;
      case 2: message.header = header("map", 2.0); break;
      case 3: message.pose.values = {wrong.x, wrong.y, 0.0, 0.0, 0.0, 0.0, 0.0}; break;
      case 4: message.pose.values = {wrong.x, wrong.y, 0.0, 0.7071068, 0.0, 0.0, 0.7071068}; break;
      default: message.pose.values[0] = std::numeric_limits<double>::infinity(); break;
    }
    say(message);
  }
  [[nodiscard]] Place relative() const {
    const double dx = at_.x - start_.x, dy = at_.y - start_.y, c = std::cos(start_.turn), s = std::sin(start_.turn);
    return {c * dx + s * dy, c * dy - s * dx, at_.turn - start_.turn};
  }
  const Choice& choice_;
  int number_;
  Place at_, start_;
  std::array<double, 6> command_{};
  DataWriter* poses_ = nullptr;
  DataWriter* odometry_ = nullptr;
  DataReader* commands_ = nullptr;
};

int play(const Choice& choice) {
  Discovery discovery;
  Participant participant(choice.domain, discovery);
  std::vector<Body> bodies;
  bodies.reserve(static_cast<std::size_t>(choice.count));
  for (int i = 0; i < choice.count; ++i) bodies.emplace_back(participant, choice, i);
  DataReader* transforms = participant.reader<TFMessage>("rt/tf");
  DataReader* nodes = choice.humble
                          ? participant.reader<ParticipantEntitiesInfo<24>>("ros_discovery_info", Reading::late)
                          : participant.reader<ParticipantEntitiesInfo<16>>("ros_discovery_info", Reading::late);
  std::map<std::string, TFMessage::Transform> frames;
  using Clock = std::chrono::steady_clock;
  auto then = Clock::now();
  for (std::uint64_t step = 0; !peer_stopped; ++step) {
    std::this_thread::sleep_until(then + std::chrono::milliseconds(20));
    const auto now = Clock::now();
    for (Body& body : bodies) {
      body.move(choice.speed * std::chrono::duration<double>(now - then).count());
      body.publish(step);
      body.print();
    }
    std::fflush(stdout);
    then = now;
    take_all<TFMessage>(transforms, [&](const TFMessage& message) {
      for (const auto& t : message.transforms) frames[t.child_frame_id] = t;
    });
  }
  for (const std::string& line : discovery.lines()) std::printf("%s\n", line.c_str());
  if (choice.humble) print_nodes<24>(nodes, discovery);
  else print_nodes<16>(nodes, discovery);
  for (const auto& [child, t] : frames)
    std::printf("tf %s %s %.3f %.3f %.3f\n", t.header.frame_id.c_str(), child.c_str(), t.values[0], t.values[1],
                2.0 * std::atan2(t.values[5], t.values[6]));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].stands()) std::printf("robot %zu still moves\n", i);
  return 0;
}

}  // namespace
}  // namespace banyan::ros2::peer

int main(int argc, char** argv) {
  using namespace banyan::ros2::peer;
  if (argc < 5) return 2;
  Choice choice{std::stoi(argv[1]), static_cast<std::uint32_t>(std::stoul(argv[2])), std::stod(argv[3]), argv[4]};
  for (int k = 5; k < argc; ++k) {
    choice.bad |= std::strcmp(argv[k], "bad") == 0;
    choice.stamped |= std::strcmp(argv[k], "stamped") == 0;
    choice.humble |= std::strcmp(argv[k], "humble") == 0;
  }
  ::signal(SIGTERM, [](int) { peer_stopped = true; });
  return play(choice);
}
