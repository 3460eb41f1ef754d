// SPDX-License-Identifier: MIT
// Which robots can hear each other: links by range and exact occlusion, all pairs, every tick.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "banyan/world/bodies.hpp"
#include "banyan/world/scenario.hpp"
#include "banyan/world/threads.hpp"

namespace banyan::world {

// The links of a swarm: those pairs for which `hears` of sight.hpp says so, to the bit, but found in O(N + pairs in
// range). Exactly symmetric: each pair is decided once.
class Radio {
 public:
  Radio(const Scenario& scenario, std::size_t robots);
  Radio(const Radio& other);
  Radio& operator=(const Radio&) = delete;
  ~Radio();

  // Finds links, blocked pairs and near pairs at these poses, one of each per robot. `raised`: 1 where an antenna is,
  // with radio.sight_leak only, and else empty. What no motion can have changed is not looked at again.
  void update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive,
              std::span<const std::uint8_t> raised, Executor& executor);
  // From the next update on whether bodies and these obstacles block.
  void occlude(bool on, std::span<const Obstacle> obstacles);
  // Robot i has vanished since the last update: it is near no other robot.
  void forget(std::uint32_t i);

  // Of robot i, ascending.
  [[nodiscard]] std::span<const std::uint32_t> links(std::size_t i) const noexcept;
  // Pairs whose bodies could touch in the next tick, ascending.
  [[nodiscard]] NearPairs near() const noexcept;
  // In range, but occluded. Listed when asked for: a tick has no use for them.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> blocked() const;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  class Fast;
  std::unique_ptr<Fast> fast_;
};

}  // namespace banyan::world
