// SPDX-License-Identifier: MIT
// The order: whatever is heard, sensed and lost, parents close no cycle, and nobody falls back.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tiny_world.hpp"

namespace banyan::caravan {
namespace {

// RFC 1982 written otherwise than by the controller: `a` is less than half a turn ahead of `b`.
bool is_later(int a, int b) { return a != b && (a - b + 65536) % 65536 < 32768; }
bool is_later(const Root& a, const Root& b) {
  if (a.id == nobody) return false;
  if (b.id == nobody) return true;
  return a.sequence == b.sequence ? a.id > b.id : is_later(a.sequence, b.sequence);
}
bool is_ahead_of(const Message& a, const Message& b) {
  return a.root == b.root ? a.root.id != nobody && is_later(a.beat, b.beat) : is_later(a.root, b.root);
}

// Either all links go both ways and lose nothing, or packets get lost and late and some robots are deaf to others.
enum class Air { clear, any };

// Robots anywhere in a crowd, moved about by hand, on a radio that changes all the time; orders as they come.
class Bedlam {
 public:
  Bedlam(std::size_t robots, std::uint64_t seed, bool has_root, Air air)
      : dice(seed),
        air_(air),
        world(crowd(robots), dice.comes_up(0.5F) ? std::vector{robots - 1} : std::vector<std::size_t>{}, has_root) {
    world.by_distance = false;
    world.dice = Dice(seed + 1);
    if (air == Air::clear) return;
    world.loss = dice.comes_up(0.5F) ? dice.between(0.0F, 0.9F) : 0.0F;
    world.oldest = dice.comes_up(0.5F) ? dice.below(6) : 0;
    late_ = dice.comes_up(0.5F) ? dice.between(0.0F, 0.8F) : 0.0F;
  }
  void tick() {
    const std::size_t n = world.size();
    const auto one = [&] { return dice.below(n); };
    if (dice.comes_up(0.2F)) {
      const std::size_t i = one(), j = one();
      const bool apart = dice.comes_up(0.4F);
      world.deafen(i, j, apart);
      if (air_ == Air::clear) world.deafen(j, i, apart);
    }
    if (dice.comes_up(0.03F)) world.jam(one(), dice.comes_up(0.5F));
    if (dice.comes_up(0.05F)) world.send(one(), dice.on_disc(3.0F));
    if (dice.comes_up(0.03F)) world.call_back(one());
    if (dice.comes_up(0.01F)) world.give_up(static_cast<RobotId>(one()));
    if (dice.comes_up(0.05F)) world.places[one()] = dice.on_disc(0.8F);
    if (dice.comes_up(0.05F)) world.see_obstacles(one(), {dice.on_disc(0.2F)});
    if (dice.comes_up(0.002F)) world.kill(one());
    std::vector<bool> late(n);
    for (std::size_t i = 0; i < n; ++i) late[i] = dice.comes_up(late_);
    world.step(late);
  }

  Dice dice;

 private:
  Air air_;

 public:
  TinyWorld world;

 private:
  std::vector<Vec2> crowd(std::size_t robots) {
    std::vector<Vec2> places;
    for (std::size_t i = 0; i < robots; ++i) places.push_back(dice.on_disc(0.8F));
    return places;
  }
  float late_ = 0.0F;
};

void keeps_order(Air air) {
  const auto robots = *rc::gen::inRange<std::size_t>(2, 7);
  Bedlam bedlam(robots, any_seed(), *rc::gen::inRange(0, 5) > 0, air);
  TinyWorld& world = bedlam.world;
  for (int t = 0; t < 400; ++t) {
    std::vector<Message> before;
    for (std::size_t i = 0; i < robots; ++i) before.push_back(world.said(i));
    bedlam.tick();
    RC_ASSERT(!world.has_cycle());
    for (std::size_t i = 0; i < robots; ++i) {
      const Message& now = world.said(i);
      RC_ASSERT(!is_ahead_of(before[i], now));
      if (now.parent == nobody) continue;
      // What was heard of the parent it had said before this round, and it only counts on.
      if (now.parent != before[i].parent) {
        RC_ASSERT(is_ahead_of(before[now.parent], now));
        RC_ASSERT(is_ahead_of(before[now.parent], before[i]));
      }
      RC_ASSERT(is_ahead_of(world.said(now.parent), now));
    }
  }
}

RC_GTEST_PROP(CaravanOrder, NoParentsCloseAndNobodyFallsBackInClearAir, ()) { keeps_order(Air::clear); }

TEST(CaravanOrder, NoParentsCloseAndNobodyFallsBackWhateverIsHeard) {
  EXPECT_TRUE(rc::check([] { keeps_order(Air::any); }));
}

// The count wraps after 65,536 rounds, and is compared as serial numbers are.
TEST(CaravanOrder, GoesOnWhereTheRootsCountWraps) {
  TinyWorld world({{0, 0}, {0.4F, 0}, {0.8F, 0}});
  world.hold_all();
  world.part(0, 2);
  world.steps(100);  // the first pairs are a little older than 0
  int wraps = 0;
  for (int t = 0; t < 65'600; ++t) {
    const Message before = world.said(2);
    world.step();
    ASSERT_FALSE(is_ahead_of(before, world.said(2))) << t;
    wraps += world.said(2).beat < before.beat ? 1 : 0;
  }
  EXPECT_EQ(wraps, 1);
  EXPECT_EQ(world.said(2).parent, 1);
  EXPECT_EQ(world.said(1).parent, 0);
}

TEST(CaravanOrder, AllEndUnderTheNewestOfTwoRoots) {
  TinyWorld world({{0, 0}, {0.4F, 0}, {0.8F, 0}, {1.2F, 0}});
  world.hold_all();
  world.steps(30);
  // Cut in two for so long that the outer half has a root of its own.
  for (const std::size_t i : {2U, 3U})
    for (const std::size_t j : {0U, 1U}) world.part(i, j);
  world.steps(300);
  EXPECT_EQ(world.of_role(Role::root).size(), 2U);
  for (const std::size_t i : {2U, 3U})
    for (const std::size_t j : {0U, 1U}) world.part(i, j, false);
  world.steps(30);
  const auto roots = world.of_role(Role::root);
  ASSERT_EQ(roots.size(), 1U);
  EXPECT_GE(roots[0], 2U) << "the newer";
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_EQ(world.said(i).root.id, roots[0]);
    EXPECT_TRUE(world.leads_to(i, roots[0])) << i;
  }
}

}  // namespace
}  // namespace banyan::caravan
