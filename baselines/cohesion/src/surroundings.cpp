// SPDX-License-Identifier: MIT
// Neighbours in their order, and how they are turned. A robot measures no orientations; two bearings of one line, its
// own and the neighbour's, tell as much.
#include <algorithm>
#include <numeric>

#include "rooms.hpp"

namespace banyan::baselines::cohesion {
namespace {

// A line tells more the longer it is: lines are added up.
Vec2 frame_of(const State& self, int k) noexcept {
  const Table<Message>& table = self.neighbors;
  Vec2 sum;
  const auto compare = [&](const Mention& mention) {
    if (mention.id == nobody) return;
    const bool is_me = mention.id == self.id;
    const int j = is_me ? -1 : table.find(mention.id);
    if (j < 0 && !is_me) return;
    const Vec2 line = (is_me ? Vec2{} : table.position(j)) - table.position(k);
    sum += rotate_back(unit_vector(static_cast<float>(mention.bearing) / per_rad), line);
  };
  for (const SaidSector& sector : table.message(k).sectors) {
    compare(sector.right);
    compare(sector.left);
  }
  return unit(sum);
}

}  // namespace

Surroundings::Surroundings(const Params& params, const State& self) noexcept : size(self.neighbors.size()) {
  const float scale = source_range / params.longest_link;
  for (int k = 0; k < size; ++k) {
    const auto i = static_cast<std::size_t>(k);
    places[i] = self.neighbors.position(k) * scale;
    const float bearing = angle_of(places[i]);
    bearings[i] = bearing < 0.0F ? bearing + 2.0F * pi<float> : bearing;
    frames[i] = frame_of(self, k);
    order[i] = static_cast<std::uint8_t>(k);
  }
  std::sort(order.begin(), order.begin() + size, [&](std::uint8_t a, std::uint8_t b) {
    return bearings[a] != bearings[b] ? bearings[a] < bearings[b] : self.neighbors.id(a) < self.neighbors.id(b);
  });
}

float Surroundings::gap(int i) const noexcept {
  const float turn = bearings[static_cast<std::size_t>(next(i + 1))] - bearings[static_cast<std::size_t>(next(i))];
  return i + 1 < size ? turn : turn + 2.0F * pi<float>;
}

}  // namespace banyan::baselines::cohesion
