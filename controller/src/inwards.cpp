// SPDX-License-Identifier: MIT
// The inwards algorithm (paper Sec. III-E): branches grow from the workers towards the root; only
// who is named as a parent joins.
#include "banyan/controller/parent_selection.hpp"
#include "banyan/controller/policies.hpp"

namespace banyan {
namespace {

class Inwards final : public Policy {
 public:
  constexpr Inwards() = default;
  [[nodiscard]] std::string_view name() const noexcept override { return "inwards"; }
  [[nodiscard]] std::string_view summary() const noexcept override {
    return "grows a sparse tree from the workers towards the root; only robots that are needed join";
  }
  [[nodiscard]] Params defaults(Reading reading) const noexcept override {
    Params p;  // Table I, inwards column
    p.safe_range_m = 1.3525581F;
    p.avoidance_range_m = 0.4099F;
    p.ideal_distance_m = 1.540841F;
    p.interaction_gain = 10.0F;
    p.target_gain = 0.2539F;
    p.reconfiguration_period_s = 44.0F;
    p.liveness_period_s = 0.5F;
    p.recruitment_distance_m = 1.321353F;
    p.insertion_distance_m = 0.066395F;
    p.reading = reading;
    return p;
  }
  [[nodiscard]] bool may_join(const Robot& robot) const noexcept override {
    return robot.self.is_worker || is_named_parent(robot);
  }
  [[nodiscard]] bool accepts(const Robot&, int) const noexcept override { return true; }
  // The smallest distance to the root, within S if there is one.
  [[nodiscard]] bool prefers(const Robot& robot, int a, int b) const noexcept override {
    const Neighborhood& table = robot.table();
    const bool a_safe = table.range(a) <= robot.params.safe_range_m;
    const bool b_safe = table.range(b) <= robot.params.safe_range_m;
    return a_safe != b_safe ? a_safe : table.message(a).label_cm < table.message(b).label_cm;
  }
  [[nodiscard]] bool tree_complete(const Robot& robot) const noexcept override {
    return robot.self.subtree_workers >= robot.self.flood_workers;
  }
  [[nodiscard]] bool leaves_branch(const Robot& robot) const noexcept override { return robot.children.size == 0; }
};

}  // namespace

const Policy& inwards() noexcept {
  static constexpr Inwards policy;
  return policy;
}

}  // namespace banyan
