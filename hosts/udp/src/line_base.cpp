// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/line_base.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>

#include "banyan/hosts/udp/envelope.hpp"

namespace banyan::udp {
namespace {

constexpr std::size_t most_points = 4096;       // of a lidar's turn
constexpr std::size_t longest_line = 1U << 17;  // with them

std::string_view take_word(std::string_view& line) noexcept {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

// Finite numbers until the end of the line; nothing if a word is none.
std::optional<std::vector<float>> numbers(std::string_view line) {
  std::vector<float> found;
  while (!line.empty()) {
    const std::string_view word = take_word(line);
    float value = 0.0F;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
    found.push_back(value);
  }
  return found;
}

constexpr float largest_angle = 1e4F;  // beyond, a turn would not be exact (trig.hpp)

std::optional<BaseLine> pose_of(const std::vector<float>& values) {
  if (values.size() != 3 || std::fabs(values[2]) > largest_angle) return std::nullopt;
  return OdometricPose{{values[0], values[1]}, angle_of(unit_vector(values[2]))};
}

std::optional<BaseLine> seen_of(const std::vector<float>& values) {
  if (values.size() % 2 != 0 || values.size() > 2 * most_points) return std::nullopt;
  Seen seen;
  for (std::size_t k = 0; k < values.size(); k += 2) seen.points.push_back({values[k], values[k + 1]});
  return seen;
}

std::optional<BaseLine> near_of(const std::vector<float>& values) {
  if (values.empty() || values.size() % 3 != 0 || values.size() > 3 * most_seen) return std::nullopt;
  Near near;
  for (std::size_t k = 0; k < values.size(); k += 3) {
    const float id = values[k], range_m = values[k + 1], bearing = values[k + 2];
    if (!(id >= 0.0F && id < static_cast<float>(most_fleet_robots)) || id != std::floor(id)) return std::nullopt;
    if (range_m < 0.0F || std::fabs(bearing) > largest_angle) return std::nullopt;
    near.robots.push_back({static_cast<RobotId>(id), range_m * unit_vector(bearing)});
  }
  return near;
}

std::optional<BaseLine> sought_of(const std::vector<float>& values) {
  if (values.empty()) return Sought{};
  if (values.size() != 2) return std::nullopt;
  return Sought{Vec2{values[0], values[1]}};
}

std::string in_decimals(float value) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 4).ptr;
  return {text.data(), end};
}

}  // namespace

std::optional<BaseLine> parse_base_line(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  const std::string_view word = take_word(line);
  const auto values = numbers(line);
  if (!values) return std::nullopt;
  if (word == "pose") return pose_of(*values);
  if (word == "seen") return seen_of(*values);
  if (word == "near") return near_of(*values);
  if (word == "target") return sought_of(*values);
  return std::nullopt;
}

std::string drive_line(const Velocity& velocity) {
  return "drive " + in_decimals(velocity.forward_m_s) + " " + in_decimals(velocity.sideways_m_s) + " " +
         in_decimals(velocity.turn_rad_s) + "\n";
}

std::optional<Velocity> parse_drive_line(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  if (take_word(line) != "drive") return std::nullopt;
  const auto values = numbers(line);
  if (!values || values->size() != 3) return std::nullopt;
  return Velocity{values->at(0), values->at(1), values->at(2)};
}

std::string base_pose_line(const OdometricPose& pose) {
  return "pose " + in_decimals(pose.position.x) + " " + in_decimals(pose.position.y) + " " +
         in_decimals(pose.turn_rad) + "\n";
}

LineBase::~LineBase() { ::close(descriptor_); }

void LineBase::take(std::string_view line, double now_s) {
  const auto said = parse_base_line(line);
  if (!said) return;
  if (const auto* pose = std::get_if<OdometricPose>(&*said)) poses_.take(*pose, now_s);
  if (const auto* seen = std::get_if<Seen>(&*said)) seen_ = *seen;
  if (const auto* near = std::get_if<Near>(&*said))
    for (const Near::Robot& robot : near->robots) near_[robot.id] = {robot.position, now_s};
  if (const auto* sought = std::get_if<Sought>(&*said)) {
    target_.reset();
    if (sought->target) target_ = Measured{*sought->target, now_s};
  }
}

void LineBase::listen(double now_s) {
  std::array<char, 1024> room{};
  for (;;) {
    const ssize_t size = ::read(descriptor_, room.data(), room.size());
    if (size < 0 && errno == EINTR) continue;
    if (size == 0 || (size < 0 && errno != EAGAIN)) lost_ = true;
    if (size <= 0) return;
    begun_.append(room.data(), static_cast<std::size_t>(size));
    for (std::size_t end = begun_.find('\n'); end != std::string::npos; end = begun_.find('\n')) {
      take(std::string_view(begun_).substr(0, end), now_s);
      begun_.erase(0, end + 1);
    }
    if (begun_.size() > longest_line) begun_.clear();
  }
}

void LineBase::drive(const Velocity& velocity) {
  const std::string line = drive_line(velocity);
  // A base that does not read stops by itself.
  static_cast<void>(::write(descriptor_, line.data(), line.size()));
}

std::optional<Measured> LineBase::neighbour(RobotId robot) const {
  const auto found = near_.find(robot);
  if (found == near_.end()) return std::nullopt;
  return found->second;
}

std::unique_ptr<Driver> open_line_base(const std::string& name) {
  return std::make_unique<LineBase>(name.starts_with("tcp:") ? connect_tcp(name.substr(4)) : open_serial(name));
}

}  // namespace banyan::udp
