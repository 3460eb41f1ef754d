// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/robot.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "banyan/controller/core/proximity.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::udp {

namespace {

// For so long a robot counts as where it was heard, and so far from there it may have come, or its sensors may err.
constexpr double heard_for_s = 0.5;
constexpr float place_tolerance_m = 0.1F;

}  // namespace

UdpRobot::UdpRobot(const Algorithm& algorithm, Setup setup, RobotId id, double stop_after_s, double proximity_m)
    : algorithm_(algorithm),
      setup_(std::move(setup)),
      id_(id),
      stop_after_s_(stop_after_s),
      proximity_m_(static_cast<float>(proximity_m)) {}

// A robot that has started again in the middle of a mission is not its first root.
void UdpRobot::begin(const SensorFrame& frame) {
  const std::array<Member, 1> self{Member{id_, frame.worker, frame.root && !frame.begun}};
  swarm_ = algorithm_.make(setup_, self);
  known_.clear();
  given_up_serial_ = frame.begun ? frame.given_up_serial : 0;
  step_tick_ = frame.tick;
  interrupted_ = true;
  odometry_tick_ = 0;
}

void UdpRobot::follow(std::uint32_t tick, const OdometricPose& odometry) {
  if (tick < odometry_tick_) return;
  odometry_tick_ = tick;
  odometry_ = odometry;
}

void UdpRobot::take(const SensorFrame& frame, double now_s, const std::optional<OdometricPose>& at) {
  const bool another_mission = swarm_ && frame.mission != frame_.mission;
  if (swarm_ && frame.tick <= frame_.tick && !another_mission) return;  // overtaken by a later one
  if (!is_guided(now_s)) interrupted_ = true;
  if (!swarm_ || another_mission) begin(frame);
  frame_ = frame;
  frame_s_ = now_s;
  follow(frame.tick, frame.odometry);
  if (frame.has_target) target_ = at.value_or(frame.odometry).outside(frame.target);
  swarm_->set_line_of_sight(frame.line_of_sight);
}

void UdpRobot::take(const HeardBundle& heard, const std::optional<OdometricPose>& at) {
  if (!swarm_) return;
  follow(heard.tick, heard.odometry);
  const OdometricPose& pose = at ? *at : heard.odometry;
  for (const Hearing& packet : heard.packets) {
    if (packet.message.empty()) {  // the algorithm need not look at it
      ++refused_;
      continue;
    }
    const auto [place, is_new] = known_.try_emplace(packet.sender);
    if (!is_new && heard.tick <= place->second.tick) continue;
    place->second = {heard.tick, pose.outside(packet.position), packet.message, place->second.given_s};
  }
}

bool UdpRobot::is_guided(double now_s) const noexcept { return swarm_ && now_s - frame_s_ <= stop_after_s_; }

// After an interruption the hub's ticks say how much of the mission has passed: nothing, if the hub was away.
float UdpRobot::elapsed_s(double now_s) const noexcept {
  if (!interrupted_) return static_cast<float>(now_s - step_s_);
  const std::uint32_t ticks = std::max<std::uint32_t>(1, frame_.tick - std::min(step_tick_, frame_.tick));
  return static_cast<float>(ticks) * setup_.platform.tick_s;
}

void UdpRobot::collect(const OdometricPose& pose, double now_s) {
  packets_.clear();
  for (auto& [sender, known] : known_) {
    if (known.message.empty()) continue;
    if (const auto place = swarm_->receive(known.message))
      packets_.push_back({.sender = *place, .age_ticks = 1, .position = pose.inside(known.position), .age_s = 0.0F});
    else ++refused_;
    known.message.clear();
    known.given_s = now_s;
  }
}

std::span<const Vec2> UdpRobot::without_neighbors(const OdometricPose& pose, std::span<const Vec2> seen, double now_s) {
  neighbors_.clear();
  for (const auto& [sender, known] : known_)
    if (now_s - known.given_s <= heard_for_s) neighbors_.push_back(pose.inside(known.position));
  seen_.assign(seen.begin(), seen.end());
  if (proximity_m_ > 0.0F) std::erase_if(seen_, [this](Vec2 point) { return norm(point) > proximity_m_; });
  return without_robots(seen_, neighbors_, setup_.platform.body_radius_m, place_tolerance_m);
}

Senses UdpRobot::sense(const OdometricPose& pose, std::span<const Vec2> seen, double now_s) {
  Senses senses;
  senses.odometry = motion_between(pose_, pose);
  senses.orders.sent = frame_.sent;
  senses.orders.station = frame_.station;
  if (frame_.sent && frame_.has_target) senses.orders.target = pose.inside(target_);
  if (frame_.given_up_serial != given_up_serial_) senses.orders.given_up = frame_.given_up;
  obstacles_.assign(frame_.obstacles.begin(), frame_.obstacles.end());
  const auto bodies = without_neighbors(pose, seen, now_s);
  obstacles_.insert(obstacles_.end(), bodies.begin(), bodies.end());
  senses.obstacles = obstacles_;
  senses.elapsed_s = elapsed_s(now_s);
  return senses;
}

Status UdpRobot::step(double now_s, const std::optional<OdometricPose>& pose, std::span<const Vec2> seen) {
  const OdometricPose here = pose ? *pose : odometry_;
  if (step_s_ <= 0.0) pose_ = here;  // the first one: there is no motion before
  collect(here, now_s);
  std::array<Sensed, 1> sensed;
  sensed[0].packets = packets_;
  sensed[0].senses = sense(here, seen, now_s);
  std::array<Velocity, 1> command{};
  std::array<Report, 1> report{};
  swarm_->step(0, sensed, command, report);
  swarm_->advance();

  Status status;
  status.frame_tick = frame_.tick;
  status.period_us = interrupted_ ? 0 : static_cast<std::uint32_t>(std::min((now_s - step_s_) * 1e6, 4e9));
  given_up_serial_ = status.given_up_serial = frame_.given_up_serial;
  status.velocity = command[0];
  status.report = report[0];
  status.message.resize(largest_wire);
  status.message.resize(swarm_->send(0, status.message));

  pose_ = here;
  step_s_ = now_s;
  step_tick_ = frame_.tick;
  interrupted_ = false;
  return status;
}

}  // namespace banyan::udp
