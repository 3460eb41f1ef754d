// SPDX-License-Identifier: MIT
// Followers flock with their leader, connectors stand between their neighbours. Lengths q are in C, velocities in K.
#include "rooms.hpp"

namespace banyan::baselines::branches {
namespace {

constexpr float full_speed = 10.0F;      // 1 / the distance in C from which attraction is at its limit
constexpr float repulsion = 1.5625F;     // at a distance of C, before the power
constexpr float least_distance = 0.01F;  // C

constexpr float followers_attraction = 1.5F;
constexpr float followers_repulsion = 2.0F;
constexpr float followers_rest = 0.125F;  // a smaller velocity is none
constexpr float connectors_repulsion = 1.2F;
constexpr float connectors_rest = 0.1875F;

class Spacing {
 public:
  explicit Spacing(const Robot& robot) : robot_(robot), self_(robot.self), table_(robot.table()) {}

  [[nodiscard]] Vec2 follower() const noexcept {
    const Vec2 u = clamped(attraction(), 1.0F) * followers_attraction +
                   clamped(push([](int) { return true; }), 1.0F) * followers_repulsion;
    return norm(u) < followers_rest ? Vec2{} : u;
  }

  [[nodiscard]] Vec2 connector() const noexcept {
    const auto is_next = [&](int k) { return table_.message(k).connector && self_.links.has(table_.id(k)); };
    const Vec2 u = pull_of_links() + pull_of_team() + clamped(push(is_next), 1.0F) * connectors_repulsion;
    return norm(u) < connectors_rest ? Vec2{} : u;
  }

  // To where the way to the root was, or to a robot that is joined.
  [[nodiscard]] Vec2 way_back() const noexcept {
    int nearest = -1;
    for (int k = 0; k < table_.size(); ++k) {
      const Message& m = table_.message(k);
      if (!m.connector || news_age(m.joined_age, table_, k) == unknown_age || self_.links.has(m.id)) continue;
      if (nearest < 0 || table_.range(k) < table_.range(nearest)) nearest = k;
    }
    if (nearest >= 0 && self_.is_cut(robot_.params))
      return table_.range(nearest) > robot_.reach() ? unit(table_.position(nearest)) : Vec2{};
    if (self_.has_lost_parent()) return unit(self_.lost_at);
    return self_.is_leader() ? Vec2{} : connector();
  }

 private:
  [[nodiscard]] Vec2 at(int k) const noexcept { return table_.position(k); }

  // (5), mean over the robots that are `of`
  template <class Of> [[nodiscard]] Vec2 push(const Of& of) const noexcept {
    const float flock = robot_.params.flock;
    Vec2 sum;
    int count = 0;
    for (int k = 0; k < table_.size(); ++k) {
      if (!of(k)) continue;
      const Vec2 q = at(k);
      const float d = std::max(norm(q), least_distance);
      const float ratio = flock / d * (flock / d);
      sum += q * (-repulsion / (d * d) * ratio * ratio);
      ++count;
    }
    return count > 0 ? sum * (1.0F / static_cast<float>(count)) : sum;
  }

  // To the leader, or to those of the team who are nearer to it; on the way to another team to those who have heard of
  // its need before; without a team to the root.
  [[nodiscard]] Vec2 attraction() const noexcept {
    if (const int k = table_.find(self_.team); k >= 0 && table_.message(k).leader) return at(k) * full_speed;
    if (self_.team == nobody)
      return to_newest([&](const Message& m) { return m.root == self_.root ? m.root_age : unknown_age; });
    if (self_.travels)
      return to_newest([&](const Message& m) { return m.needy == self_.team ? m.needy_age : unknown_age; });
    Vec2 sum;
    int count = 0;
    for (int k = 0; k < table_.size(); ++k) {
      const Message& m = table_.message(k);
      if (!is_follower(m) || m.team != self_.team || m.team_age >= self_.team_age) continue;
      sum += at(k);
      ++count;
    }
    return count > 0 ? sum * (full_speed / static_cast<float>(count)) : sum;
  }
  template <class Age> [[nodiscard]] Vec2 to_newest(const Age& age_of) const noexcept {
    int best = -1;
    int best_age = unknown_age;
    for (int k = 0; k < table_.size(); ++k) {
      const int said = age_of(table_.message(k));
      if (said == unknown_age) continue;
      const int age = age_now(said, table_, k);
      if (age > best_age || (age == best_age && best >= 0 && table_.range(k) >= table_.range(best))) continue;
      best = k;
      best_age = age;
    }
    return best < 0 ? Vec2{} : at(best) * full_speed;
  }

  // (6)
  [[nodiscard]] Vec2 pull_of_links() const noexcept {
    const float spacing = robot_.params.spacing;
    Vec2 sum;
    for (std::size_t i = 0; i < self_.links.size(); ++i) {
      const int k = table_.find(self_.links[i].to);
      if (k < 0) continue;
      const float d = norm(at(k));
      const float room = std::max(1.0F - d, least_distance);
      sum += at(k) * (d > spacing ? (1.0F - spacing) / room : 1.0F);
    }
    return self_.links.size() == 0 ? sum : sum * (full_speed / static_cast<float>(self_.links.size()));
  }
  // (7)
  [[nodiscard]] Vec2 pull_of_team() const noexcept {
    if (self_.links.size() > 2) return {};
    const float spacing = robot_.params.spacing;
    Vec2 sum;
    float farthest = 0.0F;
    int leaders = 0;
    for (std::size_t i = 0; i < self_.links.size(); ++i) {
      const int k = table_.find(self_.links[i].to);
      if (k < 0) continue;
      if (!table_.message(k).leader) {
        farthest = std::max(farthest, norm(at(k)));
        continue;
      }
      sum += at(k);
      ++leaders;
    }
    if (leaders == 0) return {};
    const float half = 0.5F * (1.0F - spacing);
    const float weight = std::clamp((spacing + half - farthest) / half, 0.0F, 1.0F);
    return sum * (weight * full_speed / static_cast<float>(leaders));
  }

  const Robot& robot_;
  const State& self_;
  const Table<Message>& table_;
};

}  // namespace

Vec2 spacing_motion(const Robot& robot) noexcept {
  const State& self = robot.self;
  const Spacing spacing(robot);
  if (self.is_follower()) return spacing.follower();
  if (self.has_lost_parent() || self.is_cut(robot.params)) return spacing.way_back();
  if (self.connector && self.has_lost_child()) return {};
  return self.is_leader() ? target_pull(self.assignment, robot.params) : spacing.connector();
}

void guard_links(const Robot& robot, Guard& guard) noexcept {
  for (std::size_t i = 0; i < robot.self.links.size(); ++i)
    if (const int k = robot.table().find(robot.self.links[i].to); k >= 0)
      guard.add(robot.table().position(k), robot.reach(), robot.params.guard_rate);
}

}  // namespace banyan::baselines::branches
