// SPDX-License-Identifier: MIT
// What happened between two frames (events.hpp).
#include "banyan/record/events.hpp"

#include <algorithm>
#include <cmath>

#include "seen_bodies.hpp"
#include "text.hpp"

namespace banyan::record {

namespace {

using RobotNames = std::vector<std::string>;

// By its name, or else its index.
std::string called(const RobotNames& names, std::int64_t robot) {
  const auto at = static_cast<std::size_t>(robot);  // -1: beyond all
  return at < names.size() && !names[at].empty() ? names[at] : std::to_string(robot);
}
std::string target_name(std::size_t target) { return "target T" + std::to_string(target); }

std::string metres(double value) {
  Text text;
  text.fixed(value, 2);
  text.put(" m");
  return std::string(text.view());
}

std::string place(Vec2 p) {
  Text text;
  text.put('(');
  text.fixed(p.x, 2);
  text.put(", ");
  text.fixed(p.y, 2);
  text.put(") m");
  return std::string(text.view());
}

bool has_robot(const Frame& frame, std::int32_t i) {
  return i >= 0 && static_cast<std::size_t>(i) < frame.robots.size();
}

// As in World::holder: the robot that serves the target now need not be the one first sent there.
bool serves(const Frame& frame, std::size_t i, std::size_t k) {
  if (i >= frame.robots.size()) return false;
  const RobotFrame& robot = frame.robots[i];
  return robot.alive && robot.role == Role::worker && robot.target == static_cast<std::int32_t>(k);
}

// The nearest robot that serves target k within tolerance, -1: none. O(robots).
std::int32_t holder_of(const Setting& setting, const Frame& frame, std::size_t k) {
  std::int32_t best = -1;
  double best_m = setting.target_tolerance_m;
  for (std::size_t i = 0; i < frame.robots.size() && frame.targets[k].active; ++i) {
    if (!serves(frame, i, k)) continue;
    const double away_m = distance(frame.robots[i].position, frame.targets[k].position);
    if (!(best < 0 ? away_m <= best_m : away_m < best_m)) continue;
    best = static_cast<std::int32_t>(i);
    best_m = away_m;
  }
  return best;
}

// Whether the robot was sent to the target that it serves; if not, it has taken another one's place.
bool was_sent(const Frame& frame, std::size_t i) {
  const auto target = static_cast<std::size_t>(frame.robots[i].target);  // -1: beyond all
  return target < frame.targets.size() && frame.targets[target].worker == static_cast<std::int32_t>(i);
}

// "a", "a and b", "a, b and 5 more".
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 4;
  std::string text;
  const std::size_t shown = names.size() > most ? most - 1 : names.size();
  for (std::size_t k = 0; k < shown; ++k) { text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k]; }
  return shown == names.size() ? text : text + " and " + std::to_string(names.size() - shown) + " more";
}

// An edge of the tree without a radio link, and why; the observer counts the same.
struct BrokenEdge {
  std::int32_t robot = -1, to = -1;
  bool old = false;
  std::string why;
};

// Why robots in range of each other have no line of sight; "" if they have one.
std::string occluded_by(const world::Scene& scene, const RobotNames& names, std::int32_t i, std::int32_t j) {
  const auto blocker = world::blocker(scene, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  if (!blocker) return "";
  const auto index = static_cast<std::int64_t>(blocker->index);
  return "occluded by " +
         (blocker->is_obstacle ? "obstacle " + std::to_string(index) : "robot " + called(names, index));
}

void judge_edge(const world::Scene& scene, const RobotNames& names, const Frame& frame, std::size_t i, bool old,
                std::vector<BrokenEdge>& broken) {
  const RobotFrame& robot = frame.robots[i];
  const std::int32_t to = old ? robot.old_parent : robot.parent;
  if (!has_robot(frame, to) || !frame.robots[static_cast<std::size_t>(to)].alive) return;
  const double length = distance(robot.position, frame.robots[static_cast<std::size_t>(to)].position);
  BrokenEdge edge{static_cast<std::int32_t>(i), to, old, ""};
  if (!(length < scene.range_m)) edge.why = metres(length) + " apart, out of range";
  else if (scene.line_of_sight) edge.why = occluded_by(scene, names, edge.robot, to);
  if (!edge.why.empty()) broken.push_back(std::move(edge));
}

// O(edges x robots): used only at moments at which an edge has broken.
std::vector<BrokenEdge> broken_edges(const Setting& setting, const Frame& frame) {
  std::vector<BrokenEdge> broken;
  const SeenBodies bodies(frame);
  const world::Scene scene = bodies.scene(setting);
  for (std::size_t i = 0; i < frame.robots.size(); ++i) {
    const RobotFrame& robot = frame.robots[i];
    if (!robot.alive || robot.role == Role::spare) continue;
    judge_edge(scene, setting.names, frame, i, false, broken);
    if (robot.old_parent != robot.parent) judge_edge(scene, setting.names, frame, i, true, broken);
  }
  return broken;
}

}  // namespace

std::string EventWatcher::robot_name(std::int64_t robot) const { return "robot " + called(*names_, robot); }

void EventWatcher::add(std::string_view kind, std::int64_t robot, std::int64_t target, std::string text) {
  events_.push_back({tick_, time_s_, std::string(kind), robot, target, std::move(text)});
}

const std::vector<RecordedEvent>& EventWatcher::watch(const Setting& setting, const Frame& frame,
                                                      const measure::Tick& tick) {
  events_.clear();
  tick_ = frame.tick;
  time_s_ = frame.time_s;
  names_ = &setting.names;
  if (started_) {
    watch_setting(setting);
    watch_robots(frame);
    watch_radio(tick);
    watch_edges(setting, frame, tick);
  }
  watch_targets(setting, frame, tick);
  started_ = true;
  setting_ = setting;
  last_ = frame;
  last_tick_ = tick;
  return events_;
}

// Continuous motion is reported once, when it begins.
void EventWatcher::watch_setting(const Setting& setting) {
  if (setting.line_of_sight != setting_.line_of_sight) {
    add("line_of_sight", -1, -1,
        setting.line_of_sight ? "links need a line of sight from now on" : "links need no line of sight from now on");
  }
  watch_obstacles(setting_.obstacles, setting.obstacles);
}

// Where fewer are left, the first that are not where one was are those that are gone; what is at the end is new.
void EventWatcher::watch_obstacles(std::span<const world::Obstacle> before, std::span<const world::Obstacle> now) {
  drifting_.resize(std::max(before.size(), now.size()), 0);
  std::size_t to = 0;
  for (std::size_t from = 0; from < before.size(); ++from) {
    const bool stays = to < now.size() && now[to] == before[from];
    if (!stays && now.size() - to < before.size() - from) {
      add("obstacle_removed", -1, -1, "obstacle " + std::to_string(from) + " is gone");
      continue;
    }
    if (!stays && drifting_[to] == 0) {
      add("obstacle_moved", -1, -1,
          "obstacle " + std::to_string(to) + " has moved to " + place(world::center_of(now[to])));
    }
    drifting_[to++] = stays ? 0 : 1;
  }
  for (; to < now.size(); ++to) {
    add("obstacle_added", -1, -1, "obstacle " + std::to_string(to) + " is new, at " + place(world::center_of(now[to])));
  }
}

void EventWatcher::watch_death(const Frame& frame, std::size_t i) {
  const RobotFrame& before = last_.robots[i];
  if (!before.alive || frame.robots[i].alive) return;
  const auto robot = static_cast<std::int64_t>(i);
  const auto children = std::count_if(last_.robots.begin(), last_.robots.end(), [&](const RobotFrame& r) {
    return r.alive && r.role != Role::spare && r.parent == robot;
  });
  std::string text =
      robot_name(robot) + " died, " + (before.role == Role::root ? "the " : "a ") + std::string(name_of(before.role));
  if (before.target >= 0) text += " of " + target_name(static_cast<std::size_t>(before.target));
  if (children > 0)
    text += "; " + std::to_string(children) + (children == 1 ? " child hangs" : " children hang") + " on it";
  add("death", robot, before.target, std::move(text));
}

// The token is offered to a neighbour in the tree; a robot that gets it otherwise has elected itself.
void EventWatcher::watch_root(const Frame& frame, std::size_t i) {
  const RobotFrame& before = last_.robots[i];
  const auto robot = static_cast<std::int64_t>(i);
  if (frame.robots[i].role == Role::root && before.role != Role::root) {
    std::int64_t earlier = -1;
    for (std::size_t k = 0; k < last_.robots.size(); ++k) {
      if (last_.robots[k].role != Role::root) continue;
      const auto candidate = static_cast<std::int64_t>(k);
      const bool neighbour = before.parent == candidate || before.old_parent == candidate;
      if (earlier < 0 || neighbour) earlier = candidate;
    }
    std::string text = robot_name(robot);
    if (earlier < 0) {
      text += " is root; there was none";
    } else if (!last_.robots[static_cast<std::size_t>(earlier)].alive) {
      text += " is root in place of " + robot_name(earlier) + ", which is dead";
    } else {
      const bool handed = before.parent == earlier || before.old_parent == earlier;
      text += handed ? " takes over the root from " + robot_name(earlier) : " is root beside " + robot_name(earlier);
    }
    add("root", robot, -1, std::move(text));
  }
  if (frame.robots[i].role != Role::root) return;
  // Phases are gossip; the root enters them first.
  const RobotFrame& now = frame.robots[i];
  if (now.epoch != before.epoch) add("epoch", robot, -1, "epoch " + std::to_string(now.epoch) + " begins");
  if (now.phase != before.phase) add("phase", robot, -1, "phase " + std::string(name_of(now.phase)));
}

// A spare that was let into an edge goes between the owner that it asked and the owner's parent.
void EventWatcher::watch_recruit(const Frame& frame, std::size_t i) {
  const RobotFrame& before = last_.robots[i];
  const RobotFrame& now = frame.robots[i];
  const auto robot = static_cast<std::int64_t>(i);
  if (before.role == Role::spare && now.role == Role::connector) {
    const bool asked = has_robot(frame, before.request) && now.request < 0 && has_robot(frame, now.parent);
    if (asked && now.parent != before.request) {
      add("inserted", robot, -1,
          robot_name(robot) + " is inserted between " + robot_name(before.request) + " and " + robot_name(now.parent));
    } else {
      const auto child = std::find_if(frame.robots.begin(), frame.robots.end(), [&](const RobotFrame& r) {
        return r.alive && r.role != Role::spare && r.parent == robot;
      });
      const std::string who = child == frame.robots.end() ? "somebody" : robot_name(child - frame.robots.begin());
      add("recruited", robot, -1, robot_name(robot) + " is a connector: " + who + " hangs on it");
    }
  } else if (before.role != Role::worker && now.role == Role::worker && !was_sent(frame, i)) {
    const std::string what = now.target < 0 ? "the target" : target_name(static_cast<std::size_t>(now.target));
    add("worker", robot, now.target, robot_name(robot) + " takes over " + what + " of a worker that is lost");
  } else if (before.role == Role::connector && now.role == Role::spare) {
    add("released", robot, -1, robot_name(robot) + " is spare again");
  }
}

void EventWatcher::watch_robots(const Frame& frame) {
  const std::size_t n = std::min(frame.robots.size(), last_.robots.size());
  for (std::size_t i = 0; i < n; ++i) {
    watch_death(frame, i);
    if (!frame.robots[i].alive) continue;
    if (!last_.robots[i].alive) {
      add("join", static_cast<std::int64_t>(i), -1, robot_name(static_cast<std::int64_t>(i)) + " is back");
      continue;
    }
    watch_root(frame, i);
    watch_recruit(frame, i);
  }
  for (std::size_t i = n; i < frame.robots.size() && started_; ++i)
    add("join", static_cast<std::int64_t>(i), -1,
        robot_name(static_cast<std::int64_t>(i)) + " has joined at " + place(frame.robots[i].position));
}

// A target that keeps moving is reported once. After a move, a new arrival is reported only if the
// worker had really lost the target.
void EventWatcher::watch_target(const Setting& setting, const Frame& frame, std::size_t k) {
  constexpr double lost = 1.5;  // tolerances
  const TargetFrame& target = frame.targets[k];
  if (!target.active) {
    if (last_.targets[k].active)
      add("target_removed", target.worker, static_cast<std::int64_t>(k), target_name(k) + " is given up");
    return;
  }
  const bool moved = !(target.position == last_.targets[k].position);
  if (moved && moving_[k] == 0) {
    add("target_moved", target.worker, static_cast<std::int64_t>(k),
        target_name(k) + " has moved to " + place(target.position));
  }
  moving_[k] = moved ? 1 : 0;
  if (reached_[k] < 0) return;
  const auto who = static_cast<std::size_t>(reached_[k]);
  const bool near = serves(frame, who, k) && (!moved || distance(frame.robots[who].position, target.position) <=
                                                            lost * setting.target_tolerance_m);
  if (near) return;
  reached_[k] = -1;  // moved away, or its worker has died or resigned: the next worker there arrives
  complete_ = false;
}

void EventWatcher::watch_arrivals(const Setting& setting, const Frame& frame, const measure::Tick& tick) {
  for (std::size_t k = 0; k < frame.targets.size(); ++k) {
    if (reached_[k] >= 0) continue;
    const std::int32_t who = holder_of(setting, frame, k);
    if (who < 0) continue;
    reached_[k] = who;
    add("arrival", who, static_cast<std::int64_t>(k), robot_name(who) + " has reached " + target_name(k));
  }
  if (complete_ || !tick.complete()) return;
  complete_ = true;
  add("complete", -1, -1, "all targets are held, and the tree is in one piece");
}

void EventWatcher::watch_targets(const Setting& setting, const Frame& frame, const measure::Tick& tick) {
  reached_.resize(frame.targets.size(), -1);
  moving_.resize(frame.targets.size(), 0);
  for (std::size_t k = 0; k < frame.targets.size() && started_; ++k) {
    if (k < last_.targets.size()) {
      watch_target(setting, frame, k);
    } else {
      add("target_added", frame.targets[k].worker, static_cast<std::int64_t>(k),
          target_name(k) + " is new at " + place(frame.targets[k].position));
      complete_ = false;
    }
  }
  watch_arrivals(setting, frame, tick);
}

void EventWatcher::watch_radio(const measure::Tick& tick) {
  if (tick.components > 1 && last_tick_.components <= 1) {
    add("split", -1, -1, "the radio graph is in " + std::to_string(tick.components) + " parts");
  }
  if (tick.components <= 1 && last_tick_.components > 1) add("joined", -1, -1, "the radio graph is in one piece");
}

// Whenever more edges are broken than a tick ago: the new ones.
void EventWatcher::watch_edges(const Setting& setting, const Frame& frame, const measure::Tick& tick) {
  const auto broken = [](const measure::Tick& t) { return t.broken_by_distance + t.broken_by_occlusion; };
  const auto before = broken(last_tick_), now = broken(tick);
  if (now == 0 && before > 0) add("edges_whole", -1, -1, "no tree edge is broken any more");
  if (now <= before) return;
  auto edges = broken_edges(setting, frame);
  if (before > 0) {
    const auto earlier = broken_edges(setting_, last_);
    std::erase_if(edges, [&](const BrokenEdge& e) {
      return std::any_of(earlier.begin(), earlier.end(),
                         [&](const BrokenEdge& o) { return o.robot == e.robot && o.to == e.to; });
    });
  }
  const std::string all = before > 0 ? "; " + std::to_string(now) + " are now" : "";
  if (edges.size() == 1) {
    const BrokenEdge& edge = edges.front();
    add("edges_broken", edge.robot, -1,
        "the edge from " + robot_name(edge.robot) + " to its " + (edge.old ? "old parent, " : "parent, ") +
            robot_name(edge.to) + ", is broken: " + edge.why + all);
    return;
  }
  const auto count = edges.empty() ? now - before : static_cast<std::uint32_t>(edges.size());
  std::string text = std::to_string(count) + (before > 0 ? " more" : "") +
                     (count == 1 ? " tree edge is broken" : " tree edges are broken");
  if (before == 0 && tick.broken_by_distance > 0)
    text += ", " + std::to_string(tick.broken_by_distance) + " out of range";
  if (before == 0 && tick.broken_by_occlusion > 0)
    text += ", " + std::to_string(tick.broken_by_occlusion) + " occluded";
  std::vector<std::string> names;
  names.reserve(edges.size());
  for (const BrokenEdge& edge : edges) names.push_back(called(setting.names, edge.robot));
  if (!names.empty()) text += ": of the robots " + listed(names);
  add("edges_broken", edges.empty() ? -1 : edges.front().robot, -1, text + all);
}

}  // namespace banyan::record
