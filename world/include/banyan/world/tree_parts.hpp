// SPDX-License-Identifier: MIT
// Whether a network holds together where it matters: the living robots of the tree (workers, connectors,
// roots) and the radio links between them. Spares do not count: the mission does not
// need one that is cut off behind a door, and nothing keeps those in place that are part of a link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "banyan/controller/core/report.hpp"

namespace banyan::world {

class TreeParts {
 public:
  explicit TreeParts(std::size_t robots) : seen_(robots), queue_(robots) {}

  // Components that the living robots of the tree form; 0 if no root lives. links(i) are the neighbours of
  // robot i, none of them dead. O(robots + links of the tree), no allocation.
  template <class Links>
  [[nodiscard]] std::uint32_t count(std::span<const std::uint8_t> alive, std::span<const Report> reports,
                                    const Links& links) {
    std::uint32_t parts = 0;
    bool root = false;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const bool of_tree = alive[i] != 0 && reports[i].role != Role::spare;
      root = root || (of_tree && reports[i].role == Role::root);
      seen_[i] = of_tree ? 0 : 1;
    }
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (seen_[i] != 0) continue;
      ++parts;
      visit(static_cast<std::uint32_t>(i), links);
    }
    return root ? parts : 0;
  }

 private:
  template <class Links> void visit(std::uint32_t start, const Links& links) {
    std::size_t end = 0;
    const auto reach = [&](std::uint32_t j) {
      if (seen_[j] != 0) return;
      seen_[j] = 1;
      queue_[end++] = j;
    };
    reach(start);
    for (std::size_t next = 0; next < end; ++next)
      for (const std::uint32_t j : links(queue_[next])) reach(j);
  }
  std::vector<std::uint8_t> seen_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace banyan::world
