// SPDX-License-Identifier: MIT
// What differs between the tree-forming algorithms. Everything else is the shared machinery; a
// further algorithm is one new file that derives from Policy and one line in registry.cpp.
#pragma once

#include <span>
#include <string_view>

#include "banyan/controller/robot.hpp"

namespace banyan {

struct Guard;  // motion.hpp

class Policy {
 public:
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;

  [[nodiscard]] virtual std::string_view name() const noexcept = 0;     // as in mission.algorithm
  [[nodiscard]] virtual std::string_view summary() const noexcept = 0;  // one sentence
  // Table I's column, in the given reading.
  [[nodiscard]] virtual Params defaults(Reading reading) const noexcept = 0;
  // Whether the lengths among them stand for C = 2 m and grow with it. Table I's are absolute.
  [[nodiscard]] virtual bool scales_with_range() const noexcept { return false; }

  // SELECT PARENT (paper Sec. III-D, III-E). Whether a robot without parent may join the tree now;
  // whether it accepts neighbour k of its table among the candidates; whether it prefers candidate
  // a to candidate b. What a candidate is at all, parent_selection.hpp decides for every policy:
  // its label order keeps the tree free of cycles.
  [[nodiscard]] virtual bool may_join(const Robot& robot) const noexcept = 0;
  [[nodiscard]] virtual bool accepts(const Robot& robot, int k) const noexcept = 0;
  [[nodiscard]] virtual bool prefers(const Robot& robot, int a, int b) const noexcept = 0;
  // The root's view: everybody who should be in the tree is (barrier of SELECT PARENT).
  [[nodiscard]] virtual bool tree_complete(const Robot& robot) const noexcept = 0;
  // GROW TREE: whether a spare that has a parent leaves its branch now (paper Sec. III-D).
  [[nodiscard]] virtual bool leaves_branch(const Robot& robot) const noexcept = 0;

  // ---- What follows is the paper's own unless a policy says otherwise (policy.cpp). ----

  // m: a worker this near to its target wants nothing more of its tree.
  [[nodiscard]] virtual float rest_distance(const Params& params) const noexcept;
  // The edge to my parent, or one below it, wants a spare (paper Fig. 5).
  [[nodiscard]] virtual bool needs_spare(const Robot& robot) const noexcept;
  // A worker may be somebody's parent (protocol 5: not in the paper's algorithms).
  [[nodiscard]] virtual bool workers_relay() const noexcept { return false; }
  // The root's view, once R is over: it is time to reconstruct the tree.
  [[nodiscard]] virtual bool reconstructs(const Robot& robot) const noexcept;
  // An edge whose need nobody answers calls spares from afar (protocol 7).
  [[nodiscard]] virtual bool may_call(const Robot& robot) const noexcept;
  // A spare whose edge is granted joins it from where it is: `owner` and `parent` are the edge's ends.
  [[nodiscard]] virtual bool may_insert(const Robot& robot, int owner, int parent) const noexcept;
  // Whether neighbour k may become the root.
  [[nodiscard]] virtual bool may_inherit(const Robot& robot, int k) const noexcept;
  // Changes of the tree between reconstructions, once a tick after SELECT PARENT's work. None.
  virtual void tend_tree(Robot& robot) const noexcept;
  // What robots of the tree and spares want to do, in units of speed_gain (paper Sec. III-G).
  [[nodiscard]] virtual Vec2 tree_motion(const Robot& robot) const noexcept;
  [[nodiscard]] virtual Vec2 spare_motion(const Robot& robot) const noexcept;
  // What else limits how they may move (corrected). Nothing.
  virtual void limit_motion(const Robot& robot, Guard& guard) const noexcept;

 protected:
  constexpr Policy() = default;
  ~Policy() = default;
};

// All policies, in the order in which they are listed. Static lifetime.
[[nodiscard]] std::span<const Policy* const> policies() noexcept;
// By name; null if there is none.
[[nodiscard]] const Policy* find_policy(std::string_view name) noexcept;

}  // namespace banyan
