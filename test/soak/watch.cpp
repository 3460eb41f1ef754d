// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "banyan/world/threads.hpp"
#include "free_path.hpp"
#include "in_reach.hpp"
#include "mission.hpp"
#include "sight.hpp"
#include "start_loss.hpp"
#include "terminal.hpp"

namespace banyan::soak {

using namespace cli;
namespace {

using namespace world;
using world::Vec2;

constexpr std::uint64_t hidden_ticks = 3;  // that an edge may be hidden
constexpr double two_roots_s = 5.0;        // that a hand-over may take
constexpr double after_completion_s = 10.0;
constexpr double after_event_s = 50.0;
constexpr double most_loss = 0.3;      // of the packets, over the links of the start, that convoy is made for
constexpr double longest_link = 0.95;  // of C, over which a start has to be joined for its network to be promised whole
constexpr double rounding = 1e-9;
constexpr double surely = 4.0;  // standard deviations of the noise of wheels

class MissionWatch {
 public:
  explicit MissionWatch(const Scenario& scenario)
      : world_(scenario), sight_(world_), traits_(traits_of(scenario)), limit_s_{time_limit_s(scenario)} {
    linked_ = scenario.radio.model != RadioModel::Model::one_way ||
              sight_.components_both_ways(std::vector<bool>(world_.size(), true)) == 1;
    const bool by_length = scenario.radio.model == RadioModel::Model::path_loss;  // others lose as much over all links
    const std::vector<double> links_m = by_length ? sight_.link_lengths_m() : std::vector<double>{sight_.range_m()};
    faint_ = mean_loss(scenario.radio, links_m) > most_loss + rounding;
    start_ = {world_.positions().begin(), world_.positions().end()};
    for (const Target& target : world_.targets()) {
      const double way_m = free_path_m(scenario.obstacles, world_.positions()[target.worker], target.position);
      const double drive_s = (way_m - world::target_tolerance_m(scenario)) / scenario.robot.wheel_limit_m_s;
      outcome_.bound_s = std::max(outcome_.bound_s, drive_s);
    }
  }

  SoakOutcome run() {
    while (!finished()) {
      const std::vector<std::uint8_t> alive(world_.alive().begin(), world_.alive().end());
      world_.step();
      look_at_numbers();
      look_for_splits(alive);
      look_at_edges();
      look_at_roles();
      look_at_targets();
    }
    if (!outcome_.complete && !is_out_of_reach() && !is_out_of_time())
      find("incomplete", format("not complete within %.1f s", limit_s_));
    outcome_.time_s = world_.time_s();
    outcome_.hash = world_.hash();
    return std::move(outcome_);
  }
  [[nodiscard]] std::uint64_t ticks() const { return world_.tick(); }

 private:
  [[nodiscard]] bool finished() const {
    if (world_.time_s() >= limit_s_ - 1e-9) return true;
    return outcome_.complete && !world_.pending_kills() && world_.time_s() >= quiet_since() + after_completion_s;
  }
  // The moment after which nothing more is to happen: the last of completion, deaths and timed events.
  [[nodiscard]] double quiet_since() const {
    double since = outcome_.complete_s;
    for (const Event& event : world_.scenario().events)
      if (event.when == Event::When::time) since = std::max(since, event.time_s + after_event_s);
    if (const auto death = world_.last_death_tick())
      since = std::max(since, static_cast<double>(*death) * world_.scenario().tick_s + after_event_s);
    return since;
  }
  void find(const char* kind, std::string text) {
    const auto same = [kind](const Finding& f) { return f.kind == kind; };
    if (std::none_of(outcome_.findings.begin(), outcome_.findings.end(), same))
      outcome_.findings.push_back({kind, world_.time_s(), std::move(text)});
  }

  void look_at_numbers() {
    for (std::size_t i = 0; i < world_.size(); ++i) {
      const Vec2 p = world_.positions()[i];
      const Vec2 h = world_.headings()[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || std::abs(norm(h) - 1.0) > 1e-6)
        find("not-a-number", format("robot %zu at (%g, %g), heading (%g, %g)", i, p.x, p.y, h.x, h.y));
    }
  }

  // Deaths that leave the living out of range of each other excuse a split until they are reunited. Where links in one
  // direction only have kept the network in parts since the start, nobody has torn it.
  void look_for_splits(const std::vector<std::uint8_t>& before) {
    std::vector<bool> living(world_.alive().begin(), world_.alive().end());
    const std::size_t parts = sight_.components(living, false);
    const bool deaths = !std::equal(before.begin(), before.end(), world_.alive().begin());
    if (deaths && parts > 1) excused_ = true;
    linked_ = linked_ || sight_.components_both_ways(living) == 1;
    if (parts > 1 && !excused_)
      find(!linked_ ? "unlinked-split"
           : faint_ ? "faint-split"
                    : "split",
           format("the living robots are in %zu parts by distance", parts));
    const bool hides = parts == 1 && world_.line_of_sight();
    if (!hides) hidden_split_ = 0;
    if (parts > 1) return;
    excused_ = false;
    if (!hides) return;
    hidden_split_ = sight_.components(living, true) > 1 ? hidden_split_ + 1 : 0;
    if (hidden_split_ > hidden_ticks) find("hidden-split", "the living robots are in several parts by sight");
  }

  void look_at_edges() {
    for (std::size_t i = 0; i < world_.size(); ++i) {
      const Report& report = world_.reports()[i];
      if (world_.alive()[i] == 0 || report.role == Role::spare || report.role == Role::root) continue;
      look_at_edge(i, report.parent);
      if (report.old_parent != report.parent) look_at_edge(i, report.old_parent);
    }
    std::erase_if(hidden_since_, [&](const auto& entry) { return entry.second.second != world_.tick(); });
  }
  void look_at_edge(std::size_t child, std::size_t parent) {
    if (parent >= world_.size() || world_.alive()[parent] == 0) return;
    const double length = distance(world_.positions()[child], world_.positions()[parent]);
    if (!sight_.in_range(child, parent)) {
      find("broken-edge", format("the edge of robot %zu to %zu is %.3f m long", child, parent, length));
    } else if (world_.line_of_sight() && sight_.hidden(child, parent)) {
      auto& [first, last] = hidden_since_.try_emplace({child, parent}, world_.tick(), 0).first->second;
      last = world_.tick();
      if (last - first >= hidden_ticks) find("hidden-edge", format("the edge of robot %zu to %zu", child, parent));
    }
  }

  void look_at_roles() {
    std::size_t roots = 0;
    std::uint32_t replaced = 0;
    std::uint32_t elected = 0;
    for (std::size_t i = 0; i < world_.size(); ++i) {
      const Report& report = world_.reports()[i];
      roots += world_.alive()[i] != 0 && report.role == Role::root ? 1 : 0;
      replaced += report.tally.replacements;
      elected += report.tally.elections;
    }
    two_roots_ = roots > 1 ? two_roots_ + 1 : 0;
    if (static_cast<double>(two_roots_) * world_.scenario().tick_s > two_roots_s)
      find("two-roots", format("%zu roots for more than %.0f s", roots, two_roots_s));
    if (traits_.deaths) return;
    // A robot that freezes, or cannot reach its target past an obstacle, may rightly be replaced.
    const bool held_up = traits_.changes || traits_.obstacles;
    if (replaced > 0)
      find("replaced",
           held_up ? "a living worker is replaced; it may have been held up" : "a living worker is replaced");
    if (elected > 0) find("elected", "a root is elected although it lives");
  }

  // Held: by the worker's position and the target that it reports; connected: as in Sight.
  void look_at_targets() {
    if (outcome_.complete) return;
    for (const Target& target : world_.targets()) {
      bool held = !target.active;
      for (std::size_t i = 0; i < world_.size() && !held; ++i)
        held = world_.alive()[i] != 0 && world_.reports()[i].role == Role::worker &&
               world_.reports()[i].serves == target.worker &&
               distance(world_.positions()[i], target.position) <= world::target_tolerance_m(world_.scenario());
      if (!held) return;
    }
    std::vector<bool> tree(world_.size());
    for (std::size_t i = 0; i < tree.size(); ++i)
      tree[i] = world_.alive()[i] != 0 && world_.reports()[i].role != Role::spare;
    outcome_.complete = sight_.components(tree, world_.line_of_sight()) == 1;
    if (outcome_.complete) outcome_.complete_s = world_.time_s();
  }

  // No network of so few robots comes within tolerance of all targets: a tree over them is at least 0.8241
  // times as long as their shortest spanning tree (Chung & Graham 1985).
  [[nodiscard]] bool is_out_of_reach() const {
    std::vector<Vec2> left;
    for (const Target& target : world_.targets())
      if (target.active) left.push_back(target.position);
    if (left.empty()) return true;
    const auto count = static_cast<double>(left.size());
    double length = 0.0;
    std::vector<Vec2> tree{left.back()};
    left.pop_back();
    std::vector<double> gap(left.size(), std::numeric_limits<double>::infinity());
    while (!left.empty()) {
      for (std::size_t i = 0; i < left.size(); ++i) gap[i] = std::min(gap[i], distance(left[i], tree.back()));
      const auto nearest = std::min_element(gap.begin(), gap.end()) - gap.begin();
      length += gap[static_cast<std::size_t>(nearest)];
      tree.push_back(left[static_cast<std::size_t>(nearest)]);
      left.erase(left.begin() + nearest);
      gap.erase(gap.begin() + nearest);
    }
    const auto alive = std::count(world_.alive().begin(), world_.alive().end(), 1);
    const double tolerance = world::target_tolerance_m(world_.scenario());
    const double links = (0.8241 * length - count * tolerance) / sight_.range_m();
    return static_cast<double>(alive) < std::max(links + 1.0, count + 1.0);
  }

  // Nor can they be there in time if some targets are too far from where all robots but a few start. Targets that come
  // later or move do not count.
  [[nodiscard]] bool is_out_of_time() const {
    std::vector<bool> moves(world_.targets().size());
    for (const Event& event : world_.scenario().events)
      if (const auto* move = std::get_if<MoveTarget>(&event.action); move != nullptr && move->target < moves.size())
        moves[move->target] = true;
    std::vector<Vec2> targets;
    for (std::size_t k = 0; k < target_positions(world_.scenario()).size(); ++k)
      if (world_.targets()[k].active && !moves[k]) targets.push_back(world_.targets()[k].position);
    const RobotModel& robot = world_.scenario().robot;
    const double fastest_m_s = robot.wheel_limit_m_s * (1.0 + surely * (robot.wheel_noise + robot.wheel_bias));
    return !all_in_reach(start_, targets, fastest_m_s * limit_s_ + world::target_tolerance_m(world_.scenario()));
  }

  World world_;
  SightCheck sight_;
  Traits traits_;
  double limit_s_;
  std::vector<Vec2> start_;
  bool excused_ = false;
  bool faint_ = false;  // the links of the start lose more than convoy is made for
  bool linked_;         // until now at some time, by links of which both ends hear each other
  std::uint64_t hidden_split_ = 0, two_roots_ = 0;
  std::map<std::pair<std::size_t, std::size_t>, std::pair<std::uint64_t, std::uint64_t>> hidden_since_;  // first, last
  SoakOutcome outcome_;
};

bool starts_joined(const Scenario& scenario) {
  const World world(scenario);
  const SightCheck sight(world);
  return sight.components_within(std::vector<bool>(world.size(), true), longest_link * sight.range_m() + rounding) == 1;
}

}  // namespace

SoakOutcome watch(const Scenario& scenario, bool twice) {
  MissionWatch first(scenario);
  SoakOutcome outcome = first.run();
  if (!twice) return outcome;
  Executor executor(2);
  World again(scenario);
  while (again.tick() < first.ticks()) again.step(executor);
  if (again.hash() != outcome.hash)
    outcome.findings.push_back({"not-reproducible", outcome.time_s, "another hash on two threads"});
  return outcome;
}

bool is_promised(const std::string& kind, const Scenario& scenario) {
  if (kind == "crash" || kind == "not-a-number" || kind == "not-reproducible") return true;
  const Traits t = traits_of(scenario);
  const bool calm =
      !t.deaths && !t.noise && !t.obstacles && !t.changes && !t.clocks && !t.small_radio && !t.rough_radio && !t.many;
  return kind == "split" && calm && starts_joined(scenario);
}

}  // namespace banyan::soak
