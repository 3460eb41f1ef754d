// SPDX-License-Identifier: MIT
// A host need not step once a tick: what takes a time takes it however the steps fall. Compared with the same robot
// at regular steps.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "bench.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

struct Moment {
  int ticks = 0;      // since the beginning, after the step in which it happened
  int last_step = 0;  // of that length
};

// Steps of the given lengths, over and over, until `happened`.
template <class Bench, class Happened>
Moment until(Bench bench, const std::vector<int>& lengths, const Happened& happened) {
  Moment moment;
  for (std::size_t k = 0; moment.ticks < 3000; ++k) {
    moment.last_step = lengths[k % lengths.size()];
    moment.ticks += moment.last_step;
    bench.elapsed_s = static_cast<float>(moment.last_step) * test_platform.tick_s;
    bench.step();
    if (happened(bench.state)) return moment;
  }
  ADD_FAILURE() << "has not happened";
  return moment;
}

// In the first step that ends no sooner than at regular steps.
template <class Bench, class Happened> bool takes_its_time(const Bench& bench, const Happened& happened) {
  const int regular = until(bench, {1}, happened).ticks;
  const auto lengths = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 9)));
  const Moment moment = until(bench, lengths, happened);
  return regular > 10 && moment.ticks >= regular && moment.ticks - moment.last_step < regular;
}

template <class Kind> BenchOf<Kind> root() {
  BenchOf<Kind> bench = grown<Kind>();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  return bench;
}

RC_GTEST_PROP(IrregularSteps, TheTreeIsReconstructedEveryR, ()) {
  const auto ends = [](const auto& state) { return state.phase != Phase::grow_tree; };
  RC_ASSERT(takes_its_time(root<Convoy>(), ends));
}

RC_GTEST_PROP(IrregularSteps, AConnectorWaitsForAChild, ()) {
  auto bench = grown<Convoy>();
  bench.state.role = Role::connector;
  bench.state.parent = 9;
  bench.put(9, {0.25F, 0}).committed = true;
  RC_ASSERT(takes_its_time(bench, [](const auto& state) { return state.role == Role::spare; }));
}

RC_GTEST_PROP(IrregularSteps, AnOfferOfTheTokenIsTakenBack, ()) {
  auto bench = root<Convoy>();
  bench.state.phase = Phase::select_root;
  bench.state.new_root = 5;
  RC_ASSERT(takes_its_time(bench, [](const auto& state) { return state.new_root == nobody; }));
}

RC_GTEST_PROP(IrregularSteps, AnInsertedRobotIsExpectedForAWhile, ()) {
  auto bench = grown<Convoy>();
  bench.state.inserted_child = 5;
  RC_ASSERT(takes_its_time(bench, [](const auto& state) { return state.inserted_child == nobody; }));
}

RC_GTEST_PROP(IrregularSteps, ARootThatFallsSilentIsReplaced, ()) {
  auto bench = grown<Convoy>();
  bench.put(9, {0.2F, 0}).heartbeat = 1;
  bench.say(9).role = Role::root;
  for (Serial beat = 2; beat < 6; ++beat) {
    bench.step();
    bench.say(9).heartbeat = beat;
  }
  bench.silence(9);
  RC_ASSERT(takes_its_time(bench, [](const auto& state) { return state.role == Role::root; }));
}

RC_GTEST_PROP(IrregularSteps, AConnectorLooksForALostBranchForAWhile, ()) {
  auto bench = grown<Convoy>();
  bench.params.claim_after_rounds = bench.params.retreat_after_rounds = 1000.0F;
  bench.state.role = Role::connector;
  bench.state.dangling_ticks = 60;
  bench.state.lost_child = {0.75F, 0};
  RC_ASSERT(takes_its_time(bench, [](const auto& state) { return state.dangling_ticks == 0; }));
}

}  // namespace
}  // namespace banyan
