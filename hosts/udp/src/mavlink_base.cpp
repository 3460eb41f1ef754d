// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/mavlink_base.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>

#include "banyan/hosts/udp/base_wire.hpp"
#include "banyan/hosts/udp/envelope.hpp"

namespace banyan::udp {
namespace {

constexpr std::string_view mavlink_prefix = "mavlink:", udp_prefix = "udp:", tcp_prefix = "tcp:";
constexpr double heartbeat_every_s = 1.0, set_point_every_s = 0.15, pose_every_s = 0.05;
constexpr std::uint8_t onboard_computer = 191;  // MAV_COMP_ID_ONBOARD_COMPUTER

// Bytes from and to vehicles: datagrams, or a stream.
class MavlinkWire {
 public:
  explicit MavlinkWire(const std::string& name) {
    if (name.starts_with(udp_prefix)) {
      socket_.emplace(parse_address(name.substr(udp_prefix.size())));
    } else if (name.starts_with(tcp_prefix)) {
      stream_ = connect_tcp(name.substr(tcp_prefix.size()));
    } else {
      const std::size_t at = name.rfind('@');
      stream_ = at == std::string::npos ? open_serial(name) : open_serial(name.substr(0, at), baud_of(name, at + 1));
    }
  }
  ~MavlinkWire() {
    if (stream_ >= 0) ::close(stream_);
  }
  MavlinkWire(const MavlinkWire&) = delete;
  MavlinkWire& operator=(const MavlinkWire&) = delete;

  template <class Hear> void receive(const Hear& hear) {
    std::array<std::uint8_t, 2048> room{};
    if (socket_) {
      Address from;
      while (const auto datagram = socket_->receive(room, from)) {
        reader_.forget();
        read(*datagram, from, hear);
      }
      return;
    }
    for (;;) {
      const ssize_t size = ::read(stream_, room.data(), room.size());
      if (size < 0 && errno == EINTR) continue;
      if (size == 0 || (size < 0 && errno != EAGAIN)) lost_ = true;
      if (size <= 0) return;
      read(ByteView(room).first(static_cast<std::size_t>(size)), {}, hear);
    }
  }
  void send(ByteView packet, const Address& to) const {
    if (socket_) return socket_->send(packet, to);
    // A vehicle that does not read stops by itself.
    static_cast<void>(::write(stream_, packet.data(), packet.size()));
  }
  // Whether there is somebody at the other end before it has said anything.
  [[nodiscard]] bool is_stream() const noexcept { return !socket_; }
  [[nodiscard]] int descriptor() const noexcept { return socket_ ? socket_->descriptor() : stream_; }
  [[nodiscard]] bool lost() const noexcept { return lost_; }

 private:
  static int baud_of(const std::string& name, std::size_t begin) {
    int baud = 0;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + begin, end, baud);
    if (error != std::errc{} || rest != end)
      throw BaseError(name + ": after @ comes the speed of a serial device, such as 57600");
    return baud;
  }
  template <class Hear> void read(ByteView bytes, const Address& from, const Hear& hear) {
    reader_.feed(bytes);
    while (const auto word = reader_.next()) hear(*word, from);
  }

  std::optional<Socket> socket_;
  int stream_ = -1;
  bool lost_ = false;
  MavlinkReader reader_;
};

class MavlinkBase final : public Driver {
 public:
  explicit MavlinkBase(const RobotOptions& options)
      : robot_(options.id),
        system_(options.mavlink_system()),
        autopilot_(autopilot_setup(options)),
        wire_(options.base.substr(mavlink_prefix.size())) {
    if (!options.poses.empty()) tracker_ = parse_address(options.poses);
  }

  void listen(double now_s) override {
    now_s_ = now_s;
    wire_.receive([&](const MavlinkWord& word, const Address& from) { autopilot_.hear(word, from, now_s); });
    autopilot_.refresh(now_s);
    if (now_s >= next_heartbeat_s_) {
      next_heartbeat_s_ = now_s + heartbeat_every_s;
      const Bytes heartbeat = mavlink_heartbeat(sender());
      say(heartbeat);
      if (autopilot_.sources().empty() && wire_.is_stream()) wire_.send(heartbeat, {});  // some wait for it
    }
    if (now_s >= next_set_point_s_) steer();
    if (tracker_ && now_s >= next_pose_s_) tell_place();
  }
  void drive(const Velocity& velocity) override {
    velocity_ = velocity;
    steer();
  }
  [[nodiscard]] std::optional<OdometricPose> pose_at(double moment_s) const override {
    return autopilot_.poses().at(moment_s);
  }
  [[nodiscard]] std::span<const Vec2> obstacles() const override { return {}; }
  [[nodiscard]] std::optional<Measured> neighbour(RobotId /*robot*/) const override { return std::nullopt; }
  [[nodiscard]] std::optional<Measured> target() const override { return std::nullopt; }
  [[nodiscard]] std::optional<double> last_pose_s() const override { return autopilot_.poses().last_s(); }
  [[nodiscard]] int descriptor() const noexcept override { return wire_.descriptor(); }
  [[nodiscard]] bool lost() const noexcept override { return wire_.lost(); }
  [[nodiscard]] const std::string& fault() const noexcept override { return autopilot_.fault(); }

 private:
  MavlinkSender sender() noexcept { return {system_, onboard_computer, sequence_++}; }
  void say(const Bytes& packet) const {
    for (const Autopilot::Source& source : autopilot_.sources()) wire_.send(packet, source.address);
  }
  void steer() {
    next_set_point_s_ = now_s_ + set_point_every_s;
    say(encode(autopilot_.set_point(velocity_, now_s_), sender()));
  }
  void tell_place() {
    const auto place = autopilot_.place();
    if (!place) return;
    next_pose_s_ = now_s_ + pose_every_s;
    const std::string line = pose_line({robot_, *place});
    to_tracker_.send({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()}, *tracker_);
  }

  RobotId robot_;
  std::uint8_t system_, sequence_ = 0;
  Autopilot autopilot_;
  MavlinkWire wire_;
  std::optional<Address> tracker_;  // whom it tells where it is
  Socket to_tracker_{Address{}};
  Velocity velocity_;
  double now_s_ = 0.0, next_heartbeat_s_ = 0.0, next_set_point_s_ = 0.0, next_pose_s_ = 0.0;
};

std::optional<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<double> found;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    char* end = nullptr;
    found.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0' || !std::isfinite(found.back())) return std::nullopt;
  }
  return found;
}

std::optional<GlobePoint> globe_point(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return std::nullopt;
  text[comma] = ' ';
  const auto values = numbers_of(text);
  if (!values || values->size() != 2) return std::nullopt;
  constexpr double farthest_north = 85.0, farthest_east = 180.0;  // beyond, east is no direction to count on
  const GlobePoint point{values->at(0), values->at(1)};
  if (std::fabs(point.latitude_deg) > farthest_north || std::fabs(point.longitude_deg) > farthest_east)
    throw BaseError("--home " + text.replace(comma, 1, ",") +
                    ": a latitude is from -85 to 85 degrees, a longitude from -180 to 180");
  return point;
}

BasicVec2<double> home_in_file(const std::string& path, RobotId robot) {
  constexpr double farthest_m = 1e5;
  std::ifstream file(path);
  if (!file)
    throw BaseError("--home " + path + ": " + std::strerror(errno) +
                    "; it is a file of homes, LATITUDE,LONGITUDE or tracker");
  std::optional<BasicVec2<double>> home;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string where = path + ":" + std::to_string(++number) + ": ";
    const auto values = numbers_of(line.substr(0, line.find('#')));
    if (values && values->empty()) continue;
    if (!values || values->size() != 3 || values->at(0) != std::floor(values->at(0)) ||
        !(values->at(0) >= 0.0 && values->at(0) < most_fleet_robots) || std::fabs(values->at(1)) > farthest_m ||
        std::fabs(values->at(2)) > farthest_m)
      throw BaseError(where + "must be ROBOT EAST NORTH, an id and two lengths in m, at most 100000; not \"" + line +
                      "\"");
    if (static_cast<RobotId>(values->at(0)) != robot) continue;
    if (home) throw BaseError(where + "robot " + std::to_string(robot) + " has a home already");
    home = {values->at(1), values->at(2)};
  }
  if (!home) throw BaseError(path + ": has no line for robot " + std::to_string(robot));
  return *home;
}

}  // namespace

bool is_mavlink(const std::string& base) noexcept { return base.starts_with(mavlink_prefix); }

AutopilotSetup autopilot_setup(const RobotOptions& options) {
  AutopilotSetup setup;
  setup.system = options.mavlink_system();
  setup.height_m = options.height_m;
  if (options.home == "tracker") return setup;
  setup.origin = globe_point(options.home);
  if (!setup.origin) setup.home = home_in_file(options.home, options.id);
  return setup;
}

std::unique_ptr<Driver> open_mavlink_base(const RobotOptions& options) {
  return std::make_unique<MavlinkBase>(options);
}

}  // namespace banyan::udp
