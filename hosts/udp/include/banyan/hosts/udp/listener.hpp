// SPDX-License-Identifier: MIT
// Listens to robots that have no hub, and says nothing that concerns their mission. As the link of a RemoteSwarm it
// makes a world of what they tell, which can be observed and recorded as any other.
#pragma once

#include <functional>
#include <map>

#include "banyan/hosts/udp/chart.hpp"
#include "banyan/hosts/udp/peers.hpp"
#include "banyan/hosts/udp/refusals.hpp"
#include "banyan/hosts/udp/remote_swarm.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {

struct ListenerOptions {
  Address listen{};
  double tick_s = 0.1;
  double speed = 1.0;
  double dead_after_s = 5.0;  // a robot that is silent for so long counts as dead
};

class Listener final : public RemoteLink {
 public:
  // `roster` must outlive it; whoever joins is added.
  Listener(const ListenerOptions& options, Roster& roster, KeyRing keys);

  using Stopped = std::function<bool()>;
  // Until every robot of the roster at first has told something and has a place on the chart, and so many say that they
  // have a target; at most so long. The robots without a place.
  [[nodiscard]] std::vector<std::size_t> gather(double seconds, std::size_t targets, const Stopped& stopped);
  // Waits for the moment of that tick. Ends early if it is stopped. Robots join once they have a place on the chart, in
  // the order in which they were heard first; one that counted as dead is back as soon as it is heard.
  [[nodiscard]] FleetChanges wait_for(std::uint32_t tick, const Stopped& stopped);

  void tell_refusals(Refusals::Tell tell) {
    refusals_.tell(std::move(tell), [this](NodeId id) { return roster_.name_of(id); });
  }
  [[nodiscard]] const Chart& chart() const noexcept { return chart_; }
  [[nodiscard]] const std::optional<Status>& last(std::size_t i) const noexcept { return robots_[i].last; }
  [[nodiscard]] std::uint64_t received() const noexcept { return received_; }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }
  [[nodiscard]] Address local() const noexcept { return socket_.local(); }

  [[nodiscard]] std::optional<Status> take(std::size_t i) override;
  void deliver(std::size_t /*i*/, SensorFrame /*frame*/, std::span<const Hearing> /*heard*/) override {}
  void dismiss(std::size_t /*i*/) override {}

 private:
  struct Robot {
    std::optional<Status> last;
    bool is_new = false;
    bool dead = false;
    double heard_s = 0.0;
  };
  void listen();
  [[nodiscard]] bool hear(const Envelope& envelope, const Address& from);
  void wait_until(double moment_s, const Stopped& stopped);
  [[nodiscard]] std::vector<std::size_t> missing() const;

  ListenerOptions options_;
  KeyRing keys_;
  Socket socket_;
  Clock clock_;
  Peers peers_;
  Refusals refusals_;
  Chart chart_;
  std::vector<Robot> robots_;  // and room for more
  std::size_t at_first_, arrived_;
  std::optional<double> begin_s_;
  std::uint64_t received_ = 0, dropped_ = 0;  // datagrams
};

}  // namespace banyan::udp
