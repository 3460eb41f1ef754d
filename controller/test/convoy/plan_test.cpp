// SPDX-License-Identifier: MIT
// Chains from target to target: what the root plans, how the plan travels down the tree, and how the
// topmost robot of a branch leads it (docs/convoy.md).
#include "convoy/plan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "bench.hpp"

namespace banyan {
namespace {

void know(ConvoyState& state, const std::vector<Vec2>& targets) {
  state.task_count = static_cast<std::uint8_t>(targets.size());
  for (std::size_t k = 0; k < targets.size(); ++k) {
    state.tasks[k] = {};
    state.tasks[k].serves = state.tasks[k].holder = static_cast<RobotId>(100 + k);
    state.tasks[k].target = targets[k];
  }
}

// A root whose only child carries all workers, with `robots` in its tree.
ConvoyBench commander(const std::vector<Vec2>& targets, int robots) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  auto& child = bench.put(5, {0.75F, 0});
  child.role = Role::connector;
  child.parent = 1;
  child.committed = true;
  child.depth = 2;
  child.subtree = static_cast<std::uint16_t>(robots - 1);
  child.subtree_workers = static_cast<std::uint16_t>(targets.size());
  know(bench.state, targets);
  return bench;
}

// Ticks the census and the plan as step() does, without succession: nobody here speaks for the workers.
void run(ConvoyBench& bench, int ticks) {
  for (int t = 0; t < ticks; ++t) {
    auto robot = bench.tick();
    bench.state.subtree = bench.say(5).subtree + 1;
    bench.state.subtree_workers = bench.say(5).subtree_workers;
    bench.state.want = from_fixed(bench.say(5).want);
    take_part_in_plan(robot);
  }
}

int ticks_until_plan(const ConvoyBench& bench) { return bench.params.rounds(bench.params.plan_after_drives); }

// Kruskal's algorithm, as an independent judge.
std::vector<float> shortest_edges(const std::vector<Vec2>& points) {
  std::vector<std::tuple<float, std::size_t, std::size_t>> edges;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) edges.emplace_back(distance(points[i], points[j]), i, j);
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> group(points.size());
  std::iota(group.begin(), group.end(), 0U);
  std::vector<float> lengths;
  for (const auto& [d, i, j] : edges) {
    if (group[i] == group[j]) continue;
    lengths.push_back(d);
    const std::size_t from = group[i];
    std::replace(group.begin(), group.end(), from, std::size_t{group[j]});
  }
  return lengths;
}

std::vector<Vec2> arbitrary_targets(std::size_t least) {
  std::vector<Vec2> targets(*rc::gen::inRange<std::size_t>(least, task_capacity + 1));
  for (Vec2& t : targets)
    t = {static_cast<float>(*rc::gen::inRange(-900, 901)) * 0.005F,
         static_cast<float>(*rc::gen::inRange(-900, 901)) * 0.005F};
  return targets;
}

RC_GTEST_PROP(Plan, IsAShortestTreeThroughTheTargets, ()) {
  const std::vector<Vec2> targets = arbitrary_targets(2);
  ConvoyBench bench = commander(targets, 1000);
  bench.state.settled_ticks = static_cast<std::uint16_t>(20 * 40 * 10);  // late: all levels are in the plan
  run(bench, ticks_until_plan(bench));
  float length = 0.0F;
  int hosted = 0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const RobotId host = bench.state.hosts[k];
    if (host == nobody) continue;
    ++hosted;
    length += distance(targets[k], targets[host - 100U]);
  }
  RC_ASSERT(hosted == static_cast<int>(targets.size()) - 1);
  const std::vector<float> shortest = shortest_edges(targets);
  RC_ASSERT(std::abs(length - std::accumulate(shortest.begin(), shortest.end(), 0.0F)) < 5e-4F);
}

// Robots that edges of that length take, from one target to all others: by Kruskal's algorithm, whose edges Prim's
// finds, too.
int robots_of(const std::vector<Vec2>& targets, float edge) {
  int robots = 1;
  for (const float d : shortest_edges(targets)) robots += static_cast<int>(d / edge) + 1;
  return robots;
}

// Branches fold with a quarter more robots than two or three paths take, and no longer with less than a tenth more.
RC_GTEST_PROP(Plan, CountsWhetherRobotsSufficeForFolding, ()) {
  const std::vector<Vec2> targets = arbitrary_targets(1);
  ConvoyBench bench = commander(targets, 10);
  bench.params.link_redundancy = *rc::gen::inRange(2, 4);
  const auto paths =
      static_cast<float>(robots_of(targets, bench.params.compact_distance) * bench.params.link_redundancy);
  const auto too_few_with = [&](float robots) {
    bench.state.root_size = static_cast<RobotCount>(robots);
    run(bench, 16);
    return bench.state.too_few_to_fold;
  };
  RC_ASSERT(!too_few_with(0.0F));  // nobody has been counted yet
  RC_ASSERT(!too_few_with(1.1F * paths + 1.0F));
  RC_ASSERT(too_few_with(1.1F * paths - 1.0F));
  RC_ASSERT(too_few_with(1.25F * paths - 1.0F));
  RC_ASSERT(!too_few_with(1.25F * paths + 1.0F));
  RC_ASSERT(!too_few_with(1.1F * paths + 1.0F));
}

TEST(Plan, DoesNotCountTargetsThatAreGivenUpForFolding) {
  ConvoyBench bench = commander({{3, 0}, {-3, 0}, {0, 30}}, 10);
  bench.params.link_redundancy = 2;
  bench.state.root_size = 40;
  run(bench, 16);
  EXPECT_TRUE(bench.state.too_few_to_fold);
  bench.state.tasks[2].holder = nobody;
  run(bench, 16);
  EXPECT_FALSE(bench.state.too_few_to_fold);
}

TEST(Plan, CountsForFoldingOnlyWhereBranchesMayFold) {
  const auto too_few = [](int paths, bool line_of_sight) {
    ConvoyBench bench = commander({{3, 0}, {-3, 0}}, 10);
    bench.params.link_redundancy = paths;
    bench.params.line_of_sight = line_of_sight;
    bench.state.root_size = 3;
    run(bench, 16);
    return bench.state.too_few_to_fold;
  };
  EXPECT_TRUE(too_few(2, true));
  EXPECT_FALSE(too_few(1, true));
  EXPECT_FALSE(too_few(2, false));
}

TEST(Plan, WaitsUntilAllHaveBeenThereForAWhileAndIsForgottenWhenOneLeaves) {
  ConvoyBench bench = commander({{3, 0}, {3, 1.5F}, {-3, 0}}, 60);
  run(bench, ticks_until_plan(bench) - 1);
  EXPECT_FALSE(is_planned(bench.state));
  run(bench, 1);
  EXPECT_TRUE(is_planned(bench.state));
  bench.say(5).want = 128;
  run(bench, 20);
  EXPECT_TRUE(is_planned(bench.state));  // a branch that changes its parent may not be counted for a moment
  run(bench, 20);
  EXPECT_FALSE(is_planned(bench.state));
}

TEST(Plan, NeverForATreeThatIsAsSmall) {
  ConvoyBench bench = commander({{3, 0}, {3, 1.5F}, {-3, 0}}, 10);  // 6 C and 1.5 C: seven and two edges
  run(bench, 3000);
  EXPECT_FALSE(is_planned(bench.state));
}

TEST(Plan, NeverForMoreTargetsThanAreKnown) {
  ConvoyBench bench = commander({{3, 0}, {3, 1.5F}, {-3, 0}}, 60);
  bench.say(5).subtree_workers = 4;
  run(bench, 3000);
  EXPECT_FALSE(is_planned(bench.state));
}

TEST(Plan, NeverWhenSwitchedOff) {
  ConvoyBench bench = commander({{3, 0}, {3, 1.5F}, {-3, 0}}, 60);
  bench.params.plan_after_drives = 0.0F;
  run(bench, 3000);
  EXPECT_FALSE(is_planned(bench.state));
}

TEST(Plan, MayBeAskedForLaterThanItsPeriod) {
  ConvoyBench bench = commander({{3, 0}, {3, 1.5F}, {-3, 0}}, 60);
  bench.params.plan_after_drives = 10.0F;
  run(bench, ticks_until_plan(bench) - 1);
  EXPECT_FALSE(is_planned(bench.state));
  run(bench, 1);
  EXPECT_TRUE(is_planned(bench.state));
}

TEST(Plan, GrowsLevelByLevel) {
  ConvoyBench bench = commander({{1, 0}, {2, 0}, {3, 0}, {4, 0}}, 60);
  run(bench, ticks_until_plan(bench));
  const auto hosted = [&] {
    return std::count_if(bench.state.hosts.begin(), bench.state.hosts.end(),
                         [](RobotId host) { return host != nobody; });
  };
  EXPECT_EQ(hosted(), 1);
  run(bench, 400);
  EXPECT_EQ(hosted(), 2);
}

TEST(Plan, WithThriftGrowsFromItsLeavesInwards) {
  ConvoyBench bench = commander({{0, 0}, {1.5F, 0}, {3, 0}, {4.5F, 0}, {6, 0}}, 60);
  bench.params.thrift = 1.0F;
  run(bench, ticks_until_plan(bench));
  EXPECT_EQ(bench.state.hosts[0], 101);  // the ends first: the centre is target 102
  EXPECT_EQ(bench.state.hosts[4], 103);
  EXPECT_EQ(bench.state.hosts[1], nobody);
  run(bench, 250);
  EXPECT_EQ(bench.state.hosts[1], 102);
  EXPECT_EQ(bench.state.hosts[3], 102);
  EXPECT_EQ(bench.state.hosts[2], nobody);
}

TEST(Thrift, StretchesLengthsTowardsTheLongestEdge) {
  ConvoyParams p = convoy_defaults();
  EXPECT_EQ(thrifty(p, p.merge_distance), p.merge_distance) << "0: to the bit";
  float before = p.merge_distance;
  for (const float thrift : {0.25F, 0.5F, 1.0F}) {
    p.thrift = thrift;
    EXPECT_GT(thrifty(p, p.merge_distance), before);
    EXPECT_LT(thrifty(p, p.merge_distance), p.ideal_distance);
    before = thrifty(p, p.merge_distance);
  }
}

// Two near targets are held, of two far ones the farther is 1 C from its worker, and spares are called.
ConvoyBench starving() {
  ConvoyBench bench = commander({{1, 0}, {1.5F, 0}, {3, 0}, {-6, 0}}, 12);
  bench.state.tasks[0].reached = bench.state.tasks[1].reached = true;
  bench.state.call_hops = 3;
  bench.say(5).want = 256;
  return bench;
}
bool gives_up(const ConvoyBench& bench, int k) {
  return bench.state.hosts[static_cast<std::size_t>(k)] == static_cast<RobotId>(100 + k);
}
int given_up(const ConvoyBench& bench) {
  int count = 0;
  for (int k = 0; k < bench.state.task_count; ++k) count += gives_up(bench, k) ? 1 : 0;
  return count;
}

TEST(Shed, TheTargetThatCostsMostIsGivenUpOnceNobodyGetsOn) {
  ConvoyBench bench = starving();
  const int after = bench.params.rounds(bench.params.shed_after_drives);
  run(bench, after);
  EXPECT_EQ(given_up(bench), 0);
  run(bench, 2);
  EXPECT_TRUE(gives_up(bench, 3));
  EXPECT_EQ(given_up(bench), 1) << "one at a time";
  EXPECT_FALSE(is_planned(bench.state)) << "spares are still called";
  bench.state.tasks[3].holder = nobody;  // its worker has heard of it
  run(bench, 2);
  EXPECT_EQ(given_up(bench), 0);
  run(bench, after / 2);
  EXPECT_TRUE(gives_up(bench, 2)) << "sooner, now that it is known, and none that is held";
}

TEST(Shed, HowLongSparesHaveBeenMissedIsInTheHash) {
  ConvoyBench bench = starving();
  run(bench, 5);
  ConvoyState later = bench.state;
  ++later.short_ticks;
  ASSERT_EQ(later.shed, nobody);
  Digest now;
  Digest then;
  add_to(now, bench.state);
  add_to(then, later);
  EXPECT_NE(now.value(), then.value());
}

TEST(Shed, NotWhileAnybodyGetsOnOrNoSpareIsMissed) {
  for (const int what : {0, 1, 2, 3}) {
    ConvoyBench bench = starving();
    if (what == 1) bench.state.call_hops = nobody_calls;
    if (what == 2) bench.params.shed_after_drives = 0.0F;
    if (what == 3) bench.say(5).want = 3840;
    for (int second = 0; second < 150; ++second) {
      run(bench, 10);
      if (what == 3) bench.say(5).want -= 20;
    }
    EXPECT_EQ(given_up(bench), what == 0 ? 1 : 0) << what;
  }
}

TEST(Shed, TheWorkerThatHearsOfItIsNoWorkerAnyMoreAndNobodyFollows) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.role = Role::worker;
  bench.state.is_worker = true;
  bench.state.serves = 101;
  bench.state.parent = 5;
  know(bench.state, {{3, 0}, {3, 1.5F}});
  auto& m = bench.put(5, {0.5F, 0.0F});
  m.role = Role::connector;
  m.task_serves = m.task_host = 100;
  auto robot = bench.tick();
  take_part_in_plan(robot);
  EXPECT_TRUE(bench.state.is_worker) << "another's target";
  m.task_serves = m.task_host = 101;
  auto again = bench.tick();
  take_part_in_plan(again);
  EXPECT_FALSE(bench.state.is_worker);
  EXPECT_TRUE(is_put_off(bench.state.tasks[1]));
  bench.state.parent = nobody;  // a spare hears no more of it
  auto later = bench.tick();
  take_part_in_plan(later);
  EXPECT_EQ(bench.state.hosts[1], nobody) << "it may be the one that tries it again";
  EXPECT_EQ(bench.state.tasks[1].times_put_off, 1);
  EXPECT_EQ(bench.state.lead_to, nobody);
}

// Three targets are held with 12 robots; a fourth, which takes seven more, has been put off.
ConvoyBench with_one_put_off(int spares) {
  ConvoyBench bench = commander({{1, 0}, {1.5F, 0}, {3, 0}, {-6, 0}}, 12);
  for (Task& task : bench.state.tasks) task.reached = true;
  Task& task = bench.state.tasks[3];
  task.holder = nobody;
  task.reached = false;
  task.silent = true;
  task.times_put_off = 1;
  task.age_ticks = 10000;
  bench.state.root_size = static_cast<std::uint16_t>(12 + spares);
  bench.say(5).subtree_workers = 3;
  return bench;
}
bool tries(const ConvoyBench& bench) { return bench.state.tasks[3].holder == bench.state.id; }

TEST(Retry, ATargetIsTriedAgainOnceSparesSuffice) {
  ConvoyBench few = with_one_put_off(6);
  run(few, 200);
  EXPECT_FALSE(tries(few));
  ConvoyBench enough = with_one_put_off(7);
  run(enough, 50);
  EXPECT_FALSE(tries(enough)) << "the others have been held for less than five seconds";
  run(enough, 50);
  EXPECT_TRUE(tries(enough));
  EXPECT_TRUE(is_tried_again(enough.state.tasks[3]));
  EXPECT_TRUE(enough.state.tasks[3].gave_up) << "the root does not go itself";
}

TEST(Retry, ATargetThatHasEndedIsNot) {
  ConvoyBench bench = with_one_put_off(20);
  bench.state.tasks[3].silent = false;
  run(bench, 200);
  EXPECT_FALSE(tries(bench));
}

TEST(Retry, NotBeforeTheOthersAreHeld) {
  ConvoyBench bench = with_one_put_off(20);
  bench.say(5).want = 128;
  run(bench, 200);
  EXPECT_FALSE(tries(bench));
}

TEST(Retry, AtOnceIfNoOtherIsHeld) {
  ConvoyBench bench = with_one_put_off(20);
  for (int k = 0; k < 3; ++k) bench.state.tasks[static_cast<std::size_t>(k)].holder = nobody;
  bench.say(5).subtree_workers = 0;
  run(bench, 2);
  EXPECT_TRUE(tries(bench)) << "nobody else is to be waited for";
}

TEST(Retry, ThePauseDoublesUnlessThereAreMoreSparesThanEver) {
  for (const int tried_with : {8, 7}) {
    ConvoyBench bench = with_one_put_off(8);
    bench.state.tried_with = static_cast<std::uint16_t>(tried_with);
    bench.state.tasks[3].times_put_off = 3;
    bench.state.tasks[3].age_ticks = 2390;
    run(bench, 200);
    EXPECT_EQ(tries(bench), tried_with == 7) << tried_with;
    if (!tries(bench)) {
      bench.state.tasks[3].age_ticks = 2410;
      run(bench, 1);
    }
    EXPECT_TRUE(tries(bench));
    EXPECT_EQ(bench.state.tried_with, 8);
  }
}

// Seven times put off is a pause of 128 times as many rounds, more than slow robots count.
TEST(Retry, EndsItsPauseHoweverSlowTheRobots) {
  ConvoyBench bench = with_one_put_off(8);
  bench.params.rounds_per_drive = 2000.0F;
  bench.state.tried_with = 8;
  bench.state.tasks[3].times_put_off = most_put_off;
  bench.state.tasks[3].age_ticks = UINT16_MAX - 1;
  run(bench, 2000);
  EXPECT_FALSE(tries(bench));
  bench.state.tasks[3].age_ticks = UINT16_MAX;
  run(bench, 1);
  EXPECT_TRUE(tries(bench));
}

TEST(Retry, ItIsPutOffAgainIfNobodySetsOut) {
  ConvoyBench bench = with_one_put_off(7);
  run(bench, 100);
  ASSERT_TRUE(tries(bench));
  bench.state.tasks[3].age_ticks = 610;
  run(bench, 1);
  EXPECT_TRUE(is_put_off(bench.state.tasks[3]));
  EXPECT_EQ(bench.state.tasks[3].times_put_off, 2);
}

TEST(Retry, NoOtherTargetIsGivenUpForIt) {
  ConvoyBench bench = starving();  // the target that costs most is 103
  bench.state.tasks[2].times_put_off = 1;
  run(bench, bench.params.rounds(bench.params.shed_after_drives));
  EXPECT_TRUE(gives_up(bench, 2));
  EXPECT_FALSE(gives_up(bench, 3));
}

TEST(Retry, HowOftenIsInTheHash) {
  ConvoyBench bench = with_one_put_off(7);
  ConvoyState often = bench.state;
  ConvoyState richer = bench.state;
  ++often.tasks[3].times_put_off;
  ++richer.tried_with;
  Digest now, then, other;
  add_to(now, bench.state), add_to(then, often), add_to(other, richer);
  EXPECT_NE(now.value(), then.value());
  EXPECT_NE(now.value(), other.value());
}

TEST(Plan, TravelsDownTheTreeFromTheParentOnly) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.role = Role::connector;
  bench.state.parent = 5;
  know(bench.state, {{3, 0}, {3, 1.5F}});
  for (const RobotId id : {RobotId{5}, RobotId{6}}) {
    auto& m = bench.put(id, {0.5F, id == 5 ? 0.25F : -0.25F});
    m.role = Role::connector;
    m.task_serves = 101;
    m.task_host = id == 5 ? RobotId{100} : RobotId{77};
  }
  auto robot = bench.tick();
  take_part_in_plan(robot);
  EXPECT_EQ(bench.state.hosts[1], 100);
  EXPECT_EQ(bench.state.hosts[0], nobody);
}

// Robot 1 is the topmost of a branch that ends at target 101; its parent 5 is a junction, beside it the
// branch of target 100, whose next robot is 6.
class Leader : public testing::Test {
 protected:
  void SetUp() override {
    ConvoyState& s = bench.state;
    s.role = Role::connector;
    s.parent = 5;
    s.committed = true;
    s.label = 400;
    s.seqno = 50;
    s.subtree_workers = 1;
    s.depth = 3;
    know(s, {{0, 3}, {2, 2}});
    s.hosts[1] = 100;
    put(5, {-0.5F, 0}, nobody);
    put(6, {-0.25F, 0.75F}, 100);
    auto& child = put(7, {0.6F, 0.6F}, 101);
    child.parent = 1;
    child.label = 600;
    child.child_count = 1;
    child.subtree_workers = 1;
  }
  ConvoyMessage& put(RobotId id, Vec2 position, RobotId below) {
    auto& m = bench.put(id, position);
    m.role = Role::connector;
    m.committed = true;
    m.label = 200;
    m.seqno = 60;
    m.depth = 2;
    m.parent = 9;
    m.child_count = 2;
    m.below = below;
    return m;
  }
  void tick() {
    auto robot = bench.tick();
    take_part_in_plan(robot);
  }
  ConvoyBench bench = grown<Convoy>();
};

TEST_F(Leader, LeadsToTheHostAndDrivesThere) {
  tick();
  EXPECT_EQ(bench.state.below, 101);
  EXPECT_EQ(bench.state.lead_to, 100);
  auto robot = bench.tick();
  const Vec2 u = lead(robot);
  EXPECT_GT(u.y, 0.9F);
  EXPECT_LT(std::abs(u.x), 0.1F);
}

TEST_F(Leader, IsOnlyTheTopmostOfItsBranch) {
  bench.say(5).below = 101;
  tick();
  EXPECT_EQ(bench.state.lead_to, nobody);
}

TEST_F(Leader, IsDoneOnceItsBranchBeginsAtTheHost) {
  bench.say(5).above = 100;
  tick();
  EXPECT_EQ(bench.state.lead_to, nobody);
}

TEST_F(Leader, HasNoBranchOfItsOwnAtAJunction) {
  auto& other = put(8, {0.6F, -0.6F}, 102);
  other.parent = 1;
  tick();
  EXPECT_EQ(bench.state.below, nobody);
  EXPECT_EQ(bench.state.lead_to, nobody);
}

TEST_F(Leader, StepsToTheNextRobotOnTheWay) {
  for (int t = 0; t < 60 && bench.state.parent == 5; ++t) {
    for (const RobotId id : {RobotId{5}, RobotId{6}}) ++bench.say(id).seqno;
    bench.say(5).task_serves = 101;  // the plan keeps being told
    bench.say(5).task_host = 100;
    bench.step();
  }
  EXPECT_EQ(bench.state.parent, 6);
}

TEST_F(Leader, AsksForASpareWhenItIsHeldBack) {
  bench.move(5, {-0.875F, 0});
  tick();
  EXPECT_FALSE(is_held_back(bench.tick()));
  for (int t = 0; t < 80; ++t) tick();
  EXPECT_TRUE(is_held_back(bench.tick()));
  EXPECT_EQ(bench.step().message.need, Need::need);
}

}  // namespace
}  // namespace banyan
