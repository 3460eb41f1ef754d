// SPDX-License-Identifier: MIT
// Every verdict on a pair comes with a margin: how far robots may move before it could change. Clocks add up
// how far they have moved, and a pair is tested again when its clock has passed the margin. Margins are rounded
// down and clocks up, so that a verdict is always the one that the exact test would give at this
// moment.
//
// Usually one body matters, the one in the way or the one nearest to it: the clock of the three adds up its distance,
// the robot's and the other's. For all other bodies it is the largest distance that any robot around the first has
// moved in each tick, and that of the line of sight. A point of the line moves no farther than the end that moves more:
// so that is at most the largest once more, and at most the distances of both ends together. Which of the two clocks
// will be the slower one is guessed from the last tick: the first where most robots move, the second where most stand.
#include "banyan/world/radio.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "banyan/world/obstacles.hpp"

namespace banyan::world {
namespace {

constexpr std::size_t few_cells = 15;   // so few, and scanning all robots beats the grid
constexpr float far_away = 1e18F;        // its square is finite
constexpr float none_near = 1e30F;      // less than that
constexpr double skin_share = 0.1;      // of the range

// How far a body that blocks the segment from the origin to `d` may move until it is out of the way, as a
// distance on the clock of the three. Across the segment no body gets out faster than the clock runs. Along it
// the turning of the segment counts, too, by less than a third, since it is at least four radii long.
double depth(Vec2 k, Vec2 d, double length, double radius) noexcept {
  if (length < 4.0 * radius) return 0.0;
  const double per_m = 1.0 / length;
  const double along = dot(k, d) * per_m;
  const double across = std::fabs(cross(k, d)) * per_m;
  return std::min(std::min(along, length - along) * 0.66, radius - across);
}

// How far a body is from touching that segment.
double distance_beside(Vec2 k, Vec2 d, double d2, double radius) noexcept {
  const double along = std::clamp(dot(k, d) / d2, 0.0, 1.0);
  return norm(k - d * along) - radius;
}

// Four at a time. Compilers vectorise loops themselves, but not all of the following ones.
using Four = float __attribute__((vector_size(16)));
using FourWhole = std::int32_t __attribute__((vector_size(16)));
Four four(float v) noexcept { return Four{v, v, v, v}; }
FourWhole four(std::int32_t v) noexcept { return FourWhole{v, v, v, v}; }
Four load(const float* from) noexcept {
  Four v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
Four smaller(Four a, Four b) noexcept { return a < b ? a : b; }
// Not by a < b: a compiler that finds that comparison twice shares it, and takes no instruction for either any more.
Four larger(Four a, Four b) noexcept { return a > b ? a : b; }

// The smallest and the second smallest of the values offered, in each of four lanes.
struct TwoLeast {
  Four least = four(none_near);
  Four second = four(none_near);
  void offer(Four v) noexcept {
    second = smaller(second, larger(least, v));
    least = smaller(least, v);
  }
  void offer(const TwoLeast& other) noexcept {
    second = smaller(smaller(second, other.second), larger(least, other.least));
    least = smaller(least, other.least);
  }
  // Joins the lanes: the first one then holds the smallest of all.
  [[nodiscard]] TwoLeast joined() const noexcept {
    TwoLeast all = *this;
    all.offer(TwoLeast{Four{least[2], least[3], least[0], least[1]}, Four{second[2], second[3], second[0], second[1]}});
    const Four l = all.least;
    const Four s = all.second;
    all.offer(TwoLeast{Four{l[1], l[0], l[3], l[2]}, Four{s[1], s[0], s[3], s[2]}});
    return all;
  }
};

}  // namespace

Radio::Radio(const Scenario& scenario, std::size_t robots)
    : range_m_(scenario.radio.range_m),
      radius_m_(scenario.robot.radius_m),
      near_m_(2.0 * scenario.robot.radius_m + 4.0 * scenario.robot.wheel_limit_m_s * scenario.tick_s + 0.01),
      line_of_sight_(scenario.radio.line_of_sight),
      leaky_(scenario.radio.sight_leak > 0.0),
      dead_vanish_(!scenario.robot.dead_bodies),
      obstacles_(scenario.obstacles),
      raised_(leaky_ ? robots : 0, 0),
      nobody_(static_cast<std::uint32_t>(robots)),
      path_(robots + 1, 0),
      step_(robots, 0),
      around_(robots, 0),
      rows_(robots),
      lower_(robots),
      pairs_(robots),
      cell_of_(robots, 0),
      sorted_(robots, 0),
      links_(robots) {
  // A body that blocks a pair is within the range and a radius of both. The rest of the reach may be used up before
  // the row is rewritten: the skin, and the distance that two robots move in the tick of the rewriting.
  const double skin_m = skin_share * range_m_;
  const double tick_m = 4.0 * scenario.robot.wheel_limit_m_s * scenario.tick_s;
  reach_m_ = std::max(range_m_, near_m_) + radius_m_ + skin_m + tick_m;
  units_per_m_ = units_per_reach / reach_m_;
  skin_ = static_cast<Way>(skin_m * units_per_m_);
  valid_ = static_cast<Way>(0.99 * (skin_m + tick_m) * units_per_m_);
}

void Radio::update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Executor& executor) {
  if (!follow(positions, alive) && !raised_anew_) return;
  scratch_.resize(std::max(scratch_.size(), static_cast<std::size_t>(executor.threads())));
  const auto refresh_all = [&] {
    executor.parallel_for(positions.size(), [&](std::size_t begin, std::size_t end, int worker) {
      Scratch& s = scratch_[static_cast<std::size_t>(worker)];
      for (std::size_t i = begin; i < end; ++i) {
        if (all_anew_ || !rows_[i].known || static_cast<std::int32_t>(rows_[i].quiet_until - fast_clock(i)) < 0) refresh(i, positions, s);
        if (leaky_) look_over(i, positions, s);
      }
    });
  };
  for (Scratch& s : scratch_) {
    s.rebuild = s.no_room = false;
    s.changes.clear();
    s.changes.reserve(rows_.size());
  }
  refresh_all();
  if (std::any_of(scratch_.begin(), scratch_.end(), [](const Scratch& s) { return s.no_room; })) {
    make_room(positions);
    refresh_all();
  }
  all_anew_ = raised_anew_ = false;
  apply_changes();
}

void Radio::raise(std::span<const std::uint8_t> raised) {
  if (std::equal(raised.begin(), raised.end(), raised_.begin(), raised_.end())) return;
  raised_.assign(raised.begin(), raised.end());
  raised_anew_ = true;
}

void Radio::forget(std::uint32_t i) {
  std::erase_if(near_, [i](const Couple& couple) { return couple.first == i || couple.second == i; });
}

// ---- How far all robots have moved ----

// Brings the clocks up to date. False if nothing has happened since the last update.
bool Radio::follow(std::span<const Vec2> positions, std::span<const std::uint8_t> alive) {
  bool rows_anew = last_.empty();
  if (!std::equal(alive.begin(), alive.end(), alive_.begin(), alive_.end())) {
    alive_.assign(alive.begin(), alive.end());
    all_anew_ = true;
    rows_anew |= dead_vanish_;
  }
  if (last_.empty()) last_.assign(positions.begin(), positions.end());
  lay_grid(positions);
  motion_.assign(columns_ * lines_, 0);
  Way farthest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    step_[i] = 0;
    if (positions[i] == last_[i]) continue;
    const double way = std::min(distance(positions[i], last_[i]) * units_per_m_, static_cast<double>(units_per_reach));
    const Way up = static_cast<Way>(way) + 1;
    last_[i] = positions[i];
    step_[i] = up;
    path_[i] += up;
    motion_[cell_of_[i]] = std::max(motion_[cell_of_[i]], up);
    farthest = std::max(farthest, up);
  }
  // A robot that jumps arrives near others that have not counted its motion.
  if (rows_anew || 2 * farthest > valid_)
    for (Row& row : rows_) row.known = false;
  if (farthest > 0) spread_motion();
  const auto due = [&](std::size_t i) { return !rows_[i].known || clock(i) - rows_[i].written > skin_; };
  std::size_t i = 0;
  while (use_grid_ && i < rows_.size() && !due(i)) ++i;
  if (use_grid_ && i < rows_.size()) sort_into_cells();
  return farthest > 0 || all_anew_ || rows_anew;
}

// Cells are as wide as a row reaches, so that every robot within reach is in the same cell or one beside it.
// The number of cells stays below 4 N, so that a wide, thin swarm costs no more memory than a dense one:
// the cells grow instead.
void Radio::lay_grid(std::span<const Vec2> positions) {
  Vec2 low = positions[0];
  Vec2 high = positions[0];
  for (const Vec2 p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  cell_m_ = reach_m_;
  const double limit = 4.0 * static_cast<double>(positions.size()) + 16.0;
  while (((high.x - low.x) / cell_m_ + 1.0) * ((high.y - low.y) / cell_m_ + 1.0) > limit) cell_m_ *= 2.0;
  columns_ = static_cast<std::size_t>((high.x - low.x) / cell_m_) + 1;
  lines_ = static_cast<std::size_t>((high.y - low.y) / cell_m_) + 1;
  use_grid_ = columns_ * lines_ > few_cells;
  const double per_m = 1.0 / cell_m_;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    // Rounding may put the outermost robot one cell too far.
    const std::size_t column = std::min(static_cast<std::size_t>((positions[i].x - low.x) * per_m), columns_ - 1);
    const std::size_t line = std::min(static_cast<std::size_t>((positions[i].y - low.y) * per_m), lines_ - 1);
    cell_of_[i] = static_cast<std::uint32_t>(line * columns_ + column);
  }
}

// Around a robot none has moved farther than the one that moved farthest in its cell and the eight beside it.
void Radio::spread_motion() {
  across_.resize(motion_.size());
  for (std::size_t l = 0; l < lines_; ++l) {
    const Way* motion = motion_.data() + l * columns_;
    Way* across = across_.data() + l * columns_;
    for (std::size_t c = 0; c < columns_; ++c)
      across[c] = std::max({motion[c > 0 ? c - 1 : c], motion[c], motion[c + 1 < columns_ ? c + 1 : c]});
  }
  for (std::size_t l = 0; l < lines_; ++l) {
    const Way* below = across_.data() + (l > 0 ? l - 1 : l) * columns_;
    const Way* here = across_.data() + l * columns_;
    const Way* above = across_.data() + (l + 1 < lines_ ? l + 1 : l) * columns_;
    for (std::size_t c = 0; c < columns_; ++c) motion_[l * columns_ + c] = std::max({below[c], here[c], above[c]});
  }
  for (std::size_t i = 0; i < around_.size(); ++i) around_[i] += motion_[cell_of_[i]];
}

// ---- Rows ----

void Radio::sort_into_cells() {
  cell_start_.assign(columns_ * lines_ + 1, 0);
  for (const std::uint32_t cell : cell_of_) ++cell_start_[cell + 1];
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  for (std::size_t i = cell_of_.size(); i-- > 0;) sorted_[--cell_start_[cell_of_[i] + 1]] = static_cast<std::uint32_t>(i);
  // The loop has moved every start one cell up: cell c now begins at cell_start_[c + 1].
}

// All robots within reach of robot i that are still there, ascending.
void Radio::gather(std::size_t i, std::span<const Vec2> positions, Scratch& s) const {
  s.size = 0;
  if (dead_vanish_ && alive_[i] == 0) return;
  const double reach2 = reach_m_ * reach_m_;
  const Vec2 here = positions[i];
  std::size_t size = 0;
  const auto reserve = [&](std::size_t more) {
    if (s.index.size() < size + more + 1) s.index.resize(2 * (size + more) + chunk);
  };
  // Written unconditionally and kept by advancing: no branch to be mispredicted.
  const auto consider = [&](std::size_t j) {
    s.index[size] = static_cast<std::uint32_t>(j);
    size += static_cast<std::size_t>(squared_norm(positions[j] - here) < reach2) & static_cast<std::size_t>(j != i);
  };
  if (use_grid_) {
    const std::size_t line = cell_of_[i] / columns_;
    const std::size_t column = cell_of_[i] % columns_;
    const std::size_t first = column > 0 ? column - 1 : 0;
    const std::size_t last = std::min(column + 1, columns_ - 1);
    for (std::size_t l = line > 0 ? line - 1 : 0; l <= std::min(line + 1, lines_ - 1); ++l) {
      const std::size_t begin = cell_start_[l * columns_ + first + 1];
      const std::size_t end_cell = l * columns_ + last + 2;
      const std::size_t end = end_cell < cell_start_.size() ? cell_start_[end_cell] : positions.size();
      reserve(end - begin);
      for (std::size_t at = begin; at < end; ++at) consider(sorted_[at]);
    }
  } else {
    reserve(positions.size());
    for (std::size_t j = 0; j < positions.size(); ++j) consider(j);
  }
  const auto begin = s.index.begin();
  if (dead_vanish_)
    size = static_cast<std::size_t>(
        std::remove_if(begin, begin + static_cast<std::ptrdiff_t>(size), [&](std::uint32_t j) { return alive_[j] == 0; }) - begin);
  // The grid hands out neighbours cell by cell.
  if (use_grid_) std::sort(begin, begin + static_cast<std::ptrdiff_t>(size));
  s.size = size;
}

// Rewrites the row of robots within reach of robot i. What was known of pairs is kept, if its clock has not run
// too far: until then no robot missing from the row has mattered. Not for pairs out of range: while they were out
// of reach, too, their motion was not counted here. False: there is no room.
bool Radio::write_row(std::size_t i, std::span<const Vec2> positions, Scratch& s) {
  gather(i, positions, s);
  const auto begin = s.index.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(s.size);
  const auto first = std::upper_bound(begin, end, static_cast<std::uint32_t>(i));
  Row& row = rows_[i];
  const bool valid = row.known && clock(i) - row.written <= valid_;
  s.old.clear();
  if (valid) s.old.insert(s.old.end(), pairs_.of(i).begin(), pairs_.of(i).end());
  s.rebuild |= !valid;
  row.known = lower_.resize(i, static_cast<std::size_t>(first - begin)) && pairs_.resize(i, static_cast<std::size_t>(end - first));
  if (!row.known) {
    s.rebuild = s.no_room = true;
    return false;
  }
  row.written = clock(i);
  std::copy(begin, first, lower_.of(i).begin());  // NOLINT(readability-suspicious-call-argument)
  auto old = s.old.cbegin();
  auto other = first;
  const auto leave = [&](const Pair& pair) {
    Pair gone = pair;
    gone.linked = gone.near = 0;
    note(i, pair, gone, s);
  };
  for (Pair& pair : pairs_.of(i)) {
    for (; old != s.old.cend() && old->other < *other; ++old) leave(*old);
    pair = {*other & last_index, 0, 0, 0, 0, nobody_, mark(clock_of_three(i, *other, nobody_)), mark(clock_of_all(i, *other, false))};
    if (old != s.old.cend() && old->other == *other) {
      if ((old->linked | old->blocked | old->near) != 0) pair = *old;
      ++old;
    }
    ++other;
  }
  for (; old != s.old.cend(); ++old) leave(*old);
  return true;
}

// Allots the rows again, with room for those that had none.
void Radio::make_room(std::span<const Vec2> positions) {
  Scratch& s = scratch_[0];
  const auto count = [&](std::size_t i) {
    gather(i, positions, s);
    const auto begin = s.index.begin();
    const auto first = std::upper_bound(begin, begin + static_cast<std::ptrdiff_t>(s.size), static_cast<std::uint32_t>(i));
    return static_cast<std::size_t>(first - begin);
  };
  lower_.lay_out([&](std::size_t i) { return !rows_[i].known ? std::max(count(i), lower_.of(i).size()) : lower_.of(i).size(); });
  pairs_.lay_out([&](std::size_t i) {
    if (rows_[i].known) return pairs_.of(i).size();
    const std::size_t below = count(i);
    return std::max(s.size - below, pairs_.of(i).size());
  });
}

// ---- Pairs ----

// Looks at the pairs of robot i whose clock has run out.
void Radio::refresh(std::size_t i, std::span<const Vec2> positions, Scratch& s) {
  Row& row = rows_[i];
  if ((!row.known || clock(i) - row.written > skin_) && !write_row(i, positions, s)) return;
  Site site{i, positions[i], positions, lower_.of(i), pairs_.of(i), s};
  int least = static_cast<int>((row.written + skin_ - clock(i)) / units_per_step) + 1;
  const Way own = path_[i];
  const Way around = around_[i];
  const Way* const path = path_.data();
  const bool all_anew = all_anew_;
  for (Pair& pair : site.pairs) {
    const Way ends = own + path[pair.other];
    const auto wide = [&] { return steps_left(around + (pair.lively != 0 ? around : ends), pair.wide_until); };
    const auto close = [&] { return steps_left(ends + path[pair.witness], pair.close_until); };
    const int others = wide();
    int steps = std::min(others, close());
    if (steps <= 0 || all_anew) {
      if (all_anew || others <= 0 || !still_holds(site, pair)) decide(site, pair);
      steps = std::min(wide(), close());
    }
    least = std::min(least, steps);
  }
  row.quiet_until = fast_clock(i) + static_cast<Way>(std::max(0, least - 1)) * units_per_step;
}

// Records the new state of a pair. The list has room for the most that can occur.
void Radio::note(std::size_t i, const Pair& before, const Pair& now, Scratch& s) {
  const int link = static_cast<int>(now.linked) - static_cast<int>(before.linked);
  const int near = static_cast<int>(now.near) - static_cast<int>(before.near);
  if (link == 0 && near == 0) return;
  if (s.changes.size() < s.changes.capacity()) s.changes.push_back({{static_cast<std::uint32_t>(i), now.other}, link, near});
  else s.rebuild = true;  // so many that all rows are rebuilt
}

// How far two robots at this distance may move until it matters that they come nearer or part.
double Radio::distance_lasts(double length) const noexcept {
  return std::min({std::fabs(length - range_m_), std::fabs(length - near_m_), range_m_});
}

// Whether the two are in range and near as they were, and the body that blocks their line of sight still does, or the
// one nearest to it still leaves it free; if so, for how long. No other body has changed anything.
bool Radio::still_holds(const Site& site, Pair& pair) const noexcept {
  const Vec2 d = site.positions[pair.other] - site.here;
  const double d2 = squared_norm(d);
  const bool in_range = d2 < range_m_ * range_m_ && alive_[site.i] != 0 && alive_[pair.other] != 0;
  if (in_range != ((pair.linked | pair.blocked) != 0) || (d2 < near_m_ * near_m_) != (pair.near != 0)) return false;
  const double length = std::sqrt(d2);
  double lasts_m = distance_lasts(length);
  if (pair.witness != nobody_) {
    const Vec2 body = site.positions[pair.witness] - site.here;
    if (disc_blocks(body, d, d2, radius_m_) != (pair.blocked != 0)) return false;
    lasts_m = std::min(lasts_m, pair.blocked != 0 ? depth(body, d, length, radius_m_) : distance_beside(body, d, d2, radius_m_));
  }
  hold(site, pair, pair.witness, lasts_m);
  return true;
}

// Decides a pair, and for how long.
void Radio::decide(Site& site, Pair& pair) const {
  const Pair before = pair;
  const Vec2 d = site.positions[pair.other] - site.here;
  const double d2 = squared_norm(d);
  const double length = std::sqrt(d2);
  const bool in_range = d2 < range_m_ * range_m_ && alive_[site.i] != 0 && alive_[pair.other] != 0;
  pair.near = d2 < near_m_ * near_m_ ? 1 : 0;
  if (in_range && line_of_sight_) {
    leave_be(site, pair, judge_sight(site, pair, d, length));
  } else {
    pair.linked = in_range ? 1 : 0;
    pair.blocked = 0;
    hold(site, pair, nobody_, distance_lasts(length));
    leave_be(site, pair, reach_m_);
  }
  note(site.i, before, pair, site.s);
}

// Sets the witness of a pair: the verdict holds until the three have moved this far,
void Radio::hold(const Site& site, Pair& pair, std::uint32_t witness, double lasts_m) const noexcept {
  pair.witness = witness;
  pair.close_until = mark(clock_of_three(site.i, pair.other, witness) + way(lasts_m));
}

// and until all others have moved this far.
void Radio::leave_be(const Site& site, Pair& pair, double lasts_m) const noexcept {
  pair.lively = step_[site.i] + step_[pair.other] > motion_[cell_of_[site.i]] ? 1 : 0;
  pair.wide_until = mark(clock_of_all(site.i, pair.other, pair.lively != 0) + way(lasts_m));
}

// Whether there is a line of sight, of robots at this distance. Returns how far bodies other than the witness, and
// obstacles, are from changing that.
double Radio::judge_sight(Site& site, Pair& pair, Vec2 d, double length) const {
  const Vec2 there = site.positions[pair.other];
  const double d2 = squared_norm(d);
  const double in_range_m = distance_lasts(length);
  const auto hides = [&](const Obstacle* o) { return blocks(*o, site.here, there); };
  const auto hidden = [&] { return std::any_of(site.s.obstacles.begin(), site.s.obstacles.end(), hides); };
  const auto block = [&](std::uint32_t body) {
    hold(site, pair, body, std::min(in_range_m, depth(site.positions[body] - site.here, d, length, radius_m_)));
    return reach_m_;
  };
  const bool was_blocked = pair.blocked != 0;
  pair.blocked = 1;
  pair.linked = 0;
  // The body that blocked the pair before usually still does.
  if (was_blocked && pair.witness != nobody_ && !(dead_vanish_ && alive_[pair.witness] == 0) &&
      disc_blocks(site.positions[pair.witness] - site.here, d, d2, radius_m_))
    return block(pair.witness);
  look_around(site);
  const bool by_obstacle = was_blocked && pair.witness == nobody_;
  hold(site, pair, nobody_, in_range_m);
  if (by_obstacle && hidden()) return 0.0;
  const View view = look(site, pair, d, length);
  if (view.blocked) return block(view.witness);
  if (!by_obstacle && hidden()) return 0.0;
  pair.blocked = 0;
  pair.linked = 1;
  hold(site, pair, view.witness, std::min(in_range_m, static_cast<double>(view.nearest_m)));
  double lasts_m = static_cast<double>(view.others_m);
  for (const Obstacle* o : site.s.obstacles) lasts_m = std::min(lasts_m, gap(*o, site.here, there));
  return std::min(lasts_m, reach_m_);
}

// The robots and obstacles that could block a robot's lines of sight.
void Radio::look_around(Site& site) const {
  if (std::exchange(site.looked, true)) return;
  Scratch& s = site.s;
  const std::size_t size = site.lower.size() + site.pairs.size();
  if (s.x.size() < size + chunk)
    for (auto* v : {&s.x, &s.y}) v->resize(2 * size + chunk);
  float* x = s.x.data();
  float* y = s.y.data();
  const auto put = [&](std::uint32_t j) {
    const Vec2 d = site.positions[j] - site.here;
    *x++ = static_cast<float>(d.x);
    *y++ = static_cast<float>(d.y);
  };
  for (const std::uint32_t j : site.lower) put(j);
  for (const Pair& pair : site.pairs) put(pair.other);
  std::fill_n(x, chunk, far_away);
  std::fill_n(y, chunk, far_away);
  s.obstacles.clear();
  for (const Obstacle& obstacle : obstacles_)
    if (clearance(obstacle, site.here) < range_m_) s.obstacles.push_back(&obstacle);
}

// The body in the way from the robot to the other of the pair, or nearest to that line. Single precision leaves
// out bodies that are clearly beside the line; the exact test decides on the rest. The last bits of a distance are
// replaced by the place of its body, so that the least one tells whose it is.
Radio::View Radio::look(const Site& site, const Pair& pair, Vec2 d, double length_m) const noexcept {
  Scratch& s = site.s;
  const std::size_t lower = site.lower.size();
  const std::size_t size = lower + site.pairs.size();
  const auto target = lower + static_cast<std::size_t>(&pair - site.pairs.data());
  const auto body = [&](std::size_t at) { return at < lower ? site.lower[at] : site.pairs[at - lower].other; };
  const auto length = static_cast<float>(length_m);
  const bool has_direction = length > 1e-3F;                  // if not, all bodies are tested
  const Four ux = four(has_direction ? static_cast<float>(d.x) / length : 0.0F);
  const Four uy = four(has_direction ? static_cast<float>(d.y) / length : 0.0F);
  const Four end = four(length);
  const float rounding = 1e-4F * (length + 1.0F);             // far above it
  const float beside = static_cast<float>(radius_m_) + rounding;
  const float beside2 = has_direction ? beside * beside : none_near;
  const auto distance2 = [&](std::size_t at) {                // of four bodies, from the segment
    const Four x = load(s.x.data() + at);
    const Four y = load(s.y.data() + at);
    const Four across = x * uy - y * ux;
    const Four along = x * ux + y * uy;
    const Four out = along - smaller(larger(along, four(0.0F)), end);   // beyond the ends
    return across * across + out * out;
  };
  const auto place_bits = static_cast<std::int32_t>(std::bit_ceil(size + chunk) - 1);
  const FourWhole kept = four(~place_bits);
  const auto with_place = [&](Four gap2, FourWhole place) { return std::bit_cast<Four>((std::bit_cast<FourWhole>(gap2) & kept) | place); };
  const float aside = std::exchange(s.x[target], far_away);   // the other itself is not in the way
  TwoLeast even, odd;
  FourWhole place{0, 1, 2, 3};
  for (std::size_t begin = 0; begin < size; begin += chunk) {
    even.offer(with_place(distance2(begin), place));
    odd.offer(with_place(distance2(begin + 4), place + 4));
    place += static_cast<std::int32_t>(chunk);
  }
  s.x[target] = aside;
  even.offer(odd);
  const TwoLeast two = even.joined();
  const auto rounded_down = [&](float gap2) { return std::bit_cast<float>(std::bit_cast<std::int32_t>(gap2) & ~place_bits); };
  const float least = rounded_down(two.least[0]);
  const bool none = two.least[0] >= none_near;
  const auto nearest = none ? size : static_cast<std::size_t>(std::bit_cast<std::int32_t>(two.least[0]) & place_bits);
  View view{false, none ? nobody_ : body(nearest), 0.0F, 0.0F};
  const auto blocks = [&](std::size_t at) { return at != target && disc_blocks(site.positions[body(at)] - site.here, d, squared_norm(d), radius_m_); };
  if (least < beside2) {
    // The body nearest to the line is deepest in the way, and will stay there longest.
    view.blocked = !none && blocks(nearest);
    for (std::size_t begin = 0; begin < size && !view.blocked; begin += 4) {
      const Four gaps = distance2(begin);
      for (std::size_t at = begin; at < std::min(begin + 4, size) && !view.blocked; ++at) {
        if (gaps[at - begin] >= beside2 || !blocks(at)) continue;
        view.blocked = true;
        view.witness = body(at);
      }
    }
  }
  if (!has_direction || view.blocked) return view;
  view.nearest_m = std::max(0.0F, std::sqrt(least) - beside);
  view.others_m = std::max(0.0F, std::sqrt(rounded_down(two.second[0])) - beside);
  return view;
}

// ---- Leaky sight ----

// Decides for all pairs of robot i without a line of sight whether they look over what is in the way. That depends on
// headings, which no clock follows, and on all bodies in the way, not on one: it is found anew in every update.
void Radio::look_over(std::size_t i, std::span<const Vec2> positions, Scratch& s) {
  if (!rows_[i].known) return;
  Site site{i, positions[i], positions, lower_.of(i), pairs_.of(i), s};
  for (Pair& pair : site.pairs) {
    if (pair.blocked == 0) continue;
    const Pair before = pair;
    pair.linked = looks_over(site, pair) ? 1 : 0;
    note(i, before, pair, s);
  }
}

bool Radio::looks_over(Site& site, const Pair& pair) const {
  const bool here = raised_[site.i] != 0;
  const bool there = raised_[pair.other] != 0;
  if (pair.witness == nobody_ || !(here || there)) return false;   // without a witness an obstacle is in the way
  const Vec2 d = site.positions[pair.other] - site.here;
  const double d2 = squared_norm(d);
  const auto stops = [&](std::uint32_t body) {
    const Vec2 k = site.positions[body] - site.here;
    return !(2.0 * dot(k, d) < d2 ? here : there) && disc_blocks(k, d, d2, radius_m_);
  };
  if (stops(pair.witness)) return false;
  if (std::any_of(site.lower.begin(), site.lower.end(), stops)) return false;
  const auto stops_other = [&](const Pair& p) { return p.other != pair.other && stops(p.other); };
  if (std::any_of(site.pairs.begin(), site.pairs.end(), stops_other)) return false;
  look_around(site);
  return std::none_of(site.s.obstacles.begin(), site.s.obstacles.end(),
                      [&](const Obstacle* o) { return blocks(*o, site.here, site.positions[pair.other]); });
}

// ---- The result ----

// Brings links and near pairs up to date, one change at a time unless they are many.
void Radio::apply_changes() {
  std::size_t changes = 0;
  bool rebuild = false;
  for (const Scratch& s : scratch_) {
    changes += s.changes.size();
    rebuild |= s.rebuild;
  }
  if (rebuild || changes > rows_.size()) return merge();
  for (const Scratch& s : scratch_)
    for (const Change& change : s.changes) {
      const auto [i, j] = change.couple;
      if (change.near != 0) {
        const auto at = std::lower_bound(near_.begin(), near_.end(), change.couple);
        if (change.near > 0) near_.insert(at, change.couple);
        else near_.erase(at);
      }
      if (change.link < 0) {
        links_.erase(i, j);
        links_.erase(j, i);
      } else if (change.link > 0 && !(links_.insert(i, j) && links_.insert(j, i))) {
        return merge();
      }
    }
}

// Writes the pairs of all robots, in order, into rows that are ascending for both ends.
void Radio::merge() {
  const std::size_t robots = rows_.size();
  near_.clear();
  count_.assign(robots, 0);
  for (std::size_t i = 0; i < robots; ++i)
    for (const Pair& pair : pairs_.of(i)) {
      count_[i] += pair.linked;
      count_[pair.other] += pair.linked;
      if (pair.near != 0) near_.emplace_back(static_cast<std::uint32_t>(i), pair.other);
    }
  for (std::size_t i = 0; i < robots; ++i) links_.clear(i);
  links_.lay_out([&](std::size_t i) { return std::size_t{count_[i]}; });
  for (std::size_t i = 0; i < robots; ++i)
    for (const Pair& pair : pairs_.of(i)) {
      if (pair.linked == 0) continue;
      links_.append(i, pair.other);
      links_.append(pair.other, static_cast<std::uint32_t>(i));
    }
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> Radio::blocked() const {
  std::vector<Couple> couples;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (const Pair& pair : pairs_.of(i))
      if (pair.blocked != 0 && pair.linked == 0) couples.emplace_back(static_cast<std::uint32_t>(i), pair.other);
  return couples;
}

std::size_t Radio::memory_bytes() const noexcept {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };  // NOLINT(bugprone-sizeof-expression)
  std::size_t total = bytes(last_) + bytes(alive_) + bytes(raised_) + lower_.memory_bytes() + pairs_.memory_bytes() + bytes(path_) + bytes(step_) + bytes(around_) + bytes(rows_) +
                      bytes(cell_of_) + bytes(cell_start_) + bytes(sorted_) + bytes(motion_) + bytes(across_) + links_.memory_bytes() +
                      bytes(count_) + bytes(near_);
  for (const Scratch& s : scratch_) total += bytes(s.index) + bytes(s.old) + bytes(s.x) + bytes(s.y) + bytes(s.changes) + bytes(s.obstacles);
  return total;
}

}  // namespace banyan::world
