// SPDX-License-Identifier: MIT
// The outwards algorithm (paper Sec. III-D): a spanning tree that grows from the root; branches
// without worker are pruned from their leaves.
#include "banyan/controller/policies.hpp"

namespace banyan {
namespace {

class Outwards final : public Policy {
 public:
  constexpr Outwards() = default;
  [[nodiscard]] std::string_view name() const noexcept override { return "outwards"; }
  [[nodiscard]] std::string_view summary() const noexcept override {
    return "grows a spanning tree from the root over all robots, then prunes branches without worker";
  }
  [[nodiscard]] Params defaults(Reading reading) const noexcept override {
    Params p;  // Table I's outwards column is what Params starts with
    p.reading = reading;
    return p;
  }
  // Everybody joins in SELECT PARENT; later only who still matters to the tree.
  [[nodiscard]] bool may_join(const Robot& robot) const noexcept override {
    return robot.self.phase == Phase::select_parent || robot.self.role != Role::spare;
  }
  [[nodiscard]] bool accepts(const Robot& robot, int k) const noexcept override { return robot.table().message(k).committed; }
  [[nodiscard]] bool prefers(const Robot& robot, int a, int b) const noexcept override {
    return robot.table().range(a) < robot.table().range(b);
  }
  // Never equality: with motion and occlusion the flood under-counts (protocol 4).
  [[nodiscard]] bool tree_complete(const Robot& robot) const noexcept override {
    return robot.self.subtree >= robot.self.flood_robots;
  }
  [[nodiscard]] bool leaves_branch(const Robot& robot) const noexcept override { return robot.children.size == 0; }
};

}  // namespace

const Policy& outwards() noexcept {
  static constexpr Outwards policy;
  return policy;
}

}  // namespace banyan
