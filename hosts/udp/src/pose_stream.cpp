// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/pose_stream.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace banyan::udp {
namespace {

constexpr double farthest_m = 1e5;
constexpr double largest_turn_rad = 1e4;  // beyond, a turn would not be exact (trig.hpp)

template <class T> bool take_number(std::string_view& line, T& value, char end) noexcept {
  const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  const auto used = static_cast<std::size_t>(rest - line.data());
  if (error != std::errc{} || used >= line.size() || *rest != end) return false;
  line.remove_prefix(used + 1);
  return true;
}

bool take_word(std::string_view& line, std::string& word) {
  constexpr std::size_t longest = 64;
  const std::size_t end = line.find_first_of(" \n");
  if (end == 0 || end > longest || line[end] != ' ') return false;
  word = line.substr(0, end);
  line.remove_prefix(end + 1);
  return std::none_of(word.begin(), word.end(), [](char c) { return c < '!' || c > '~'; });
}

std::string in_words(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

bool is_sound(const TrackedPose& pose) noexcept {  // false for NaN, too
  return std::fabs(pose.position.x) <= farthest_m && std::fabs(pose.position.y) <= farthest_m &&
         std::fabs(pose.heading_rad) <= largest_turn_rad;
}

std::string pose_line(const PoseLine& line) {
  return line.robot + " " + in_words(line.pose.position.x) + " " + in_words(line.pose.position.y) + " " +
         in_words(line.pose.heading_rad) + "\n";
}

std::optional<std::vector<PoseLine>> parse_poses(std::string_view datagram) {
  std::vector<PoseLine> lines;
  while (!datagram.empty()) {
    PoseLine line;
    const bool read = take_word(datagram, line.robot) && take_number(datagram, line.pose.position.x, ' ') &&
                      take_number(datagram, line.pose.position.y, ' ') &&
                      take_number(datagram, line.pose.heading_rad, '\n');
    if (!read || !is_sound(line.pose)) return std::nullopt;
    lines.push_back(line);
  }
  return lines;
}

void PoseStream::listen() {
  std::array<std::uint8_t, 65536> room;
  Address from;
  while (const auto datagram = socket_.receive(room, from)) {
    const auto lines = parse_poses({reinterpret_cast<const char*>(datagram->data()), datagram->size()});
    if (!lines || lines->empty()) {
      ++refused_;
      continue;
    }
    heard_s_ = clock_.now_s();
    take(*lines);
  }
}

void PoseStream::take(const std::vector<PoseLine>& lines) {
  for (const PoseLine& line : lines) {
    if (const auto robot = roster_.find(line.robot)) poses_[*robot] = line.pose;
    else take_other(line);
  }
}

// Others may be tracked, too: people, or robots that have not joined yet.
void PoseStream::take_other(const PoseLine& line) {
  constexpr std::size_t most = 32;
  if (const auto id = roster_.id_of(line.robot); id && (others_.contains(*id) || others_.size() < most))
    others_[*id] = line.pose;
  if (tell_unknown_ && told_.size() < most && told_.insert(line.robot).second) tell_unknown_(line.robot);
}

void PoseStream::welcome(std::size_t robot) {
  const auto seen = others_.find(roster_.id(robot));
  if (seen == others_.end()) return;
  poses_[robot] = seen->second;
  others_.erase(seen);
}

std::string PoseStream::lines() const {
  std::string text;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (poses_[i]) text += pose_line({roster_.name(i), *poses_[i]});
  return text;
}

void PoseStream::restore(std::string_view text) {
  if (const auto lines = parse_poses(text)) take(*lines);
}

std::vector<std::size_t> PoseStream::missing() const {
  std::vector<std::size_t> robots;
  for (std::size_t i = 0; i < roster_.size(); ++i)
    if (!poses_[i]) robots.push_back(i);
  return robots;
}

double PoseStream::silence_s() const noexcept { return clock_.now_s() - heard_s_; }

}  // namespace banyan::udp
