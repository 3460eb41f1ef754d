// SPDX-License-Identifier: MIT
// A verdict on a pair names one body, its witness: the one in the way or, if none is, the one nearest to the line of
// sight. A robot that moves tests all its pairs against their witnesses, four at a time in single precision; the exact
// test decides where that leaves a doubt. One that stands still tests those whose other or witness has moved.
//
// For all other bodies a verdict comes with a margin: how far robots may move before one of them could change it.
// Clocks add up the largest distance that any robot around the first has moved in each tick, and that of the line of
// sight; when the clock has passed the margin, the pair is decided anew. Margins are rounded down and clocks up, so
// that a verdict is always the one that the exact test would give at this moment. A point of the line moves no farther
// than the end that moves more: so that is at most the largest once more, and at most the distances of both ends
// together. Which of the two clocks will be the slower one is guessed from the last tick: the first where most robots
// move, the second where most stand.
#include "radio_fast.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "banyan/world/obstacles.hpp"

namespace banyan::world {
namespace {

constexpr std::size_t few_cells = 15;  // so few, and scanning all robots beats the grid
constexpr float far_away = 1e18F;      // its square is finite
constexpr float none_near = 1e30F;     // less than that
constexpr double skin_share = 0.1;     // of the range
// Of the body's radius: how far apart two robots may be that bodies pushed by others could still bring together.
constexpr double push_share = 1.0 / 7.0;
// Of the range: bounds on rounding, far above what single precision rounds within a row. They cost time, not accuracy.
constexpr float place_share = 0x1p-21F;  // of a place, beside what the extent of the swarm takes
constexpr float line_share = 1e-4F;      // of a distance from a line
constexpr float short_share = 0x1p-11F;  // a line as short as this has no direction

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
void store(Four v, float* to) noexcept { std::memcpy(to, &v, sizeof v); }
Four magnitude(Four v) noexcept {
  return std::bit_cast<Four>(std::bit_cast<FourWhole>(v) & four(std::numeric_limits<std::int32_t>::max()));
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

Radio::Fast::Fast(const Scenario& scenario, std::size_t robots)
    : range_m_(scenario.radio.range_m),
      radius_m_(scenario.robot.radius_m),
      near_m_(2.0 * scenario.robot.radius_m + 4.0 * scenario.robot.wheel_limit_m_s * scenario.tick_s +
              push_share * scenario.robot.radius_m),
      line_of_sight_(scenario.radio.line_of_sight),
      leaky_(scenario.radio.sight_leak > 0.0),
      dead_vanish_(!scenario.robot.dead_bodies),
      obstacles_(scenario.obstacles),
      raised_(leaky_ ? robots : 0, 0),
      nobody_(static_cast<std::uint32_t>(robots)),
      path_(robots, 0),
      step_(robots + 1, 0),
      around_(robots, 0),
      places_(robots + 1, Place{far_away, far_away}),
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
  limits_.range_m2 = static_cast<float>(range_m_ * range_m_);
  limits_.near_m2 = static_cast<float>(near_m_ * near_m_);
  limits_.radius_m2 = static_cast<float>(radius_m_ * radius_m_);
}

void Radio::Fast::update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive,
                         std::span<const std::uint8_t> raised, Executor& executor) {
  const bool raised_anew = raise(raised);
  if (!follow(positions, alive) && !raised_anew) return;
  scratch_.resize(std::max(scratch_.size(), static_cast<std::size_t>(executor.threads())));
  const auto refresh_all = [&] {
    executor.parallel_for(positions.size(), [&](std::size_t begin, std::size_t end, int worker) {
      Scratch& s = scratch_[static_cast<std::size_t>(worker)];
      for (std::size_t i = begin; i < end; ++i) {
        if (all_anew_ || !rows_[i].known || rows_[i].seen != fast_clock(i)) refresh(i, positions, s);
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
  all_anew_ = false;
  apply_changes();
}

void Radio::Fast::occlude(bool on, std::span<const Obstacle> obstacles) {
  line_of_sight_ = on;
  obstacles_.assign(obstacles.begin(), obstacles.end());
  all_anew_ = true;
}

// True if some antenna is raised or lowered.
bool Radio::Fast::raise(std::span<const std::uint8_t> raised) {
  if (!leaky_ || std::equal(raised.begin(), raised.end(), raised_.begin(), raised_.end())) return false;
  raised_.assign(raised.begin(), raised.end());
  return true;
}

void Radio::Fast::forget(std::uint32_t i) {
  std::erase_if(near_, [i](const Couple& couple) { return couple.first == i || couple.second == i; });
}

// ---- How far all robots have moved ----

// Brings the clocks up to date. False if nothing has happened since the last update.
bool Radio::Fast::follow(std::span<const Vec2> positions, std::span<const std::uint8_t> alive) {
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

// Positions in single precision, relative to the middle of the swarm, and how much that rounds.
void Radio::Fast::note_places(std::span<const Vec2> positions, Vec2 low, Vec2 high) {
  const Vec2 middle = (low + high) * 0.5;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec2 p = positions[i] - middle;
    places_[i] = {static_cast<float>(p.x), static_cast<float>(p.y)};
  }
  // The difference of two places: each is rounded by half of the last of 24 bits, and so is the difference.
  rounding_m_ =
      place_share * static_cast<float>(range_m_) +
      static_cast<float>(2.0 * std::numeric_limits<float>::epsilon() * std::max(high.x - low.x, high.y - low.y));
  limits_.area_m2 = 8.0F * static_cast<float>(reach_m_) * rounding_m_;
  limits_.edge_m4 = 4.0F * limits_.area_m2 * (static_cast<float>(radius_m_ * reach_m_) + limits_.area_m2);
}

// Cells are as wide as a row reaches, so that every robot within reach is in the same cell or one beside it.
// The number of cells stays below 4 N, so that a wide, thin swarm costs no more memory than a dense one:
// the cells grow instead.
void Radio::Fast::lay_grid(std::span<const Vec2> positions) {
  Vec2 low = positions[0];
  Vec2 high = positions[0];
  for (const Vec2 p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  note_places(positions, low, high);
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
void Radio::Fast::spread_motion() {
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

void Radio::Fast::sort_into_cells() {
  cell_start_.assign(columns_ * lines_ + 1, 0);
  for (const std::uint32_t cell : cell_of_) ++cell_start_[cell + 1];
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  for (std::size_t i = cell_of_.size(); i-- > 0;)
    sorted_[--cell_start_[cell_of_[i] + 1]] = static_cast<std::uint32_t>(i);
  // The loop has moved every start one cell up: cell c now begins at cell_start_[c + 1].
}

// All robots within reach of robot i that are still there, ascending.
void Radio::Fast::gather(std::size_t i, std::span<const Vec2> positions, Scratch& s) const {
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
    size = static_cast<std::size_t>(std::remove_if(begin, begin + static_cast<std::ptrdiff_t>(size),
                                                   [&](std::uint32_t j) { return alive_[j] == 0; }) -
                                    begin);
  // The grid hands out neighbours cell by cell.
  if (use_grid_) std::sort(begin, begin + static_cast<std::ptrdiff_t>(size));
  s.size = size;
}

// Rewrites the row of robots within reach of robot i. What was known of pairs is kept, if its clock has not run
// too far: until then no robot missing from the row has mattered. Not for pairs out of range: while they were out
// of reach, too, their motion was not counted here. False: there is no room.
bool Radio::Fast::write_row(std::size_t i, std::span<const Vec2> positions, Scratch& s) {
  gather(i, positions, s);
  const auto begin = s.index.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(s.size);
  const auto first = std::upper_bound(begin, end, static_cast<std::uint32_t>(i));
  Row& row = rows_[i];
  const bool valid = row.known && clock(i) - row.written <= valid_;
  s.old.clear();
  if (valid) s.old.insert(s.old.end(), pairs_.of(i).begin(), pairs_.of(i).end());
  s.rebuild |= !valid;
  row.known = lower_.resize(i, static_cast<std::size_t>(first - begin)) &&
              pairs_.resize(i, static_cast<std::size_t>(end - first));
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
    pair = {*other & last_index, 0, 0, 0, 0, nobody_, 0};
    pair.until = clock_of_all(i, pair);
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
void Radio::Fast::make_room(std::span<const Vec2> positions) {
  Scratch& s = scratch_[0];
  const auto count = [&](std::size_t i) {
    gather(i, positions, s);
    const auto begin = s.index.begin();
    const auto first =
        std::upper_bound(begin, begin + static_cast<std::ptrdiff_t>(s.size), static_cast<std::uint32_t>(i));
    return static_cast<std::size_t>(first - begin);
  };
  lower_.lay_out(
      [&](std::size_t i) { return !rows_[i].known ? std::max(count(i), lower_.of(i).size()) : lower_.of(i).size(); });
  pairs_.lay_out([&](std::size_t i) {
    if (rows_[i].known) return pairs_.of(i).size();
    const std::size_t below = count(i);
    return std::max(s.size - below, pairs_.of(i).size());
  });
}

// ---- Pairs ----

// Of four pairs, from `begin` on: not 0 where the clock has run out, or where the distance or the witness may have
// changed the verdict. Beyond the last pair it means nothing. Inlined, since the limits are the same for a whole row.
[[gnu::always_inline]] inline Radio::Fast::FourWhole Radio::Fast::doubtful(const Site& site,
                                                                           std::size_t begin) const noexcept {
  const auto each = [&](auto of) {
    const Pair* const pair = site.pairs.data() + begin;
    using One = decltype(of(*pair));
    return std::conditional_t<std::is_same_v<One, float>, Four, FourWhole>{of(pair[0]), of(pair[1]), of(pair[2]),
                                                                           of(pair[3])};
  };
  const auto whole = [](std::uint32_t v) { return static_cast<std::int32_t>(v); };
  const FourWhole words = each([](const Pair& pair) { return word_of(pair); });
  const auto has = [&](const Pair& flag) { return (words & four(word_of(flag))) == four(word_of(flag)); };
  const FourWhole witness = each([&](const Pair& pair) { return whole(pair.witness); });
  const FourWhole ends = each([&](const Pair& pair) { return whole(path_[pair.other]); }) + four(whole(path_[site.i]));
  const FourWhole around = four(whole(around_[site.i]));
  const FourWhole now = around + (has({.lively = 1}) ? around : ends);
  const FourWhole left = each([&](const Pair& pair) { return whole(pair.until); }) - now;
  const Four kx = each([&](const Pair& pair) { return places_[pair.witness].x; }) - four(places_[site.i].x);
  const Four ky = each([&](const Pair& pair) { return places_[pair.witness].y; }) - four(places_[site.i].y);
  const Four dx = load(site.s.x.data() + site.lower.size() + begin);
  const Four dy = load(site.s.y.data() + site.lower.size() + begin);
  const Four d2 = dx * dx + dy * dy;
  const Four beyond_range = d2 - four(limits_.range_m2);
  const Four beyond_near = d2 - four(limits_.near_m2);
  const Four along = kx * dx + ky * dy;
  const Four across = kx * dy - ky * dx;
  const Four beside = across * across - four(limits_.radius_m2) * d2;
  const Four none = four(0.0F);
  const Four area = four(limits_.area_m2);
  const Four edge = four(limits_.edge_m4);
  const FourWhole is_blocked = has({.blocked = 1});
  const FourWhole blocks = (beside < none) & (along > none) & (along < d2);
  const FourWhole by_body = is_blocked & (witness < four(whole(nobody_)));
  const FourWhole changed = ((beyond_range < none) ^ (is_blocked | has({.linked = 1}))) |
                            ((beyond_near < none) ^ has({.near = 1})) | (blocks ^ by_body);
  const FourWhole unclear =
      (magnitude(beyond_range) < area) | (magnitude(beyond_near) < area) |
      ((beside < edge) & ((magnitude(beside) < edge) | (magnitude(along) < area) | (magnitude(along - d2) < area)));
  return changed | unclear | (left <= four(0));
}

// Looks at the pairs of robot i of which something may have changed.
void Radio::Fast::refresh(std::size_t i, std::span<const Vec2> positions, Scratch& s) {
  Row& row = rows_[i];
  if ((!row.known || clock(i) - row.written > skin_) && !write_row(i, positions, s)) return;
  row.seen = fast_clock(i);
  Site site{i, positions[i], positions, lower_.of(i), pairs_.of(i), s};
  if (all_anew_) {
    for (Pair& pair : site.pairs) decide(site, pair);
  } else if (step_[i] == 0) {
    look_at_moving(site);
  } else {
    look_at_all(site);
  }
}

// The robot has stood still, and so have most others.
void Radio::Fast::look_at_moving(Site& site) const {
  for (Pair& pair : site.pairs) {
    const bool runs_out = way_left(site.i, pair) <= 0;
    if ((step_[pair.other] | step_[pair.witness]) == 0 && !runs_out) continue;
    if (runs_out || !still_holds(site, pair)) decide(site, pair);
  }
}

void Radio::Fast::look_at_all(Site& site) const {
  look_around(site);
  for (std::size_t begin = 0; begin < site.pairs.size(); begin += lanes) {
    const FourWhole doubts = doubtful(site, begin);
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(doubts);
    if ((halves[0] | halves[1]) == 0) continue;
    for (std::size_t k = 0; k < std::min(lanes, site.pairs.size() - begin); ++k) {
      Pair& pair = site.pairs[begin + k];
      if (doubts[k] != 0 && (way_left(site.i, pair) <= 0 || !still_holds(site, pair))) decide(site, pair);
    }
  }
}

// Records the new state of a pair. The list has room for the most that can occur.
void Radio::Fast::note(std::size_t i, const Pair& before, const Pair& now, Scratch& s) {
  const int link = static_cast<int>(now.linked) - static_cast<int>(before.linked);
  const int near = static_cast<int>(now.near) - static_cast<int>(before.near);
  if (link == 0 && near == 0) return;
  if (s.changes.size() < s.changes.capacity())
    s.changes.push_back({{static_cast<std::uint32_t>(i), now.other}, link, near});
  else s.rebuild = true;  // so many that all rows are rebuilt
}

// Whether the two are in range and near as they were, and the body that blocks their line of sight still does, or the
// one nearest to it still leaves it free.
bool Radio::Fast::still_holds(const Site& site, const Pair& pair) const noexcept {
  const Vec2 d = site.positions[pair.other] - site.here;
  const double d2 = squared_norm(d);
  const bool in_range = d2 < range_m_ * range_m_ && alive_[site.i] != 0 && alive_[pair.other] != 0;
  if (in_range != ((pair.linked | pair.blocked) != 0) || (d2 < near_m_ * near_m_) != (pair.near != 0)) return false;
  return pair.witness == nobody_ ||
         disc_blocks(site.positions[pair.witness] - site.here, d, d2, radius_m_) == (pair.blocked != 0);
}

// Decides a pair, and for how long.
void Radio::Fast::decide(Site& site, Pair& pair) const {
  const Pair before = pair;
  const Vec2 d = site.positions[pair.other] - site.here;
  const double d2 = squared_norm(d);
  const bool in_range = d2 < range_m_ * range_m_ && alive_[site.i] != 0 && alive_[pair.other] != 0;
  pair.near = d2 < near_m_ * near_m_ ? 1 : 0;
  double lasts_m = reach_m_;
  if (in_range && line_of_sight_) {
    lasts_m = judge_sight(site, pair, d, d2);
  } else {
    pair.linked = in_range ? 1 : 0;
    pair.blocked = 0;
    pair.witness = nobody_;
  }
  pair.lively = step_[site.i] + step_[pair.other] > motion_[cell_of_[site.i]] ? 1 : 0;
  pair.until = clock_of_all(site.i, pair) + way(lasts_m);
  note(site.i, before, pair, site.s);
}

// Whether there is a line of sight, of robots so far apart. Returns how far bodies other than the witness, and
// obstacles, are from changing that.
double Radio::Fast::judge_sight(Site& site, Pair& pair, Vec2 d, double d2) const {
  const Vec2 there = site.positions[pair.other];
  const auto hides = [&](const Obstacle* o) { return blocks(*o, site.here, there); };
  const auto hidden = [&] { return std::any_of(site.s.obstacles.begin(), site.s.obstacles.end(), hides); };
  const bool was_blocked = pair.blocked != 0;
  pair.blocked = 1;
  pair.linked = 0;
  // The body that blocked the pair before usually still does.
  if (was_blocked && pair.witness != nobody_ && !(dead_vanish_ && alive_[pair.witness] == 0) &&
      disc_blocks(site.positions[pair.witness] - site.here, d, d2, radius_m_))
    return reach_m_;
  look_around(site);
  const bool by_obstacle = was_blocked && pair.witness == nobody_;
  pair.witness = nobody_;
  if (by_obstacle && hidden()) return 0.0;
  const View view = look(site, pair, d, std::sqrt(d2));
  if (!view.blocked && !by_obstacle && hidden()) return 0.0;
  pair.witness = view.witness;
  if (view.blocked) return reach_m_;
  pair.blocked = 0;
  pair.linked = 1;
  double lasts_m = static_cast<double>(view.others_m);
  // Obstacles stand: the clock adds up at least twice as much as a line of sight approaches them.
  for (const Obstacle* o : site.s.obstacles) lasts_m = std::min(lasts_m, 2.0 * gap(*o, site.here, there));
  if (site.s.obstacles.size() < obstacles_.size()) lasts_m = std::min(lasts_m, 2.0 * beyond_range_m());
  return std::min(lasts_m, reach_m_);
}

// The robots and obstacles that could block a robot's lines of sight.
void Radio::Fast::look_around(Site& site) const {
  if (std::exchange(site.looked, true)) return;
  Scratch& s = site.s;
  const std::size_t size = site.lower.size() + site.pairs.size();
  if (s.x.size() < size + chunk)
    for (auto* v : {&s.x, &s.y}) v->resize(2 * size + chunk);
  float* x = s.x.data();
  float* y = s.y.data();
  const Place here = places_[site.i];
  const auto put = [&](std::size_t count, auto other) {
    std::size_t k = 0;
    for (; k + lanes <= count; k += lanes, x += lanes, y += lanes) {
      const std::array<Place, lanes> at{places_[other(k)], places_[other(k + 1)], places_[other(k + 2)],
                                        places_[other(k + 3)]};
      store(Four{at[0].x, at[1].x, at[2].x, at[3].x} - four(here.x), x);
      store(Four{at[0].y, at[1].y, at[2].y, at[3].y} - four(here.y), y);
    }
    for (; k < count; ++k) {
      *x++ = places_[other(k)].x - here.x;
      *y++ = places_[other(k)].y - here.y;
    }
  };
  put(site.lower.size(), [&](std::size_t k) { return site.lower[k]; });
  put(site.pairs.size(), [&](std::size_t k) { return site.pairs[k].other; });
  std::fill_n(x, chunk, far_away);
  std::fill_n(y, chunk, far_away);
  s.obstacles.clear();
  for (const Obstacle& obstacle : obstacles_)
    if (may_be_nearer(obstacle, site.here, range_m_ + beyond_range_m())) s.obstacles.push_back(&obstacle);
}

// The body in the way from the robot to the other of the pair, or nearest to that line. Single precision leaves
// out bodies that are clearly beside the line; the exact test decides on the rest. The last bits of a distance are
// replaced by the place of its body, so that the least one tells whose it is.
Radio::Fast::View Radio::Fast::look(const Site& site, const Pair& pair, Vec2 d, double length_m) const noexcept {
  Scratch& s = site.s;
  const std::size_t lower = site.lower.size();
  const std::size_t size = lower + site.pairs.size();
  const auto target = lower + static_cast<std::size_t>(&pair - site.pairs.data());
  const auto body = [&](std::size_t at) { return at < lower ? site.lower[at] : site.pairs[at - lower].other; };
  const auto length = static_cast<float>(length_m);
  const auto range = static_cast<float>(range_m_);
  const bool has_direction = length > short_share * range;  // if not, all bodies are tested
  const Four ux = four(has_direction ? static_cast<float>(d.x) / length : 0.0F);
  const Four uy = four(has_direction ? static_cast<float>(d.y) / length : 0.0F);
  const Four end = four(length);
  const float rounding = line_share * (length + 0.5F * range) + 4.0F * rounding_m_;
  const float beside = static_cast<float>(radius_m_) + rounding;
  const float beside2 = has_direction ? beside * beside : none_near;
  const auto distance2 = [&](std::size_t at) {  // of four bodies, from the segment
    const Four x = load(s.x.data() + at);
    const Four y = load(s.y.data() + at);
    const Four across = x * uy - y * ux;
    const Four along = x * ux + y * uy;
    const Four out = along - smaller(larger(along, four(0.0F)), end);  // beyond the ends
    return across * across + out * out;
  };
  const auto place_bits = static_cast<std::int32_t>(std::bit_ceil(size + chunk) - 1);
  const FourWhole kept = four(~place_bits);
  const auto with_place = [&](Four gap2, FourWhole place) {
    return std::bit_cast<Four>((std::bit_cast<FourWhole>(gap2) & kept) | place);
  };
  const float aside = std::exchange(s.x[target], far_away);  // the other itself is not in the way
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
  const auto rounded_down = [&](float gap2) {
    return std::bit_cast<float>(std::bit_cast<std::int32_t>(gap2) & ~place_bits);
  };
  const float least = rounded_down(two.least[0]);
  const bool none = two.least[0] >= none_near;
  const auto nearest = none ? size : static_cast<std::size_t>(std::bit_cast<std::int32_t>(two.least[0]) & place_bits);
  View view{false, none ? nobody_ : body(nearest), 0.0F};
  const auto blocks = [&](std::size_t at) {
    return at != target && disc_blocks(site.positions[body(at)] - site.here, d, squared_norm(d), radius_m_);
  };
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
  view.others_m = std::max(0.0F, std::sqrt(rounded_down(two.second[0])) - beside);
  return view;
}

// ---- Leaky sight ----

// Decides for all pairs of robot i without a line of sight whether they look over what is in the way. That depends on
// headings, which no clock follows, and on all bodies in the way, not on one: it is found anew in every update.
void Radio::Fast::look_over(std::size_t i, std::span<const Vec2> positions, Scratch& s) {
  if (!rows_[i].known) return;
  Site site{i, positions[i], positions, lower_.of(i), pairs_.of(i), s};
  look_around(site);
  for (Pair& pair : site.pairs) {
    if (pair.blocked == 0) continue;
    const Pair before = pair;
    pair.linked = looks_over(site, pair) ? 1 : 0;
    note(i, before, pair, s);
  }
}

bool Radio::Fast::looks_over(const Site& site, const Pair& pair) const {
  const bool here = raised_[site.i] != 0;
  const bool there = raised_[pair.other] != 0;
  if (pair.witness == nobody_ || !(here || there)) return false;  // without a witness an obstacle is in the way
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
  return std::none_of(site.s.obstacles.begin(), site.s.obstacles.end(),
                      [&](const Obstacle* o) { return blocks(*o, site.here, site.positions[pair.other]); });
}

// ---- The result ----

// Brings links and near pairs up to date, one change at a time unless they are many.
void Radio::Fast::apply_changes() {
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
void Radio::Fast::merge() {
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

std::vector<std::pair<std::uint32_t, std::uint32_t>> Radio::Fast::blocked() const {
  std::vector<Couple> couples;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (const Pair& pair : pairs_.of(i))
      if (pair.blocked != 0 && pair.linked == 0) couples.emplace_back(static_cast<std::uint32_t>(i), pair.other);
  return couples;
}

std::size_t Radio::Fast::memory_bytes() const noexcept {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };  // NOLINT(bugprone-sizeof-expression)
  std::size_t total = bytes(last_) + bytes(alive_) + bytes(raised_) + lower_.memory_bytes() + pairs_.memory_bytes() +
                      bytes(path_) + bytes(step_) + bytes(around_) + bytes(rows_) + bytes(cell_of_) +
                      bytes(cell_start_) + bytes(sorted_) + bytes(motion_) + bytes(across_) + links_.memory_bytes() +
                      bytes(count_) + bytes(near_);
  for (const Scratch& s : scratch_)
    total += bytes(s.index) + bytes(s.old) + bytes(s.x) + bytes(s.y) + bytes(s.changes) + bytes(s.obstacles);
  return total;
}

}  // namespace banyan::world
