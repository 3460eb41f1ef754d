// SPDX-License-Identifier: MIT
// Who watches a mission in ROS 2, as RViz would: another implementation of DDS (eProsima Fast DDS) that reads all
// topics with the qualities of RViz, tf2 and rclcpp, and asks for things.
//
//   banyan_ros2_watcher COUNT DOMAIN
//
// Reads lines on standard input: "click FRAME X Y", "goal FRAME X Y" and "command TEXT" are published. On standard
// output, a line for everything that was not said before, with the time of the mission; at the end of the input, what
// it has seen of the other side.
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <thread>

#include "peer_participant.hpp"

namespace banyan::ros2::peer {
namespace {

class Watcher {
 public:
  Watcher(int count, std::uint32_t domain) : participant_(domain, discovery_) {
    clock_ = participant_.reader<Clock>("rt/clock", Reading::newest);
    transforms_ = participant_.reader<TFMessage>("rt/tf");
    markers_ = participant_.reader<MarkerArray>("rt/markers");
    diagnostics_ = participant_.reader<DiagnosticArray>("rt/diagnostics");
    log_ = participant_.reader<Log>("rt/rosout", Reading::late);
    nodes_ = participant_.reader<ParticipantEntitiesInfo<16>>("ros_discovery_info", Reading::late);
    for (int i = 0; i < count; ++i)
      odometry_.push_back(participant_.reader<Odometry>("rt/robot_" + std::to_string(i) + "/odom", Reading::newest));
    goals_ = participant_.writer<PoseStamped>("rt/goal_pose");
    clicks_ = participant_.writer<PointStamped>("rt/clicked_point");
    commands_ = participant_.writer<String>("rt/banyan/command");
  }

  void watch() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    std::string begun;
    for (bool open = true; open;) {
      look();
      if (::poll(&input, 1, 10) <= 0) continue;
      std::array<char, 256> room{};
      const ssize_t size = ::read(STDIN_FILENO, room.data(), room.size());
      open = size > 0;
      if (open) begun.append(room.data(), static_cast<std::size_t>(size));
      for (std::size_t end = 0; (end = begun.find('\n')) != std::string::npos; begun.erase(0, end + 1))
        ask(begun.substr(0, end));
    }
    look();
    for (const std::string& line : discovery_.lines()) std::printf("%s\n", line.c_str());
    print_nodes<16>(nodes_, discovery_);
    std::printf("clock %zu messages, %zu back\n", ticks_, back_);
    std::printf("odometry of %zu robots, %zu moved\n", seen_.size(), moved_.size());
  }

 private:
  void ask(const std::string& line) {
    std::istringstream words(line);
    std::string what, frame, x_text, y_text;
    words >> what;
    if (what == "command") {
      String message{line.substr(what.size() + 1)};
      commands_->write(&message);
      return;
    }
    words >> frame >> x_text >> y_text;
    const double x = std::strtod(x_text.c_str(), nullptr), y = std::strtod(y_text.c_str(), nullptr);
    PointStamped point{{0, 0, frame}, {x, y, 0.0}};
    PoseStamped pose{{0, 0, frame}, {{x, y, 0.0, 0.0, 0.0, 0.0, 1.0}}};
    if (what == "click") clicks_->write(&point);
    else goals_->write(&pose);
  }

  void look() {
    take_all<Clock>(clock_, [&](const Clock& clock) {
      const double now_s = clock.sec + 1e-9 * clock.nanosec;
      ++ticks_;
      back_ += now_s < now_s_ ? 1 : 0;
      now_s_ = now_s;
    });
    take_all<TFMessage>(transforms_, [&](const TFMessage& message) {
      for (const auto& t : message.transforms) {
        frames_[t.child_frame_id] = t.values;
        say("frame " + t.header.frame_id + " " + t.child_frame_id);
      }
    });
    for (std::size_t i = 0; i < odometry_.size(); ++i)
      take_all<Odometry>(odometry_[i], [&](const Odometry& message) { look_at(i, message); });
    take_all<MarkerArray>(markers_, [&](const MarkerArray& message) { look_at(message); });
    take_all<DiagnosticArray>(diagnostics_, [&](const DiagnosticArray& message) {
      for (const auto& status : message.list)
        say("status " + std::to_string(status.level) + " " + status.name + ": " + status.message);
    });
    take_all<Log>(log_,
                  [&](const Log& log) { say("log " + std::to_string(log.level) + " " + log.name + " " + log.text); });
  }

  // A body that drives forwards has this speed in its own frame.
  void look_at(std::size_t robot, const Odometry& message) {
    say("odometry " + message.header.frame_id + " " + message.child_frame_id);
    const auto at = std::pair(message.pose.values[0], message.pose.values[1]);
    const double time_s = message.header.sec + 1e-9 * message.header.nanosec;
    const auto known = seen_.find(robot);
    if (known != seen_.end() && known->second.second != at) {
      moved_.insert(robot);
      const auto& [before_s, before] = known->second;
      const double moved = std::hypot(at.first - before.first, at.second - before.second);
      const double said = (time_s - before_s) * std::hypot(message.twist[0], message.twist[1]);
      if (std::abs(moved - said) > 0.002)
        say("robot " + std::to_string(robot) + " has another speed than it moves with");
    }
    seen_[robot] = {time_s, at};
  }

  void look_at(const MarkerArray& message) {
    std::string layers;
    for (const auto& marker : message.markers) {
      if (marker.ns == "tree") check_tree(marker);
      if (marker.action == 3) continue;
      layers += (layers.empty() ? "" : " ") + marker.ns + ":" +
                std::to_string(marker.points.empty() ? 1 : marker.points.size());
    }
    say("markers " + layers);
  }

  // Each end of an edge is a body, but for what bodies have moved meanwhile.
  void check_tree(const MarkerArray::Marker& tree) {
    for (const auto& end : tree.points) {
      double nearest = 1e9;
      for (const auto& [name, values] : frames_)
        nearest = std::min(nearest, std::hypot(values[0] - end[0], values[1] - end[1]));
      if (!frames_.empty() && nearest > 0.1) say("an edge of the tree ends where no robot is");
    }
  }

  void say(const std::string& text) {
    if (!said_.insert(text).second) return;
    std::printf("%.1f %s\n", now_s_, text.c_str());
    std::fflush(stdout);
  }

  Discovery discovery_;
  Participant participant_;
  DataReader *clock_, *transforms_, *markers_, *diagnostics_, *log_, *nodes_;
  std::vector<DataReader*> odometry_;
  DataWriter *goals_, *clicks_, *commands_;
  double now_s_ = 0.0;
  std::size_t ticks_ = 0, back_ = 0;
  std::map<std::string, std::array<double, 7>> frames_;
  std::map<std::size_t, std::pair<double, std::pair<double, double>>> seen_;
  std::set<std::size_t> moved_;
  std::set<std::string> said_;
};

}  // namespace
}  // namespace banyan::ros2::peer

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  banyan::ros2::peer::Watcher(std::stoi(argv[1]), static_cast<std::uint32_t>(std::stoul(argv[2]))).watch();
}
