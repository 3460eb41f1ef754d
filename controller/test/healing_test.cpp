// SPDX-License-Identifier: MIT
// Whoever falls silent is replaced: root, workers, and the way back to the others.
#include "banyan/controller/healing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "banyan/controller/edge_frame.hpp"
#include "banyan/controller/motion.hpp"
#include "bench.hpp"

namespace banyan {
namespace {

constexpr RobotId root_id = 9;

// A robot of a grown tree with its root in sight; the root counts ticks.
struct Watch {
  Bench bench = grown(convoy());
  std::uint16_t count = 100;
  explicit Watch(Vec2 root = {0.5F, 0.0F}) {
    Message& m = bench.put(root_id, root);
    m.role = Role::root;
    m.depth = 1;
    m.tree_hops = 0;
    m.label_cm = 0;
    m.committed = true;
  }
  void hear_root(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      bench.say(root_id).heartbeat = count++;
      bench.step();
    }
  }
  // The neighbour serves a target at `target` (my frame) and counts `beat`.
  void tell_of_target(RobotId sender, Vec2 at, Vec2 target, RobotId serves, std::uint16_t beat) {
    Message& m = bench.put(sender, at);
    m.root = bench.state.root;
    const Vec2 v = rotate_back(unit(-at), target);
    m.told = bench.state.id;
    m.task_serves = serves;
    m.task_holder = serves;
    m.task_beat = beat;
    m.task_x_cm = static_cast<std::int16_t>(std::lround(v.x * 100.0F));
    m.task_y_cm = static_cast<std::int16_t>(std::lround(v.y * 100.0F));
  }
};

int claim_ticks(const Bench& bench, float away_m) {
  const Params& p = bench.params;
  return 2 * p.ticks(p.liveness_period_s) + p.ticks(p.claim_after_s + p.claim_spread_s_m * away_m);
}

// ---- Loss ----

RC_GTEST_PROP(Loss, LivenessFollowsTheShareOfPacketsLost, ()) {
  const float loss = static_cast<float>(*rc::gen::inRange(20, 80)) * 0.01F;
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  Bench bench = grown(convoy());
  for (int tick = 0; tick < 500; ++tick) {
    for (RobotId id = 20; id < 40; ++id) {
      bench.silence(id);
      if (static_cast<float>(random() % 10000) >= loss * 10000.0F) bench.put(id, {0.05F * static_cast<float>(id), 1.0F});
    }
    bench.step();
  }
  const float wanted = std::log(1e-5F) / std::log(loss);
  RC_ASSERT(static_cast<float>(bench.state.liveness_ticks) > 0.75F * wanted);
  RC_ASSERT(static_cast<float>(bench.state.liveness_ticks) < 1.35F * wanted + 2.0F);
}

TEST(Loss, NobodyWaitsLongerWhereNothingIsLost) {
  Watch watch;
  for (RobotId id = 20; id < 24; ++id) watch.bench.put(id, {0.1F * static_cast<float>(id), 0.5F});
  watch.hear_root(200);
  watch.bench.silence(20);  // a death is no loss
  watch.hear_root(3);
  EXPECT_LE(watch.bench.state.liveness_ticks, watch.bench.params.ticks(watch.bench.params.liveness_period_s));
}

// ---- Heartbeat ----

TEST(Loss, AConnectorWaitsForItsChildAsLongAsAPacketMayBeLost) {
  const auto ticks_as_connector = [](std::uint16_t liveness_ticks) {
    Bench bench = grown(convoy());
    bench.state.role = Role::connector;
    bench.state.liveness_ticks = liveness_ticks;
    int ticks = 0;
    for (; bench.state.role == Role::connector && ticks < 1000; ++ticks) {
      Robot robot = bench.tick();
      update_role(robot);
    }
    return ticks;
  };
  EXPECT_EQ(ticks_as_connector(0), 11);  // connector_patience_s, and the tick in which it is over
  EXPECT_EQ(ticks_as_connector(66), 67);
}

TEST(Heartbeat, OnlyALargerCountIsASignOfLife) {
  Watch watch;
  watch.hear_root(5);
  EXPECT_EQ(watch.bench.state.silence_ticks, 0);
  watch.bench.steps(7);  // the same count again and again
  EXPECT_EQ(watch.bench.state.silence_ticks, 7);
  watch.bench.say(root_id).heartbeat = static_cast<std::uint16_t>(watch.count - 3);
  watch.bench.step();
  EXPECT_EQ(watch.bench.state.silence_ticks, 8);
  watch.hear_root(1);
  EXPECT_EQ(watch.bench.state.silence_ticks, 0);
}

TEST(Heartbeat, CountsGoRound) {
  Watch watch;
  watch.count = 65530;
  watch.hear_root(20);
  EXPECT_EQ(watch.bench.state.silence_ticks, 0);
  EXPECT_EQ(watch.bench.state.heartbeat, static_cast<std::uint16_t>(watch.count - 1));
}

TEST(Heartbeat, TheRootItselfBeats) {
  Bench bench(convoy());
  bench.state = initial_state(1, false, true);
  const std::uint16_t before = bench.step().message.heartbeat;
  EXPECT_EQ(bench.step().message.heartbeat, before + 1);
  EXPECT_EQ(bench.state.silence_ticks, 0);
}

// ---- Points told: exact although both move and turn between writing and reading ----

RC_GTEST_PROP(Telling, APointArrivesWhereItIs, ()) {
  const auto number = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)) * 0.001F; };
  const auto rotation = [&] { const float a = number(-3141, 3142); return Vec2{std::cos(a), std::sin(a)}; };
  // World coordinates: the sender writes at t, the reader has moved by `odometry` at t + 1.
  const Vec2 sender{number(300, 1800), number(-900, 900)};
  const Vec2 sender_heading = rotation();
  const Vec2 reader_heading = rotation();
  const Vec2 point{number(-9000, 9000), number(-9000, 9000)};
  const Odometry odometry{number(0, 20), 0.0F, number(-400, 400)};
  // Written as telling.cpp does: point - addressee, in the sender's frame, in the edge frame.
  const Vec2 addressee = rotate_back(sender_heading, -sender);
  const Vec2 v = to_edge_frame(rotate_back(sender_heading, point - sender) - addressee, addressee);

  Bench bench = grown(convoy());
  bench.put(5, rotate_back(reader_heading, sender));
  bench.tick();
  const Vec2 reader = rotate(reader_heading, {odometry.forward_m, 0.0F});
  const Vec2 heading = rotate(reader_heading, {std::cos(odometry.turn_rad), std::sin(odometry.turn_rad)});
  const Vec2 sender_moved = sender + Vec2{0.02F, -0.01F};
  bench.move(5, rotate_back(heading, sender_moved - reader));
  bench.tick(odometry);

  Vec2 read;
  const auto cm = [](float x) { return static_cast<std::int16_t>(std::lround(x * 100.0F)); };
  RC_ASSERT(bench.state.neighbors.read_point(bench.state.neighbors.find(5), cm(v.x), cm(v.y), read));
  RC_ASSERT(distance(read, rotate_back(heading, point - reader)) < 0.012F);
}

TEST(Telling, NoPointFromWhomIHaveNotHeardTheTickBefore) {
  Bench bench = grown(convoy());
  bench.put(5, {1.0F, 0.0F});
  bench.tick();
  Vec2 point;
  EXPECT_FALSE(bench.state.neighbors.read_point(0, 100, 0, point));
  bench.tick();
  EXPECT_TRUE(bench.state.neighbors.read_point(0, 100, 0, point));
}

TEST(Telling, EveryPairOfNeighbourAndTargetHasItsTurn) {
  Watch watch;
  watch.tell_of_target(20, {1.0F, 0.0F}, {3.0F, 0.0F}, 50, 1);
  watch.bench.steps(2);
  watch.tell_of_target(21, {0.0F, 1.0F}, {0.0F, 3.0F}, 51, 1);
  watch.bench.steps(2);
  ASSERT_EQ(watch.bench.state.task_count, 2);
  watch.bench.put(22, {0.0F, -1.0F});
  watch.bench.step();
  std::map<std::pair<RobotId, RobotId>, int> told;
  for (int k = 0; k < 8; ++k) {
    const Message m = watch.bench.step().message;
    ++told[{m.told, m.task_serves}];
  }
  EXPECT_EQ(told.size(), 8U);  // 4 neighbours, 2 targets
}

// ---- Election ----

TEST(Election, WhoIsNearClaimsAfterItsTurnAndOpensAnEpoch) {
  Watch watch;
  watch.hear_root(200);
  watch.bench.silence(root_id);
  State& state = watch.bench.state;
  watch.bench.steps(claim_ticks(watch.bench, 0.5F));
  EXPECT_EQ(state.tally.elections, 0U);
  watch.bench.step();
  EXPECT_EQ(state.tally.elections, 1U);
  EXPECT_EQ(state.root, (RootToken{2, state.id}));
  EXPECT_EQ(state.role, Role::root);
  EXPECT_EQ(state.epoch, 2);
  EXPECT_EQ(state.phase, Phase::start_tree);
}

// Two that may claim hear each other: so two fragments never keep a root each at one place.
TEST(Election, TheCircleOfClaimantsIsSmallerThanTheRange) {
  const Params p = convoy().defaults(Reading::corrected);
  EXPECT_LT(2.0F * p.claim_radius, 1.0F);
}

TEST(Election, NeitherTheFarNorWorkersNorTheLiteralClaim) {
  for (const int who : {0, 1, 2}) {
    Watch watch(who == 0 ? Vec2{1.5F, 0.0F} : Vec2{0.3F, 0.0F});
    if (who == 2) watch.bench.params.reading = Reading::literal;
    watch.hear_root(3);
    watch.bench.state.is_worker = who == 1;
    if (who == 0) watch.bench.state.root_at = {1.5F, 0.0F};
    watch.bench.silence(root_id);
    watch.bench.steps(30);
    EXPECT_EQ(watch.bench.state.tally.elections, 0U) << who;
  }
}

TEST(Election, ARootThatHearsOfALaterEpochOpensItsOwn) {
  Bench bench = grown(convoy());
  bench.state.root = {3, bench.state.id};
  Message& m = bench.put(20, {1.0F, 0.0F});
  m.root = {2, 77};
  m.epoch = 6;
  m.phase = Phase::grow_tree;
  bench.step();
  EXPECT_EQ(bench.state.epoch, 7);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
}

TEST(Election, TheLesserOfTwoRootsSteps) {
  Bench bench = grown(convoy());
  bench.state.root = {3, bench.state.id};
  bench.state.role = Role::root;
  bench.put(20, {1.0F, 0.0F}).root = {3, 77};
  bench.step();
  EXPECT_NE(bench.state.role, Role::root);
  EXPECT_EQ(bench.state.root, (RootToken{3, 77}));
}

// ---- Succession ----

int succession_ticks(const Bench& bench, float away_m) {
  const Params& p = bench.params;
  return 2 * p.ticks(p.liveness_period_s) + p.ticks(p.succession_after_s + p.succession_spread_s_m * away_m);
}

TEST(Succession, ASpareTakesOverTheTargetOfAWorkerThatFellSilent) {
  Watch watch;
  watch.hear_root(2);
  const Vec2 target{2.0F, 1.0F};
  for (std::uint16_t beat = 10; beat < 15; ++beat) {
    watch.tell_of_target(20, {1.0F, 0.0F}, target, 50, beat);
    watch.hear_root(1);
  }
  State& state = watch.bench.state;
  watch.hear_root(succession_ticks(watch.bench, norm(target)) - 1);
  EXPECT_EQ(state.tally.replacements, 0U);
  watch.hear_root(3);
  EXPECT_EQ(state.tally.replacements, 1U);
  EXPECT_TRUE(state.is_worker);
  EXPECT_EQ(state.serves, 50);
  EXPECT_GT(state.want_m, 1.5F);  // it knows where to go without being told from outside
}

TEST(Succession, OfASilentWorkersTargetTheMeanIsRemembered) {
  Watch watch;
  watch.hear_root(2);
  const float patience_s = watch.bench.params.succession_after_s;
  watch.bench.params.succession_after_s = 1000.0F;
  watch.tell_of_target(20, {1.0F, 0.0F}, {2.0F, 0.0F}, 50, 10);
  watch.hear_root(2);
  EXPECT_NEAR(watch.bench.state.tasks[0].target.x, 2.0F, 0.01F) << "the worker alive, as it is told";
  watch.hear_root(watch.bench.params.ticks(patience_s) + 40);
  watch.tell_of_target(20, {1.0F, 0.0F}, {3.0F, 0.0F}, 50, 10);
  watch.hear_root(1);
  EXPECT_GT(watch.bench.state.tasks[0].target.x, 2.05F);
  EXPECT_LT(watch.bench.state.tasks[0].target.x, 2.5F);
}

TEST(Succession, WhoBeatsIsNotReplaced) {
  Watch watch;
  watch.hear_root(2);
  for (std::uint16_t beat = 10; beat < 150; ++beat) {
    watch.tell_of_target(20, {1.0F, 0.0F}, {2.0F, 1.0F}, 50, beat);
    watch.hear_root(1);
  }
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
}

TEST(Succession, ATargetThatWasGivenUpHasNoSuccessor) {
  Watch watch;
  watch.hear_root(2);
  watch.tell_of_target(20, {1.0F, 0.0F}, {2.0F, 1.0F}, 50, 10);
  watch.hear_root(3);
  watch.bench.say(20).task_holder = nobody;
  watch.bench.say(20).task_beat = 80;
  watch.hear_root(120);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
}

TEST(Succession, AWorkerRelievedFromOutsideSaysSo) {
  Bench bench = grown(convoy());
  const Vec2 target{2.0F, 0.0F};
  bench.state = initial_state(1, true, false);
  bench.target = &target;
  bench.put(20, {1.0F, 0.0F});
  bench.steps(3);
  bench.state.is_worker = false;
  bench.state.serves = nobody;
  bench.target = nullptr;
  const Message m = bench.step().message;
  EXPECT_EQ(m.task_serves, 1);
  EXPECT_EQ(m.task_holder, nobody);
}

// Two successors with equal counts, each hearing what the other said a tick ago.
RC_GTEST_PROP(Succession, OfTwoRivalsOneStays, ()) {
  const RobotId serves = *rc::gen::element<RobotId>(1, 2, 50);
  std::array<Bench, 2> pair{grown(convoy()), grown(convoy())};
  for (int i : {0, 1}) {
    State& s = pair[i].state;
    s.id = static_cast<RobotId>(i + 1);
    s.is_worker = true;
    s.role = Role::worker;
    s.serves = serves;
    s.task_count = 1;
    s.tasks[0] = {serves, s.id, static_cast<std::uint16_t>(65530 + *rc::gen::inRange(0, 20)), 0, {3.0F, 0.0F}};
  }
  std::array<Message, 2> said{pair[0].step().message, pair[1].step().message};
  for (int tick = 0; tick < 60; ++tick) {
    std::array<Message, 2> next;
    for (int i : {0, 1}) {
      pair[i].put(static_cast<RobotId>(2 - i), {1.0F, 0.0F}) = said[1 - i];
      next[i] = pair[i].step().message;
    }
    said = next;
  }
  const bool second_first = serves == 2;
  RC_ASSERT(pair[0].state.is_worker == !second_first);
  RC_ASSERT(pair[1].state.is_worker == second_first);
}

// ---- Retreat ----

TEST(Retreat, WhoHearsOfNoRootDrivesToWhereItWas) {
  Watch watch({1.9F, 0.0F});
  watch.hear_root(200);
  watch.bench.state.root_at = {6.0F, 0.0F};
  watch.bench.silence(root_id);
  const Params& p = watch.bench.params;
  watch.bench.steps(p.ticks(p.retreat_after_s) + 2 * p.ticks(p.liveness_period_s) + 1);
  Robot robot = watch.bench.tick();
  EXPECT_TRUE(is_retreating(robot));
  EXPECT_GT(retreat_motion(robot).x, 0.9F);
  EXPECT_GT(move(robot).forward_m_s, 0.15F);
  watch.bench.put(root_id, {1.9F, 0.0F}).heartbeat = watch.count;
  watch.bench.step();
  Robot back = watch.bench.tick();
  EXPECT_FALSE(is_retreating(back));
}

TEST(Retreat, TheSilentHoldNobodyBack) {
  Watch watch({-1.9F, 0.0F});
  watch.hear_root(3);
  State& state = watch.bench.state;
  state.parent = root_id;
  state.committed = true;
  watch.hear_root(2);
  state.root_at = {6.0F, 0.0F};  // as if somebody had told
  state.parent = root_id;
  watch.bench.silence(root_id);
  state.silence_ticks = 100;
  watch.bench.steps(8);
  state.parent = root_id;
  Robot robot = watch.bench.tick();
  EXPECT_GT(move(robot).forward_m_s, 0.15F);
}

// ---- The end of a torn branch ----

// A connector between the root and the only robot that hangs on it.
struct Branch : Watch {
  Branch() : Watch({-1.5F, 0.0F}) {
    State& state = bench.state;
    state.role = Role::connector;
    state.parent = root_id;
    state.label_cm = 150;
    Message& below = bench.put(3, {1.6F, 0.0F});
    below.role = Role::connector;
    below.parent = state.id;
    below.label_cm = 300;
    below.committed = true;
    hear_root(3);
  }
};

TEST(Stub, WhoLosesTheOnlyRobotBelowGoesWhereItWas) {
  Branch branch;
  Bench& bench = branch.bench;
  bench.silence(3);
  branch.hear_root(2 * bench.params.ticks(bench.params.liveness_period_s));
  EXPECT_EQ(bench.state.role, Role::connector);
  EXPECT_EQ(bench.state.parent, root_id);
  EXPECT_NEAR(bench.state.want_m, 1.6F, 0.05F) << "its chain comes along";
  EXPECT_GT(bench.step().velocity.forward_m_s, 0.0F);
  branch.hear_root(bench.params.ticks(20.0F));
  EXPECT_EQ(bench.state.role, Role::spare) << "nobody came";
}

TEST(Stub, NotForOneThatLeftOrWhileAnotherHangsOnIt) {
  Branch left;
  left.bench.say(3).parent = root_id;
  left.hear_root(1);
  left.bench.silence(3);
  left.hear_root(30);
  EXPECT_EQ(left.bench.state.role, Role::spare);
  Branch other;
  Message& m = other.bench.put(4, {0.0F, 1.0F});
  m = other.bench.say(3);
  m.id = 4;
  other.hear_root(2);
  other.bench.silence(3);
  other.hear_root(30);
  EXPECT_EQ(other.bench.state.stub_ticks, 0);
}

// ---- Two fragments, each with a root, meet ----

struct Swarm {
  Params params = convoy().defaults(Reading::corrected);
  std::vector<State> states;
  std::vector<Vec2> places;
  std::vector<Message> said;
  void add(RobotId id, Vec2 place, RootToken root) {
    states.push_back(initial_state(id, false, root.id == id));
    if (root.id == id) states.back().root = root;
    places.push_back(place);
    said.emplace_back();
  }
  void steps(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      std::vector<Message> next = said;
      for (std::size_t k = 0; k < states.size(); ++k) {
        std::vector<Heard> heard;
        for (std::size_t j = 0; j < states.size(); ++j)
          if (j != k && said[j].id != nobody && distance(places[j], places[k]) < params.communication_range_m) heard.push_back({&said[j], places[j] - places[k]});
        next[k] = step(params, convoy(), states[k], heard, {}, nullptr).message;
      }
      said = next;
    }
  }
  [[nodiscard]] std::vector<RobotId> roots() const {
    std::vector<RobotId> list;
    for (const State& s : states)
      if (s.root.id == s.id) list.push_back(s.id);
    return list;
  }
};

RC_GTEST_PROP(Fragments, OfTwoRootsThatMeetTheOneOfTheLargerFragmentStays, ()) {
  const int left = *rc::gen::inRange(2, 12);
  const int right = left + *rc::gen::inRange(1, 10);
  const bool swap = *rc::gen::arbitrary<bool>();
  const auto sequence = [] { return *rc::gen::inRange<std::uint16_t>(1, 9); };
  Swarm swarm;
  const int counts[] = {swap ? right : left, swap ? left : right};
  RobotId id = 1;
  RobotId larger = nobody;
  for (int side = 0; side < 2; ++side) {
    const auto root = static_cast<RobotId>(id + *rc::gen::inRange(0, counts[side]));
    const RootToken token{sequence(), root};
    if (counts[side] == right) larger = root;
    for (int k = 0; k < counts[side]; ++k) {
      const float away = 1.5F + 0.8F * static_cast<float>(k);
      swarm.add(id++, {side == 0 ? -away : away, 0.1F * static_cast<float>(k % 3)}, token);
    }
  }
  swarm.steps(120);
  RC_ASSERT(swarm.roots().size() == 2U);
  for (Vec2& place : swarm.places) place.x += place.x < 0.0F ? 1.0F : -1.0F;
  swarm.steps(50);
  for (int k = 0; k < 100; ++k) {
    swarm.steps(1);
    RC_ASSERT(swarm.roots() == std::vector<RobotId>{larger});
  }
}

// ---- A branch that does not reach ----

TEST(Regroup, AWorkerWhoseEdgeWaitsInVainDrivesHomeAndTakesAnInnerHold) {
  Watch watch({-1.5F, 0.0F});
  Bench& bench = watch.bench;
  const Vec2 target{1.0F, 0.0F};
  bench.state.is_worker = true;
  bench.state.serves = bench.state.id;
  bench.state.parent = 5;
  bench.state.label_cm = 400;
  bench.target = &target;
  Message& m = bench.put(5, {-1.85F, 0.0F});
  m.role = Role::connector;
  m.parent = root_id;
  m.depth = 2;
  m.tree_hops = 0;
  m.label_cm = 100;
  m.committed = true;
  m.child_count = 2;
  bench.move(root_id, {-1.89F, 0.6F});
  watch.hear_root(350);
  EXPECT_FALSE(is_regrouping(bench.tick()));
  EXPECT_EQ(bench.state.parent, 5);
  watch.hear_root(150);
  EXPECT_TRUE(is_regrouping(bench.tick()));
  bench.move(root_id, {-1.7F, 0.6F});
  watch.hear_root(2);
  EXPECT_EQ(bench.state.parent, root_id);
  EXPECT_FALSE(is_regrouping(bench.tick())) << "it sets out anew";
}

}  // namespace
}  // namespace banyan
