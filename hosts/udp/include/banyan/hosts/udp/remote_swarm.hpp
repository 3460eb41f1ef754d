// SPDX-License-Identifier: MIT
// Robots that are elsewhere, as a Swarm: the world keeps bodies, radio, obstacles and events, and everybody who
// observes it stays as they are, while the controllers run in processes of their own. In a step each robot is sent what
// it senses and hears, and what has arrived from it by then counts as what it does.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "banyan/controller/core/elsewhere.hpp"
#include "banyan/hosts/udp/messages.hpp"
#include "banyan/hosts/udp/roster.hpp"

namespace banyan::udp {

// The way to the robots. Theirs are ids, the world's are indices: the roster says which is which.
class RemoteLink {
 public:
  virtual ~RemoteLink() = default;
  [[nodiscard]] const Roster& roster() const noexcept { return roster_; }
  // The newest status of robot i that has come since the last call; nothing if none has.
  [[nodiscard]] virtual std::optional<Status> take(std::size_t i) = 0;
  // `frame.mission` and `frame.begun` are the link's to fill in. Positions in `heard` are as of the frame.
  virtual void deliver(std::size_t i, SensorFrame frame, std::span<const Hearing> heard) = 0;
  // Robot i is dead in the world: its process is to end.
  virtual void dismiss(std::size_t i) = 0;

 protected:
  // `roster` must outlive it.
  explicit RemoteLink(Roster& roster) noexcept : roster_(roster) {}
  Roster& roster_;  // NOLINT(*-non-private-member-variables-in-classes)
};

// What has happened to the fleet by a tick: robots by their indices.
struct FleetChanges {
  std::vector<std::size_t> dead;    // from now on
  std::vector<std::size_t> joined;  // the next ones, or some that counted as dead
  [[nodiscard]] bool empty() const noexcept { return dead.empty() && joined.empty(); }
};

// Steps on one thread only.
class RemoteSwarm final : public SwarmElsewhere {
 public:
  // `local`: a swarm of the algorithm, which knows its messages. A robot that is silent for more than `silence` ticks
  // stands still. `link` must outlive it; a clone has none.
  RemoteSwarm(std::unique_ptr<Swarm> local, std::span<const Member> members, const Setup& setup, RemoteLink& link,
              std::uint32_t silence);

  [[nodiscard]] std::unique_ptr<Swarm> clone() const override;
  void step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
            std::span<Report> reports) override;
  void advance() noexcept override;
  void add_to(Digest& digest, std::size_t i) const noexcept override;
  void restart(std::size_t i) override;
  void set_line_of_sight(bool on) noexcept override { line_of_sight_ = on; }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override;

 private:
  struct Robot {
    Member member;
    OdometricPose odometry;
    Velocity velocity;
    std::vector<Bytes> recent;  // a ring, by tick: what arrived in it; empty: nothing
    std::uint32_t silent_ticks = 0;
    std::deque<RobotId> given_up;      // still to be announced; the first is being announced
    std::uint8_t given_up_serial = 0;  // of the last that it has confirmed
  };

  RemoteSwarm(const RemoteSwarm& other);
  void collect();
  void hear(std::size_t i, const Status& status);
  [[nodiscard]] SensorFrame frame_of(Robot& robot, const Senses& senses) const;
  [[nodiscard]] std::size_t slot(std::uint32_t age) const noexcept { return (tick_ + history_ - age) % history_; }

  std::vector<Robot> robots_;
  std::size_t history_;
  std::uint32_t silence_;
  RemoteLink* link_ = nullptr;  // null: a clone
  bool line_of_sight_;
  bool collected_ = false;  // in this tick
  std::uint32_t tick_ = 0;
  std::vector<Hearing> heard_;
};

// An algorithm whose robots are at the other end of the link.
[[nodiscard]] AlgorithmElsewhere remote_algorithm(const Algorithm& real, RemoteLink& link, std::uint32_t silence);

}  // namespace banyan::udp
