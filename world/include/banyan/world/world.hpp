// SPDX-License-Identifier: MIT
// A simulated world: a value that can be copied, stepped and thrown away; thousands live in one
// process. One tick is act -> bodies -> radio -> sense -> step (world.cpp); observers read
// it between ticks, through the read-only view below.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/faults.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

class Bodies;    // bodies.hpp
class Executor;  // threads.hpp

struct Target {
  Vec2 position{};
  std::size_t worker = 0;  // index of the robot first sent there; its id is what `serves` names
  bool active = true;      // false once it has been given up (RemoveTarget)
  bool visit = false;      // given up as soon as a robot has been there
};

class World {
 public:
  // Throws std::invalid_argument with all faults(scenario) that are no warnings.
  explicit World(const Scenario& scenario);
  // The same with an algorithm of your own instead of the one that the scenario names;
  // scenario().mission.algorithm is then its name. `algorithm` must outlive this world and its copies.
  World(const Scenario& scenario, const Algorithm& algorithm);
  // The same with bodies that somebody else moves: a tracker says where they are. The first poses are the scenario's.
  World(const Scenario& scenario, const Algorithm& algorithm, std::unique_ptr<Bodies> bodies);
  World(const World&);
  World(World&&) noexcept;
  World& operator=(const World&);
  World& operator=(World&&) noexcept;
  ~World();

  // One tick. Same state for any executor. No allocation after the first ticks.
  void step();
  void step(Executor& executor);

  // Between two ticks: the swarm decides anew on what it sensed in the last one (Swarm::decide). For hosts whose
  // decisions arrive after the tick; algorithms have decided within it.
  void decide();

  // An intervention in the running world: `event` acts at the beginning of the next step, as if the
  // scenario had had it from the start as its last event, with time_s = time_s(); scenario() has it from
  // now on. So a world made from that scenario has the same hash() at every tick. `event.time_s` is
  // ignored. Throws std::invalid_argument with all faults_now(event). Allocates.
  void intervene(const Event& event);
  // What is wrong with it, in the words of faults(), keys as "events[2].loss"; also what faults() cannot
  // know beforehand: which targets there are by now, and where the obstacles are. None: it can happen.
  [[nodiscard]] std::vector<Fault> faults_now(const Event& event) const;

  [[nodiscard]] const Scenario& scenario() const noexcept;
  [[nodiscard]] const Algorithm& algorithm() const noexcept;
  [[nodiscard]] const Swarm& swarm() const noexcept;  // to look into the robots; the world itself uses reports
  [[nodiscard]] std::uint64_t tick() const noexcept;  // 0 before the first step
  [[nodiscard]] double time_s() const noexcept;       // tick x tick_s
  [[nodiscard]] std::size_t size() const noexcept;    // robots, dead ones included, and those that have not joined yet
  // Robots from this index on have not joined yet: they are not alive, and stand far outside.
  [[nodiscard]] std::size_t arrived() const noexcept;
  // What robots are called where people read, by index; shorter, or "", where they have their number alone. Of no
  // consequence for anything that happens.
  [[nodiscard]] std::span<const std::string> names() const noexcept;
  void call(std::size_t robot, const std::string& name);
  [[nodiscard]] std::span<const Vec2> positions() const noexcept;
  [[nodiscard]] std::span<const Vec2> headings() const noexcept;  // unit vectors
  // The report of each robot, as of its last step; of a dead one, as of its last step before it died.
  [[nodiscard]] std::span<const Report> reports() const noexcept;
  [[nodiscard]] std::span<const std::uint8_t> alive() const noexcept;  // 0: dead (its body stays), or not yet there
  [[nodiscard]] std::span<const Target> targets() const noexcept;
  // The station that robot i is; null if it is none. Stations never move as the algorithm wants.
  [[nodiscard]] const Station* station(std::size_t i) const noexcept;
  // Places of scenario().visits at which a robot has been.
  [[nodiscard]] std::size_t visited() const noexcept;
  // As they are now; scenario() has them as they were at the start.
  [[nodiscard]] std::span<const Obstacle> obstacles() const noexcept;
  [[nodiscard]] bool line_of_sight() const noexcept;
  // The robot that holds targets()[target]: the living robot that broadcasts the role of a worker, serves this
  // target and is within mission.target_tolerance_m of it; the nearest, then the first, of several.
  // Need not be targets()[target].worker: a spare may have taken over. None if no robot does, if the
  // target was given up or if there is no such target. O(N).
  [[nodiscard]] std::optional<std::size_t> holder(std::size_t target) const noexcept;
  [[nodiscard]] std::size_t deaths() const noexcept;   // since the start
  [[nodiscard]] std::size_t emptied() const noexcept;  // of these, robots whose battery was empty
  // Per robot the charge as a share of a full battery, and the charging place in whose slot it is, -1: none. Empty if
  // robots do not run on batteries.
  [[nodiscard]] std::span<const double> charge() const noexcept;
  [[nodiscard]] std::span<const std::int32_t> charged_at() const noexcept;
  // tick() at the beginning of the step in which the last of them died; none if all live.
  [[nodiscard]] std::optional<std::uint64_t> last_death_tick() const noexcept;
  // Whether events are still to come that make robots die (Die, Kill), those that
  // wait for a moment of the mission included.
  [[nodiscard]] bool pending_kills() const noexcept;
  // Robots that robot i could hear and be heard by at the current poses: in range, both alive, line of sight free or,
  // with radio.sight_leak, only with bodies in the way that antennas look over. Ascending. Packet loss is not
  // considered.
  [[nodiscard]] std::span<const std::uint32_t> links(std::size_t i) const noexcept;
  // Whether `receiver` hears nothing of `sender`, however near they are (radio.model = "one_way"). Such a pair is
  // among links() all the same: packets fly one way.
  [[nodiscard]] bool is_deaf(std::size_t receiver, std::size_t sender) const noexcept;
  // 1: the robot's antenna looks over bodies (radio.sight_leak). Empty if sight does not leak.
  [[nodiscard]] std::span<const std::uint8_t> raised() const noexcept;
  // Pairs (i < j) in range, both alive, but not linked for want of sight; ascending. Listed anew each time:
  // O(pairs in range).
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> blocked() const;

  [[nodiscard]] std::uint64_t packets_received() const noexcept;  // since the start
  [[nodiscard]] std::uint64_t packets_sent() const noexcept;
  // 64 bits over everything that can influence a later tick.
  [[nodiscard]] std::uint64_t hash() const noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::world
