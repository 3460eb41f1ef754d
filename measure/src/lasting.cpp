// SPDX-License-Identifier: MIT
#include "banyan/measure/lasting.hpp"

#include <algorithm>
#include <limits>

#include "banyan/measure/metrics.hpp"

namespace banyan::measure {
namespace {

constexpr Column<Lasting::Row> lasting_table[] = {
    quantity<&Lasting::Row::least_charge>(
        "least_charge", "of any living robot at any time, as a share of a full battery; empty without batteries"),
    quantity<&Lasting::Row::mean_charge>("mean_charge", "of the living at the end; empty without batteries"),
    column<&Lasting::Row::swaps>("swaps", "robots of the tree with little charge that were relieved"),
    column<&Lasting::Row::broken_swaps>("broken_swaps", "of these, with a broken edge to either robot meanwhile"),
    column<&Lasting::Row::trips>("trips", "of spares to charging places, until they were charged or died"),
    column<&Lasting::Row::trips_arrived>("trips_arrived", "of these, those that ended in a slot"),
    column<&Lasting::Row::emptied>("emptied", "robots that died for want of charge"),
    quantity<&Lasting::Row::lasts_s>(
        "lasts_s", "the charge is used up so long after the end at most; empty if it is not, or without batteries"),
};

}  // namespace

std::span<const Column<Lasting::Row>> Lasting::columns() noexcept { return lasting_table; }

void Lasting::observe(const Moment& now, Row& row) {
  observe(now.world);
  now.tick.least_charge = least_;
  now.tick.mean_charge = mean_;
  if (least_ >= 0.0) row.least_charge = row.least_charge < 0.0 ? least_ : std::min(row.least_charge, least_);
  row.mean_charge = mean_;
}

void Lasting::sum_up(const Moment& end, Row& row) const {
  row.swaps = swaps_;
  row.broken_swaps = broken_swaps_;
  row.trips = trips();
  row.trips_arrived = arrived_;
  row.emptied = static_cast<std::uint32_t>(end.world.emptied());
  row.lasts_s = lasts_s(end.world, end.run.mean_committed);
}

Lasting::Lasting(const world::World& start)
    : range_m_(start.scenario().radio.range_m),
      after_ticks_(static_cast<std::uint32_t>(0.1 * world::drive_s(start.scenario()) / start.scenario().tick_s + 0.5)),
      courses_(start.charge().size()),
      touched_(start.charge().size()),
      relieved_(start.charge().size()) {
  for (std::size_t i = 0; i < courses_.size(); ++i) courses_[i].level = start.charge()[i];
}

void Lasting::mark_broken(const world::World& world) {
  const auto reports = world.reports();
  std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
  std::fill(relieved_.begin(), relieved_.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& m = reports[i];
    if (world.alive()[i] == 0 || m.role == Role::spare) continue;
    if (m.relieves < reports.size()) relieved_[m.relieves] = 1;
    for (const RobotId other : {m.parent, m.old_parent}) {
      if (other >= reports.size()) continue;
      const auto links = world.links(i);
      if (world.alive()[other] != 0 && std::binary_search(links.begin(), links.end(), std::uint32_t{other})) continue;
      touched_[i] = touched_[other] = 1;
    }
  }
  for (std::size_t i = 0; i < reports.size(); ++i)
    if (world.alive()[i] != 0 && touched_[i] != 0 && reports[i].relieves < reports.size())
      touched_[reports[i].relieves] = 1;
}

void Lasting::follow_swap(const world::World& world, std::size_t i) {
  Course& course = courses_[i];
  const Report& m = world.reports()[i];
  const bool spare = m.role == Role::spare;
  if (world.alive()[i] == 0) {
    course.stage = Stage::none;
    return;
  }
  if (course.stage == Stage::none && m.leaves) course.stage = Stage::leaving;
  if (course.stage == Stage::leaving && relieved_[i] != 0) course.stage = Stage::swapping, course.broken = false;
  if (course.stage == Stage::leaving && spare) course.broken = false;
  if ((course.stage == Stage::leaving || course.stage == Stage::swapping) && spare)
    course.stage = Stage::left, course.left_ticks = 0;
  else if (!spare && !m.leaves) course.stage = Stage::none;  // charged where it was
  course.broken |= touched_[i] != 0;
  if (course.stage != Stage::left || course.left_ticks++ < after_ticks_) return;
  ++swaps_;
  broken_swaps_ += course.broken ? 1 : 0;
  course.stage = Stage::none;
}

void Lasting::follow_trip(const world::World& world, std::size_t i) {
  Course& course = courses_[i];
  const bool alive = world.alive()[i] != 0;
  const bool seeks = world.reports()[i].seeks_charge;
  const bool charged = world.charged_at()[i] >= 0;
  if (course.travels && !alive) ++lost_;
  if (course.travels && alive && charged) ++arrived_;
  if (!alive || charged || !seeks) course.travels = false;
  else if (world.charge()[i] < course.level) course.travels = true;
}

void Lasting::observe(const world::World& world) {
  if (courses_.empty()) return;
  mark_broken(world);
  least_ = mean_ = -1.0;
  level_sum_ = 0.0;
  std::size_t living = 0;
  for (std::size_t i = 0; i < courses_.size(); ++i) {
    follow_swap(world, i);
    follow_trip(world, i);
    const double level = world.charge()[i];
    const double drawn = courses_[i].level - level;
    courses_[i].level = level;
    if (world.alive()[i] == 0) continue;
    least_ = living == 0 ? level : std::min(least_, level);
    level_sum_ += level;
    ++living;
    if (world.charged_at()[i] >= 0) continue;
    drawn_ += drawn;
    drawn_s_ += world.scenario().tick_s;
  }
  if (living > 0) mean_ = level_sum_ / static_cast<double>(living);
}

double Lasting::charging_share(const world::World& world, double draws_per_s) const noexcept {
  constexpr double span = 0.5;  // of a battery: what a robot has used when it is relieved, about
  constexpr double pace = 0.5;  // of the wheels' limit: robots make way for others, and turn
  const world::Scenario& s = world.scenario();
  double sum_m = 0.0;
  std::size_t posts = 0;
  for (std::size_t i = 0; i < courses_.size(); ++i) {
    if (world.alive()[i] == 0 || world.reports()[i].role == Role::spare) continue;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const world::Vec2 place : s.battery.places)
      nearest_m = std::min(nearest_m, distance(world.positions()[i], place));
    sum_m += nearest_m;
    ++posts;
  }
  const double gains_per_s = s.battery.charge_w / s.battery.capacity_j - draws_per_s;
  if (posts == 0 || gains_per_s <= 0.0) return 1.0;
  const double charging_s = span / gains_per_s;
  const double away_s = 2.0 * sum_m / static_cast<double>(posts) / (pace * s.robot.wheel_limit_m_s);
  return charging_s / (charging_s + away_s);
}

double Lasting::lasts_s(const world::World& world, double committed) const noexcept {
  if (courses_.empty() || drawn_s_ == 0.0) return -1.0;
  const world::Battery& battery = world.scenario().battery;
  const double each_per_s = drawn_ / drawn_s_;
  const auto living = static_cast<double>(std::count(world.alive().begin(), world.alive().end(), std::uint8_t{1}));
  const auto places = static_cast<double>(battery.places.size());
  const double free = std::max(0.0, living - committed + places);
  const double charged =
      std::min(places * static_cast<double>(battery.slots), free * charging_share(world, each_per_s));
  const double sinks_per_s = living * each_per_s - charged * battery.charge_w / battery.capacity_j;
  return sinks_per_s > 0.0 ? level_sum_ / sinks_per_s : -1.0;
}

}  // namespace banyan::measure
