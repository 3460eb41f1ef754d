// SPDX-License-Identifier: MIT
// What happens to a world at the beginning of a tick: targets move, robots die, freeze or fall silent,
// missions change, robots join.
#include <algorithm>
#include <limits>
#include <utility>

#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"
#include "world_impl.hpp"

namespace banyan::world {
namespace {

constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();

}  // namespace

void World::Impl::happen() {
  drive_targets();
  send_to_visits();
  const double now_s = static_cast<double>(tick) * scenario.tick_s;
  watch_for_moments(now_s);
  while (const auto entry = event_queue.take(now_s + time_rounding_s(scenario))) apply(*entry);
}

void World::Impl::drive_targets() {
  for (std::size_t t = 0; t < targets.size(); ++t) {
    TargetMotion& course = courses[t];
    if (course.speed_m_s == 0.0) continue;
    const Vec2 way = course.goal - targets[t].position;
    const double way_m = norm(way);
    const double step_m = course.speed_m_s * scenario.tick_s;
    targets[t].position = step_m < way_m ? targets[t].position + way * (step_m / way_m) : course.goal;
    if (step_m >= way_m) course.speed_m_s = 0.0;
  }
}

// Places where somebody has been are done with; others that take too long have to wait for their next turn. Spares
// only are sent, since a connector has others below it: the nearest to any place that has been tried least often.
void World::Impl::send_to_visits() {
  if (!scenario.visits.positions) return;
  constexpr double ways = 4.0, ticks = 100.0;
  std::size_t under_way = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].visit || !targets[t].active) continue;
    if (holder(t)) {
      ++visited;
      give_up(t);
    } else if (tick >= courses[t].until) {
      visits.push_back({targets[t].position, courses[t].tried + 1});
      give_up(t);
    } else {
      ++under_way;
    }
  }
  for (; under_way < scenario.visits.at_once.value_or(1) && !visits.empty(); ++under_way) {
    int least = std::numeric_limits<int>::max();
    for (const Visit& visit : visits) least = std::min(least, visit.tried);
    double best_m = std::numeric_limits<double>::infinity();
    std::size_t robot = alive.size(), chosen = 0;
    for (std::size_t k = 0; k < visits.size(); ++k)
      for (std::size_t i = 0; i < alive.size() && visits[k].tried == least; ++i) {
        const double way_m = distance(poses.position[i], visits[k].place);
        if (alive[i] == 0 || reports[i].role != Role::spare || target_of[i] >= 0 || station_of(i) != nullptr ||
            way_m >= best_m)
          continue;
        best_m = way_m;
        robot = i;
        chosen = k;
      }
    if (robot == alive.size()) return;  // nobody is free
    const Visit visit = visits[chosen];
    visits.erase(visits.begin() + static_cast<std::ptrdiff_t>(chosen));
    const double patience_s =
        scenario.visits.patience_s.value_or(ways * best_m / scenario.robot.wheel_limit_m_s + ticks * scenario.tick_s);
    send(robot, visit.place);
    targets.back().visit = true;
    courses.back().until = tick_after(patience_s);
    courses.back().tried = visit.tried;
  }
}

// ---- Moments of the mission ----

void World::Impl::watch_for_moments(double now_s) {
  if (event_queue.waits_for(Event::When::half_way) && half_way()) event_queue.come(Event::When::half_way, now_s);
  if (event_queue.waits_for(Event::When::complete) && complete()) event_queue.come(Event::When::complete, now_s);
}

// From the target to the nearest living robot that serves it; to its first worker if none does.
double World::Impl::remaining_m(std::size_t target) const noexcept {
  const auto& [position, first, active, visit] = targets[target];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < alive.size(); ++i)
    if (alive[i] != 0 && reports[i].role == Role::worker && reports[i].serves == static_cast<RobotId>(first))
      least = std::min(least, distance(poses.position[i], position));
  return least < std::numeric_limits<double>::infinity() ? least : distance(poses.position[first], position);
}

bool World::Impl::half_way() const noexcept {
  double at_first = 0.0;
  double now = 0.0;
  bool any = false;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active || targets[t].visit || station_of(targets[t].worker) != nullptr) continue;
    any = true;
    at_first += courses[t].start_m;
    now += remaining_m(t);
  }
  return any && now <= 0.5 * at_first;
}

// Whether every target is held and connected (tree_parts.hpp), as of the last step.
bool World::Impl::complete() {
  bool any = visited > 0;
  if (!visits.empty()) return false;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active) continue;
    any = true;
    if (!holder(t)) return false;
  }
  return any && tree_parts.count(alive, reports, [this](std::size_t i) { return radio.links(i); }) == 1;
}

std::optional<std::size_t> World::Impl::holder(std::size_t target) const noexcept {
  if (target >= targets.size() || !targets[target].active) return std::nullopt;
  const auto& [position, first, active, visit] = targets[target];
  std::optional<std::size_t> best;
  double best_m = 0.0;
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (alive[i] == 0 || reports[i].role != Role::worker || reports[i].serves != static_cast<RobotId>(first)) continue;
    const double away_m = distance(poses.position[i], position);
    if (away_m > target_tolerance_m(scenario) || (best && away_m >= best_m)) continue;
    best = i;
    best_m = away_m;
  }
  return best;
}

// ---- What an event does ----

namespace {

template <class... Functions> struct Overloaded : Functions... { using Functions::operator()...; };
template <class... Functions> Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace

void World::Impl::apply(const EventQueue::Entry& entry) {
  std::visit(
      Overloaded{
          [&](const Die& e) { die(e.robot); },
          [&](const Freeze& e) { frozen_until[e.robot] = e.duration_s > 0.0 ? tick_after(e.duration_s) : forever; },
          [&](const SetLoss& e) { loss = e.loss; },
          [&](const MoveTarget& e) { move_target(e.target, e.position, e.speed_m_s); },
          [&](const AddTarget& e) { assign_target(e.position); },
          [&](const Kill& e) { kill(e, entry); },
          [&](const Blackout& e) { silent_until = std::max(silent_until, tick_after(e.duration_s)); },
          [&](const RemoveTarget& e) { give_up(e.target); },
          [&](const SetLineOfSight& e) { set_line_of_sight(e.line_of_sight); },
          [&](const MoveObstacle&) { change_obstacles(entry.event.action); },
          [&](const AddObstacle&) { change_obstacles(entry.event.action); },
          [&](const RemoveObstacle&) { change_obstacles(entry.event.action); },
          [&](const Join& e) { join(e.robot, e.position); },
      },
      entry.event.action);
}

std::uint64_t World::Impl::tick_after(double duration_s) const noexcept {
  return tick + static_cast<std::uint64_t>(duration_s / scenario.tick_s + 0.5);
}

void World::Impl::die(std::size_t i) {
  if (alive[i] == 0) return;
  alive[i] = 0;
  ++deaths;
  last_death = tick;
  if (scenario.robot.dead_bodies) return;
  bodies->remove(i);
  radio.forget(static_cast<std::uint32_t>(i));
}

// Nothing if it is there already, or if one before it has not come yet.
void World::Impl::join(std::size_t i, Vec2 position) {
  if (i >= alive.size() || i > arrived || alive[i] != 0) return;
  arrived = std::max(arrived, i + 1);
  alive[i] = 1;
  frozen_until[i] = 0;
  target_of[i] = -1;
  given_up[i] = nobody;
  commands[i] = {};
  poses.position[i] = position;
  bodies->arrive(i);
  batteries.renew(i);
  if (i < clocked.size()) {
    clocked[i].shift = {};
    clocked[i].turn = 0.0;
  }
  swarm->restart(i);
  reports[i] = swarm->report(i);
}

// How many die is fixed when the event begins; which robots, is drawn each time.
void World::Impl::kill(const Kill& event, EventQueue::Entry entry) {
  if (!entry.begun) {
    entry.begun = true;
    entry.begin_s = entry.due_s;
    entry.left = event.share
                     ? static_cast<std::uint64_t>(*event.share * static_cast<double>(count_among(event.of)) + 0.5)
                     : event.count.value_or(1);
  }
  do {
    if (entry.left == 0) return;
    draw_victim(event.of, entry);
    ++entry.drawn;
    --entry.left;
  } while (event.every_s == 0.0);
  if (entry.left == 0) return;
  entry.due_s = entry.begin_s + static_cast<double>(entry.drawn) * event.every_s;
  event_queue.again(entry);
}

bool World::Impl::among(Kill::Of of, std::size_t i) const noexcept {
  if (alive[i] == 0 || station_of(i) != nullptr) return false;
  switch (of) {
    case Kill::Of::robots: return true;
    case Kill::Of::connectors: return reports[i].role == Role::connector;
    case Kill::Of::root: return reports[i].role == Role::root;
    default: return reports[i].role == Role::worker;
  }
}

std::size_t World::Impl::count_among(Kill::Of of) const noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < alive.size(); ++i) count += among(of, i) ? 1 : 0;
  return count;
}

// Each candidate with the same chance. If none is left, no robot dies.
void World::Impl::draw_victim(Kill::Of of, const EventQueue::Entry& entry) {
  const double u = to_uniform(bits(scenario.seed, Purpose::kill, entry.number, entry.drawn));
  auto rank = static_cast<std::size_t>(u * static_cast<double>(count_among(of)));
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (!among(of, i) || rank-- > 0) continue;
    const RobotId parent = up_of(reports[i]);
    die(i);
    if (of == Kill::Of::worker_and_parent && parent != nobody && station_of(parent) == nullptr) die(parent);
    return;
  }
}

void World::Impl::move_target(std::size_t target, Vec2 position, double speed_m_s) {
  if (target >= targets.size()) return;  // it may never have found a worker (assign_target)
  if (speed_m_s == 0.0) targets[target].position = position;
  courses[target].goal = position;
  courses[target].speed_m_s = speed_m_s;
}

// A new target goes to the nearest living spare, since a connector has others below it; to the nearest
// connector if there is not a spare. Not to a robot sent to a target before: its id names that target for
// as long as any robot may serve it.
void World::Impl::assign_target(Vec2 position) {
  std::size_t best = alive.size();
  const auto key = [&](std::size_t i) {
    return std::pair(reports[i].role != Role::spare, squared_norm(poses.position[i] - position));
  };
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (alive[i] == 0 || is_worker(i) || reports[i].role == Role::root || target_of[i] >= 0 || station_of(i) != nullptr)
      continue;
    if (best == alive.size() || key(i) < key(best)) best = i;
  }
  if (best < alive.size()) send(best, position);  // else no robot is left to send
}

void World::Impl::send(std::size_t i, Vec2 position) {
  target_of[i] = static_cast<std::int32_t>(targets.size());
  targets.push_back({.position = position, .worker = i});
  courses.push_back({.start_m = distance(poses.position[i], position)});
}

// The robot that serves the target is told to stop.
void World::Impl::give_up(std::size_t target) {
  if (target >= targets.size() || !targets[target].active) return;
  targets[target].active = false;
  courses[target].speed_m_s = 0.0;
  const std::size_t first = targets[target].worker;
  target_of[first] = -1;
  for (std::size_t i = 0; i < alive.size(); ++i)
    if (reports[i].serves == static_cast<RobotId>(first)) given_up[i] = static_cast<RobotId>(first);
}

// The robots are told, too: their parameter of the same name follows.
void World::Impl::set_line_of_sight(bool on) {
  line_of_sight = on;
  swarm->set_line_of_sight(on);
  radio.occlude(on, obstacles);
}

// Nothing if an event that waited for its moment has taken away what this one refers to.
void World::Impl::change_obstacles(const Action& action) {
  if (!change(obstacles, action)) return;
  bodies->set_obstacles(obstacles);
  radio.occlude(line_of_sight, obstacles);
  proximity.set_obstacles(obstacles);
}

// ---- Interventions in a running world ----

Scenario World::Impl::with(const Event& event) const {
  Scenario changed = scenario;
  changed.events.push_back(event);
  changed.events.back().time_s = static_cast<double>(tick) * scenario.tick_s;
  return changed;
}

// Settings that an event can change.
void World::Impl::add_events(Digest& digest) const noexcept {
  digest.add(silent_until);
  if (alive.size() != robot_count(scenario)) digest.add(arrived);
  digest.add(line_of_sight);
  digest.add(obstacles.size());
  for (const Obstacle& obstacle : obstacles) {
    digest.add(center_of(obstacle));
    if (const Disc* disc = std::get_if<Disc>(&obstacle); disc != nullptr) digest.add(disc->radius_m);
  }
  digest.add(targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    digest.add(targets[t].active);
    digest.add(courses[t].start_m);
    digest.add(courses[t].goal);
    digest.add(courses[t].speed_m_s);
  }
  if (!scenario.visits.positions) return;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    digest.add(targets[t].visit);
    digest.add(courses[t].until);
    digest.add(courses[t].tried);
  }
  for (const Visit& visit : visits) {
    digest.add(visit.place);
    digest.add(visit.tried);
  }
}

}  // namespace banyan::world
