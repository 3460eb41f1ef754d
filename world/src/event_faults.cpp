// SPDX-License-Identifier: MIT
// What can be wrong with the events of a scenario taken together: each is checked against the state that
// the events before it leave behind.
#include <algorithm>
#include <numeric>
#include <set>

#include "banyan/world/obstacles.hpp"
#include "banyan/world/schema.hpp"
#include "fault_list.hpp"

namespace banyan::world {
namespace {

// The state that earlier events leave behind, as far as it can be known in advance.
struct Sequel {
  std::size_t targets;  // that have been there, given up or not
  std::size_t served;   // those that are not given up
  std::size_t most;     // the largest of `served` so far
  std::set<std::size_t> removed;
  std::vector<Obstacle> obstacles;
  std::size_t robots;  // that have been there
  std::size_t places;
  std::size_t stations_from = 0, stations_to = 0;  // targets that go with stations
};

std::size_t held_by_stations(const Scenario& scenario) noexcept {
  return static_cast<std::size_t>(std::count_if(scenario.stations.begin(), scenario.stations.end(),
                                                [](const Station& station) { return !station.root; }));
}

// When a run ends. Taken once for all events: it depends on all targets and all events.
struct End {
  explicit End(const Scenario& scenario)
      : limit_s{time_limit_s(scenario)},
        stops_when_complete{scenario.mission.stop_when_complete},
        settled_s{limit_s + scenario.mission.settle_s},
        waits_for_deaths{std::any_of(scenario.events.begin(), scenario.events.end(), [](const Event& event) {
          return std::holds_alternative<Die>(event.action) || std::holds_alternative<Kill>(event.action);
        })} {}
  // Whether a run may still go on at `time_s`, which is past its limit: to settle, to wait for deaths to come or to
  // recover from them (docs/model.md).
  [[nodiscard]] bool may_last_until(double time_s) const noexcept {
    return stops_when_complete && (time_s < settled_s || waits_for_deaths);
  }
  double limit_s;
  bool stops_when_complete;
  double settled_s;
  bool waits_for_deaths;
};

// Checks that what an event refers to exists when it happens.
class CheckEventFits {
 public:
  CheckEventFits(FaultList& list, const Scenario& scenario, const End& end, std::size_t index, const Sequel& before)
      : list_(list), scenario_(scenario), key_(element("events", index)), before_(before) {
    const Event& event = scenario.events[index];
    if (event.time_s >= end.limit_s)
      list.warn(key_ + ".time_s",
                (end.may_last_until(event.time_s) ? "happens only if the run goes on after its limit of "
                                                  : "the run ends before: its limit is ") +
                    short_text(end.limit_s) + " s");
    std::visit(*this, event.action);
  }
  void operator()(const Die& die) const { robot(die.robot); }
  void operator()(const Freeze& freeze) const {
    robot(freeze.robot);
    not_a_station(freeze.robot);
  }
  void operator()(const MoveTarget& move) const {
    target(move.target);
    room(move.position);
  }
  void operator()(const RemoveTarget& remove) const { target(remove.target); }
  void operator()(const AddTarget& add) const { room(add.position); }
  void operator()(const MoveObstacle& move) const {
    if (obstacle(move.obstacle))
      check_obstacle_body(list_, scenario_, key_ + ".position_m",
                          moved(before_.obstacles[move.obstacle], move.position));
  }
  void operator()(const RemoveObstacle& remove) const { (void)obstacle(remove.obstacle); }
  void operator()(const Join& join) const {
    not_a_station(join.robot);
    if (join.robot > before_.robots)
      list_.fail(key_ + ".robot", "the next robot to join at that time is " + std::to_string(before_.robots) +
                                      "; robots join in the order of their indices");
    if (join.robot >= before_.places)
      list_.fail(key_ + ".robot", "there is no place for another robot; there are " + std::to_string(before_.places));
    const double room_m = clearance(before_.obstacles, join.position);
    check_target_room(list_, scenario_, before_.obstacles, room_m < scenario_.robot.radius_m ? 0.0 : room_m,
                      key_ + ".position_m", "the robot that joins", join.position);
  }
  template <class Other> void operator()(const Other& refers_to_nothing) const { static_cast<void>(refers_to_nothing); }

 private:
  void not_a_station(std::size_t i) const {
    if (scenario_.stations.empty()) return;
    const std::size_t first = free_robot_count(scenario_);
    if (i >= first && i - first < scenario_.stations.size())
      list_.fail(key_ + ".robot", "robot " + std::to_string(i) + " is the station " +
                                      scenario_.stations[i - first].name + ", which goes where its course says");
  }
  void robot(std::size_t i) const {
    if (i >= before_.robots)
      list_.fail(key_ + ".robot",
                 "there is no robot " + std::to_string(i) + "; the last one is " + std::to_string(before_.robots - 1));
  }
  void target(std::size_t i) const {
    if (i >= before_.targets)
      list_.fail(key_ + ".target", "there is no target " + std::to_string(i) + " at that time; the last one is " +
                                       std::to_string(before_.targets - 1));
    if (i >= before_.stations_to && scenario_.visits.positions)
      list_.fail(key_ + ".target", "with visits only the targets of the start, 0 to " +
                                       std::to_string(before_.stations_to - 1) +
                                       ", can be moved or given up: the numbers of others depend on the run");
    if (i >= before_.stations_from && i < before_.stations_to)
      list_.fail(key_ + ".target", "target " + std::to_string(i) + " is where a station is, and goes with it");
  }
  [[nodiscard]] bool obstacle(std::size_t i) const {
    const std::size_t count = before_.obstacles.size();
    if (i >= count)
      list_.fail(key_ + ".obstacle", "there is no obstacle " + std::to_string(i) +
                                         (count == 0 ? "" : "; the last one is " + std::to_string(count - 1)));
    return i < count;
  }
  void room(Vec2 p) const {
    check_target_room(list_, scenario_, before_.obstacles, clearance(before_.obstacles, p), key_ + ".position_m",
                      "the target", p);
  }

  FaultList& list_;
  const Scenario& scenario_;
  const std::string key_;
  const Sequel& before_;
};

void follow(Sequel& sequel, const Event& event) {
  change(sequel.obstacles, event.action);
  if (const auto* join = std::get_if<Join>(&event.action)) sequel.robots = std::max(sequel.robots, join->robot + 1);
  if (std::holds_alternative<AddTarget>(event.action)) {
    ++sequel.targets;
    sequel.most = std::max(sequel.most, ++sequel.served);
  }
  const auto* remove = std::get_if<RemoveTarget>(&event.action);
  if (remove == nullptr || remove->target >= sequel.targets) return;
  if (sequel.removed.insert(remove->target).second) --sequel.served;
}

// Returns the largest number of targets at a time. Events that wait for a moment of the mission are
// taken as late as possible: after all the others, and adding to the most there has been.
std::size_t check_in_order(FaultList& list, const Scenario& scenario, std::size_t targets, std::size_t robots) {
  const std::vector<Event>& events = scenario.events;
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return events[a].time_s < events[b].time_s; });
  const auto waits = [&](std::size_t i) { return events[i].when != Event::When::time; };
  const auto adds_late = static_cast<std::size_t>(std::count_if(order.begin(), order.end(), [&](std::size_t i) {
    return waits(i) && std::holds_alternative<AddTarget>(events[i].action);
  }));
  const End end(scenario);
  // Stations hold their places themselves.
  const std::size_t held = held_by_stations(scenario);
  const std::size_t there = robots + scenario.stations.size(), served = targets - held;
  Sequel sequel{targets + adds_late,   served, served, {}, scenario.obstacles, there,
                place_count(scenario), served, targets};
  for (const std::size_t i : order) {
    if (waits(i)) continue;
    // Its constructor is the check. NOLINTNEXTLINE(bugprone-unused-raii)
    CheckEventFits(list, scenario, end, i, sequel);
    follow(sequel, events[i]);
  }
  for (const std::size_t i : order)
    if (waits(i)) {
      // NOLINTNEXTLINE(bugprone-unused-raii): likewise
      CheckEventFits(list, scenario, end, i, sequel);
      if (const auto* join = std::get_if<Join>(&events[i].action); join != nullptr && join->robot == sequel.robots)
        ++sequel.robots;
    }
  return sequel.most + adds_late;
}

}  // namespace

bool check_events_fit(FaultList& list, const Scenario& scenario, std::size_t targets, std::size_t robots) {
  const std::size_t at_most = check_in_order(list, scenario, targets, robots);
  if (at_most + 1 <= robots) return true;
  list.fail("swarm.robots",
            std::to_string(robots) + " robots cannot serve " + std::to_string(at_most) +
                " targets: each needs a worker, and the root is none of them",
            {"targets.count", "targets.positions_m", "swarm.redundancy"});
  return false;
}

std::vector<Fault> event_faults(const Scenario& scenario, const Present* now) {
  FaultList list;
  check_event_values(list, scenario.events);
  const std::size_t robots = free_robot_count(scenario);
  if (!list.failed()) check_events_fit(list, scenario, target_positions(scenario).size(), robots);
  if (list.failed() || now == nullptr || scenario.events.empty()) return list.take();
  const std::size_t last = scenario.events.size() - 1;
  if (scenario.events[last].when != Event::When::time)
    list.fail(element("events", last) + ".when", "what somebody does happens now");
  const std::size_t at_start = target_positions(scenario).size();
  // NOLINTNEXTLINE(bugprone-unused-raii): its constructor is the check
  CheckEventFits(list, scenario, End(scenario), last,
                 {now->targets,
                  0,
                  0,
                  {},
                  now->obstacles,
                  now->robots,
                  now->places,
                  at_start - held_by_stations(scenario),
                  at_start});
  return list.take();
}

}  // namespace banyan::world
