// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/bridge.hpp"

#include <signal.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <set>

#include "banyan/controller/core/printable.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/hosts/ros2/bases.hpp"
#include "banyan/hosts/ros2/names.hpp"
#include "banyan/hosts/ros2/node.hpp"
#include "banyan/hosts/ros2/sightings.hpp"

namespace banyan::ros2 {
namespace {

// All that a handler can reach.
std::atomic<int> caught_by_bridge{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

constexpr double look_around_s = 0.1;
constexpr double ask_after_s = 3.0;  // a topic on which nothing has come
constexpr double last_word_s = 0.5;  // for robots to hear that they stand still

void catch_signals() {
  struct sigaction action {};
  ::sigemptyset(&action.sa_mask);
  action.sa_handler = [](int number) { caught_by_bridge = number; };
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
}

std::int64_t now_ns() { return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count(); }

class Bridge {
 public:
  explicit Bridge(const Options& options)
      : options_(options),
        node_(options),
        tracked_(options.robots, options.frame, options.max_age_s),
        odometry_(options.robots, "", options.max_age_s),
        poses_(options.robots) {
    if (!options.bases.empty()) bases_.emplace(udp::parse_address(options.bases), options.robots);
    if (!options.poses.empty()) hub_ = udp::parse_address(options.poses);
  }

  int run() {
    say("ready: " + std::to_string(options_.robots) + (options_.robots == 1 ? " robot" : " robots") + " in domain " +
        std::to_string(options_.domain));
    while (caught_by_bridge == 0) {
      clock_.wait(descriptors(), next_look_s_);
      node_.listen(
          [&](Source source, std::size_t place, const StampedPose& sighting) { take(source, place, sighting); });
      hand_on();
      if (bases_)
        bases_->listen(clock_.now_s(),
                       [&](std::size_t place, const Velocity& v) { node_.drive(place, v, stamp_ns()); });
      if (clock_.now_s() >= next_look_s_) look_around();
    }
    if (bases_)
      for (std::size_t k = 0; k < options_.robots; ++k) node_.drive(k, {}, stamp_ns());
    node_.settle(last_word_s);
    say(account());
    return 128 + caught_by_bridge;
  }

 private:
  // Without poses of a tracker, odometry says where a robot is, too.
  [[nodiscard]] Source tracker() const noexcept {
    return options_.pose_topic.empty() ? Source::odometry : Source::pose;
  }
  [[nodiscard]] Source odometer() const noexcept {
    return options_.odometry_topic.empty() ? Source::pose : Source::odometry;
  }
  // Where poses follow the clock of a simulation, commands do so, too.
  [[nodiscard]] std::int64_t stamp_ns() const { return options_.max_age_s > 0.0 ? now_ns() : newest_ns_; }
  [[nodiscard]] std::size_t id(std::size_t place) const noexcept { return options_.first + place; }

  static void say(const std::string& text) { std::fprintf(stderr, "banyan-ros2: %s\n", printable_lines(text).c_str()); }

  std::vector<int> descriptors() const {
    std::vector<int> list{node_.descriptor()};
    if (bases_) bases_->add_descriptors(list);
    return list;
  }

  [[nodiscard]] const Sightings& judge(Source source) const noexcept {
    return source == tracker() ? tracked_ : odometry_;
  }

  void take(Source source, std::size_t place, const StampedPose& sighting) {
    Refusal why{};
    const auto pose = (source == tracker() ? tracked_ : odometry_).take(place, sighting, now_ns(), why);
    if (!pose) return refuse(source, place, sighting, why);
    newest_ns_ = sighting.stamp_ns;
    if (source == odometer() && bases_)
      bases_->tell(place, {{static_cast<float>(pose->position.x), static_cast<float>(pose->position.y)},
                           static_cast<float>(pose->heading_rad)});
    if (source != tracker()) return;
    poses_[place] = BodyFrame{sighting.stamp_ns, options_.frame,   of_robot(options_.body_frame, id(place)),
                              pose->position.x,  pose->position.y, pose->heading_rad};
  }

  // The first of each kind is told at once; the account at the end has them all.
  void refuse(Source source, std::size_t place, const StampedPose& sighting, Refusal why) {
    if (!told_.insert({source, why}).second) return;
    std::string text = "robot " + std::to_string(id(place)) + ": a pose is dropped because it is " + name_of(why);
    if (why == Refusal::other_frame) text += ": \"" + sighting.frame + "\", not \"" + judge(source).frame(place) + "\"";
    const std::int64_t off_ms = (now_ns() - sighting.stamp_ns) / 1'000'000;
    if (why == Refusal::too_old) text += ": it is stamped " + std::to_string(off_ms) + " ms before now";
    if (why == Refusal::early) text += ": it is stamped " + std::to_string(-off_ms) + " ms after now";
    say(text + "; others like it are only counted");
  }

  // The newest of each robot, in as many datagrams as it takes and in one message.
  void hand_on() {
    constexpr std::size_t fits_a_packet = 1300;
    std::string lines;
    std::vector<BodyFrame> bodies;
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      if (!poses_[k]) continue;
      lines += udp::pose_line({id(k), {{poses_[k]->x_m, poses_[k]->y_m}, poses_[k]->heading_rad}});
      bodies.push_back(std::move(*poses_[k]));
      poses_[k].reset();
      if (lines.size() > fits_a_packet) tell_hub(lines);
    }
    tell_hub(lines);
    node_.publish(bodies);
  }

  void tell_hub(std::string& lines) const {
    if (hub_ && !lines.empty())
      socket_.send({reinterpret_cast<const std::uint8_t*>(lines.data()), lines.size()}, *hub_);
    lines.clear();
  }

  void look_around() {
    next_look_s_ = clock_.now_s() + look_around_s;
    if (asked_ || clock_.now_s() < ask_after_s) return;
    asked_ = true;
    if (!options_.pose_topic.empty()) name_missing(Source::pose, options_.pose_topic, "geometry_msgs/PoseStamped");
    if (!options_.odometry_topic.empty()) name_missing(Source::odometry, options_.odometry_topic, "nav_msgs/Odometry");
  }

  void name_missing(Source source, const std::string& topic, const std::string& type) const {
    for (std::size_t k = 0; k < options_.robots; ++k) {
      if (judge(source).has_seen(k)) continue;
      const std::size_t publishers = node_.publishers(source, k);
      say("robot " + std::to_string(id(k)) + ": no sound pose so far on " + of_robot(topic, id(k)) + ", which has " +
          std::to_string(publishers) + (publishers == 1 ? " publisher of " : " publishers of ") + type);
    }
  }

  [[nodiscard]] std::string account() const {
    std::string text = std::to_string(tracked_.taken()) + " poses";
    if (odometry_.taken() > 0) text += ", " + std::to_string(odometry_.taken()) + " of odometry";
    std::string dropped;
    for (std::size_t k = 0; k < refusals; ++k) {
      const std::uint64_t count = tracked_.refused().at(k) + odometry_.refused().at(k);
      if (count > 0)
        dropped +=
            (dropped.empty() ? "; dropped: " : ", ") + std::to_string(count) + " " + name_of(static_cast<Refusal>(k));
    }
    text += dropped;
    if (node_.unsent() > 0) text += "; not sent: " + std::to_string(node_.unsent()) + " messages";
    return text;
  }

  Options options_;
  RosNode node_;
  Sightings tracked_, odometry_;
  std::vector<std::optional<BodyFrame>> poses_;  // that have not been handed on
  std::optional<Bases> bases_;
  std::optional<udp::Address> hub_;
  udp::Socket socket_{udp::Address{}};
  udp::Clock clock_;
  double next_look_s_ = 0.0;
  std::int64_t newest_ns_ = 0;  // stamp of the last pose that was taken
  bool asked_ = false;
  std::set<std::pair<Source, Refusal>> told_;
};

}  // namespace

int run_bridge(const Options& options) {
  catch_signals();
  return Bridge(options).run();
}

}  // namespace banyan::ros2
