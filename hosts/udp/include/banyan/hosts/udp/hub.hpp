// SPDX-License-Identifier: MIT
// The hub: emulates situated communication for robots that are processes. It is the link of a RemoteSwarm, the clock of
// its world, and the only one who knows addresses and keys.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "banyan/hosts/udp/envelope.hpp"
#include "banyan/hosts/udp/journal.hpp"
#include "banyan/hosts/udp/periods.hpp"
#include "banyan/hosts/udp/pose_stream.hpp"
#include "banyan/hosts/udp/refusals.hpp"
#include "banyan/hosts/udp/remote_swarm.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {

struct HubSettings {
  Address listen{};
  double tick_s = 0.1;
  double speed = 1.0;         // of its clock
  double dead_after_s = 5.0;  // a robot that is silent for so long counts as dead
  std::size_t bundle = 1;     // packets heard in one datagram, at most
};

// Of the account of a run.
struct HubCounts {
  std::uint64_t received = 0;  // datagrams, accepted
  std::uint64_t sent = 0;
  DropCounts dropped{};
  std::uint64_t dropped_by_robots = 0;
  std::uint64_t late_ticks = 0;  // that began more than a tick too late
  Periods periods;               // of the robots' steps
};

class Hub final : public RemoteLink {
 public:
  // `roster` must outlive it; whoever joins is added. `journal`: none, or one to write and, if it has recorded ticks,
  // to play first; it must outlive the hub.
  Hub(const HubSettings& options, Roster& roster, KeyRing keys, HubJournal* journal);

  using Stopped = std::function<bool()>;
  // Waits until every robot has said something, at most so long. Those that have not.
  [[nodiscard]] std::vector<std::size_t> gather(double seconds, const Stopped& stopped);
  // From now on, with `look` at the moment of each tick: where bodies are, is not known here. Both must outlive it.
  void watch(PoseStream& tracker, std::function<void()> look) {
    tracker_ = &tracker;
    look_ = std::move(look);
  }
  // Waits for the moment of that tick and takes what has come by then. Ends early if it is stopped.
  [[nodiscard]] FleetChanges wait_for(std::uint32_t tick, const Stopped& stopped);
  // Tells all robots to stand still and end, again and again, until all have answered or a second has passed. How many
  // have not answered.
  std::size_t stop_all();

  // From now on.
  void use(const KeyRing& keys) { keys_ = keys; }
  void tell_refusals(Refusals::Tell tell) {
    refusals_.tell(std::move(tell), [this](NodeId id) { return roster_.name_of(id); });
  }
  // Whether that robot has said that it leaves.
  [[nodiscard]] bool has_left(std::size_t i) const noexcept { return robots_[i].left; }

  [[nodiscard]] const HubCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] bool is_replaying(std::uint32_t tick) const noexcept {
    return journal_ != nullptr && tick < journal_->recorded().size();
  }
  [[nodiscard]] Address local() const noexcept { return socket_.local(); }

  [[nodiscard]] std::optional<Status> take(std::size_t i) override;
  void deliver(std::size_t i, SensorFrame frame, std::span<const Hearing> heard) override;
  void dismiss(std::size_t i) override;

 private:
  struct Robot {
    explicit Robot(const SecureChannel& to) noexcept : channel(to) {}
    SecureChannel channel;
    std::optional<Address> address;  // where it was heard from last
    std::uint64_t session = 0;       // of the newest status
    std::uint32_t counter = 0;       // likewise
    Bytes arrived;                   // that status; empty: taken
    bool begun = false;              // it has taken part
    bool dead = false;
    bool left = false;      // it has said so
    bool is_back = false;   // dead, and another program of this id has come
    bool expected = false;  // it has joined, and its world does not have it yet
    bool told_stop = false, answered_stop = false;
    std::uint32_t heard_tick = 0;  // when it was last heard
    std::uint32_t dropped = 0;     // by itself, as it says
  };

  void listen();
  void take(const Envelope& envelope, const Address& from);
  [[nodiscard]] Robot* newcomer(NodeId id);
  std::size_t admit(NodeId id, std::uint32_t tick);
  void refuse(Drop reason, const Address& from, std::optional<NodeId> sender);
  void send(Robot& robot, EnvelopeKind kind, const Bytes& payload);
  void send_heard(Robot& robot, const SensorFrame& frame, std::span<const Hearing> heard);
  void keep_time(std::uint32_t tick, const Stopped& stopped);
  [[nodiscard]] HubJournalTick arrivals(std::uint32_t tick);
  void play(std::uint32_t tick);
  void add_sight(HubJournalTick& entries) const;

  HubSettings options_;
  KeyRing keys_;
  HubJournal* journal_;
  PoseStream* tracker_ = nullptr;  // none: bodies are simulated
  std::function<void()> look_;
  Refusals refusals_;
  Socket socket_;
  Clock clock_;
  std::uint32_t mission_;
  std::uint64_t session_;
  std::vector<Robot> robots_;
  std::map<NodeId, Robot> newcomers_;  // who are not in the roster yet
  std::optional<double> begin_s_;      // when tick 0 began, or would have; none: not yet
  std::uint32_t tick_ = 0;
  bool muted_ = false;  // a journal is played
  HubCounts counts_;
};

}  // namespace banyan::udp
