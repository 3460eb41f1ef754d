// SPDX-License-Identifier: MIT
// What is wrong with a map, and with what stands where no robot can.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/placement.hpp"
#include "fault_list.hpp"

namespace banyan::world {
namespace {

// Where the middle of a robot can be: runs of cells side by side in a row, and which of them hang together, corners
// included. What is around the map belongs to it, too. In doubt a robot fits: a cell counts if it may at
// some point of it.
class Roads {
 public:
  struct Room {
    std::size_t cells = 0;
    Vec2 place{};  // a point of it
  };

  Roads(const FloorMap& map, double radius_m)
      : frame_(map),
        cells_(*map.cells),
        cell_m_(map.cell_m),
        radius_(radius_m / map.cell_m),
        margin_(static_cast<std::int64_t>(radius_) + 2) {
    const auto columns = static_cast<std::int64_t>(cells_.columns()), rows = static_cast<std::int64_t>(cells_.rows());
    std::size_t below = 0;  // the first run of the row below
    for (std::int64_t row = -margin_; row < rows + margin_; ++row) {
      const std::size_t here = runs_.size();
      for (std::int64_t column = -margin_; column < columns + margin_; ++column) {
        if (!fits(column, row)) continue;
        const std::int64_t first = column;
        while (column + 1 < columns + margin_ && fits(column + 1, row)) ++column;
        runs_.push_back({row, first, column, runs_.size()});
      }
      for (std::size_t k = here, old = below; k < runs_.size(); ++k) {
        while (old < here && runs_[old].last + 1 < runs_[k].first) ++old;
        for (std::size_t beside = old; beside < here && runs_[beside].first <= runs_[k].last + 1; ++beside)
          runs_[leader(beside)].leader = leader(k);
      }
      rows_.push_back(here);
      below = here;
    }
    rows_.push_back(runs_.size());
    reached_.resize(runs_.size(), 0);
  }

  // From here on robots drive, and reach the whole room.
  void begin_at(Vec2 p) {
    if (const auto run = run_at(p)) reached_[leader(*run)] = 1;
  }

  // The rooms in which nobody has begun; all around the map is none.
  [[nodiscard]] std::vector<Room> closed_rooms() {
    std::vector<Room> rooms(runs_.size());
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      Room& room = rooms[leader(k)];
      if (room.cells == 0)
        room.place =
            frame_.in_metres(middle_of(runs_[k], 0.5 * static_cast<double>(runs_[k].first + runs_[k].last + 1)));
      room.cells += static_cast<std::size_t>(runs_[k].last + 1 - runs_[k].first);
    }
    const std::size_t outside = runs_.empty() ? 0 : leader(0);
    std::vector<Room> closed;
    for (std::size_t k = 0; k < rooms.size(); ++k)
      if (rooms[k].cells > 0 && reached_[k] == 0 && k != outside) closed.push_back(rooms[k]);
    return closed;
  }

  // The point that robots reach nearest to p; nothing if they reach none.
  [[nodiscard]] std::optional<Vec2> nearest_reached(Vec2 p) {
    if (const auto run = run_at(p); run && reached_[leader(*run)] != 0) return p;
    const Vec2 at = frame_.in_cells(p);
    std::optional<Vec2> best;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (reached_[leader(k)] == 0) continue;
      const Vec2 q = middle_of(runs_[k], at.x);
      if (!best || squared_norm(q - at) < squared_norm(*best - at)) best = q;
    }
    if (best) best = frame_.in_metres(*best);
    return best;
  }
  // Whether they come so near to it.
  [[nodiscard]] bool lead_to(Vec2 p, double within_m) {
    const std::optional<Vec2> nearest = nearest_reached(p);
    return nearest && distance(*nearest, p) <= within_m + cell_m_;
  }

 private:
  struct Run {
    std::int64_t row, first, last;  // columns
    std::size_t leader;             // another one of the same room, or itself
  };

  [[nodiscard]] std::size_t leader(std::size_t k) noexcept {
    while (runs_[k].leader != k) k = runs_[k].leader = runs_[runs_[k].leader].leader;
    return k;
  }
  [[nodiscard]] bool fits(std::int64_t column, std::int64_t row) const {
    constexpr double half_diagonal = 0.7072;
    const std::int64_t reach = cells_.reach(column, row);
    if (reach == 0 || static_cast<double>(reach - 1) >= radius_) return reach != 0;
    const Vec2 middle{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
    return cells_.clearance(middle) + half_diagonal >= radius_;
  }
  // A point in the middle of the run's row, at x if it reaches so far; in cells.
  [[nodiscard]] static Vec2 middle_of(const Run& run, double x) noexcept {
    return {std::clamp(x, static_cast<double>(run.first) + 0.5, static_cast<double>(run.last) + 0.5),
            static_cast<double>(run.row) + 0.5};
  }
  [[nodiscard]] std::optional<std::size_t> run_at(Vec2 p) const {
    const auto within = [this](double x, std::size_t size) {
      return std::clamp(static_cast<std::int64_t>(std::floor(x)), -margin_,
                        static_cast<std::int64_t>(size) + margin_ - 1);
    };
    const Vec2 at = frame_.in_cells(p);
    const std::int64_t column = within(at.x, cells_.columns());
    const auto row = static_cast<std::size_t>(within(at.y, cells_.rows()) + margin_);
    for (std::size_t k = rows_[row]; k < rows_[row + 1]; ++k)
      if (runs_[k].first <= column && column <= runs_[k].last) return k;
    return std::nullopt;
  }

  CellFrame frame_;
  const CellGrid& cells_;
  double cell_m_, radius_;
  std::int64_t margin_;                // of cells around the map, in which a robot fits
  std::vector<Run> runs_;              // row by row, from the left
  std::vector<std::size_t> rows_;      // their first runs, and the end
  std::vector<std::uint8_t> reached_;  // by leader
};

}  // namespace

std::string free_place_text(FaultList& list, std::span<const Obstacle> obstacles, Vec2 p, double room_m) {
  constexpr int most_rings = 300;
  if (!list.may_search()) return {};
  const double step_m = 0.5 * room_m;
  for (int ring = 1; ring <= most_rings; ++ring)
    for (int k = 0; k < 8 * ring; ++k) {
      const Vec2 q = p + ring * step_m * unit_vector(2.0 * pi<double> * k / (8 * ring));
      if (clearance(obstacles, q) >= room_m) return "; the nearest free place is " + at(q);
    }
  return {};
}

void check_map(FaultList& list, const std::string& key, const FloorMap& map) {
  if (!map.cells) return list.fail(key + ".cells", "a map needs cells");
  const std::size_t cells = map.cells->columns() * map.cells->rows(), occupied = map.cells->occupied_cells();
  if (occupied == cells) list.fail(key, "all " + std::to_string(cells) + " cells of the map are occupied");
  if (occupied == 0) list.warn(key, "none of the " + std::to_string(cells) + " cells of the map is occupied");
}

void check_ways(FaultList& list, const Scenario& scenario, std::span<const Vec2> targets,
                const std::function<std::string(std::size_t)>& key_of) {
  std::vector<Vec2> start;
  for (std::size_t k = 0; k < scenario.obstacles.size(); ++k) {
    const auto* map = std::get_if<FloorMap>(&scenario.obstacles[k]);
    if (map == nullptr) continue;
    if (start.empty()) start = place(scenario).position;
    Roads roads(*map, scenario.robot.radius_m);
    for (const Vec2 p : start) roads.begin_at(p);
    for (std::size_t i = 0; i < targets.size(); ++i)
      if (!roads.lead_to(targets[i], target_tolerance_m(scenario)))
        list.fail(key_of(i), "target " + std::to_string(i) + " at " + at(targets[i]) +
                                 " is in a room that no robot can reach from the start; the nearest place that they "
                                 "reach is " +
                                 at(roads.nearest_reached(targets[i]).value_or(start.front())));
    const std::vector<Roads::Room> rooms = roads.closed_rooms();
    if (rooms.empty()) continue;
    const auto smaller = [](const Roads::Room& a, const Roads::Room& b) { return a.cells < b.cells; };
    const Roads::Room& largest = *std::max_element(rooms.begin(), rooms.end(), smaller);
    list.warn(element("obstacles", k), "no robot can reach " + std::to_string(rooms.size()) +
                                           (rooms.size() == 1 ? " closed room" : " closed rooms") +
                                           " of the map; the largest one is at " + at(largest.place));
  }
}

}  // namespace banyan::world
