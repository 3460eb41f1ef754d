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

// Where the middle of a robot can be, cell by cell and a row of cells around the map. In doubt it can: a cell counts if
// the robot may fit at some point of it.
class Roads {
 public:
  struct Room {
    std::size_t cells = 0;
    Vec2 place{};  // a point of it
    bool outside = false;
  };

  Roads(const FloorMap& map, double radius_m)
      : frame_(map),
        cells_(*map.cells),
        cell_m_(map.cell_m),
        radius_(radius_m / map.cell_m),
        columns_(static_cast<std::int64_t>(cells_.columns()) + 2 * margin),
        rows_(static_cast<std::int64_t>(cells_.rows()) + 2 * margin),
        state_(static_cast<std::size_t>(columns_ * rows_), State::unknown) {}

  // From here on robots drive, and reach the whole room.
  void begin_at(Vec2 p) { static_cast<void>(enter(index_at(p), State::reached)); }

  // The rooms in which nobody has begun.
  [[nodiscard]] std::vector<Room> closed_rooms() {
    std::vector<Room> rooms;
    for (std::size_t k = 0; k < state_.size(); ++k)
      if (const Room room = enter(k, State::closed); room.cells > 0 && !room.outside) rooms.push_back(room);
    return rooms;
  }

  // The point that robots reach nearest to p; nothing if they reach none. O(cells)
  [[nodiscard]] std::optional<Vec2> nearest_reached(Vec2 p) const {
    const Vec2 at = frame_.in_cells(p);
    if (state_[index_at(p)] == State::reached) return p;
    std::optional<Vec2> best;
    double least2 = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < state_.size(); ++k) {
      if (state_[k] != State::reached) continue;
      const double away2 = squared_norm(middle_of(k) - at);
      if (away2 >= least2) continue;
      least2 = away2;
      best = frame_.in_metres(middle_of(k));
    }
    return best;
  }
  // Whether they come so near to it.
  [[nodiscard]] bool lead_to(Vec2 p, double within_m) const {
    const std::optional<Vec2> nearest = nearest_reached(p);
    return nearest && distance(*nearest, p) <= within_m + cell_m_;
  }

 private:
  enum class State : std::uint8_t { unknown, narrow, reached, closed };
  static constexpr std::int64_t margin = 1;

  Room enter(std::size_t first, State as) {
    Room room;
    const auto visit = [&](std::int64_t column, std::int64_t row) {
      if (column < 0 || row < 0 || column >= columns_ || row >= rows_) {
        room.outside = true;
        return;
      }
      const auto index = static_cast<std::size_t>(row * columns_ + column);
      if (state_[index] != State::unknown) return;
      state_[index] = fits(column - margin, row - margin) ? as : State::narrow;
      if (state_[index] == as) open_.push_back(index);
    };
    const auto columns = static_cast<std::size_t>(columns_);
    visit(static_cast<std::int64_t>(first % columns), static_cast<std::int64_t>(first / columns));
    while (!open_.empty()) {
      const std::size_t at = open_.back();
      open_.pop_back();
      if (room.cells++ == 0) room.place = frame_.in_metres(middle_of(at));
      for (std::int64_t k = 0; k < 9; ++k)
        visit(static_cast<std::int64_t>(at % columns) + k % 3 - 1, static_cast<std::int64_t>(at / columns) + k / 3 - 1);
    }
    return room;
  }
  [[nodiscard]] bool fits(std::int64_t column, std::int64_t row) const {
    constexpr double half_diagonal = 0.7072;
    const std::int64_t reach = cells_.reach(column, row);
    if (reach == 0 || static_cast<double>(reach - 1) >= radius_) return reach != 0;
    const Vec2 middle{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
    return cells_.clearance(middle) + half_diagonal >= radius_;
  }
  [[nodiscard]] Vec2 middle_of(std::size_t index) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return {static_cast<double>(index % columns) - margin + 0.5, static_cast<double>(index / columns) - margin + 0.5};
  }
  [[nodiscard]] std::size_t index_at(Vec2 p) const {
    const Vec2 at = frame_.in_cells(p);
    const auto within = [](double x, std::int64_t size) {
      return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(x)) + margin, 0, size - 1);
    };
    return static_cast<std::size_t>(within(at.y, rows_) * columns_ + within(at.x, columns_));
  }

  CellFrame frame_;
  const CellGrid& cells_;
  double cell_m_, radius_;
  std::int64_t columns_, rows_;
  std::vector<State> state_;
  std::vector<std::size_t> open_;
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
                                 "reach is " + at(roads.nearest_reached(targets[i]).value_or(start.front())));
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
