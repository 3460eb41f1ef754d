// SPDX-License-Identifier: MIT
// Sinks are told of a run in order, and one that fails costs neither the run nor the others.
#include "banyan/record/sink.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "banyan/record/file.hpp"
#include "plain_scenario.hpp"

namespace banyan::record {
namespace {

using Notes = std::vector<std::string>;

// Notes what it is told; throws at the moment it is to fail at, "start", "tick 2" or "finish".
class Noting final : public Sink {
 public:
  Noting(Notes& notes, std::string fails_at, bool fiedler = false)
      : notes_(notes), fails_at_(std::move(fails_at)), fiedler_(fiedler) {}
  ~Noting() override { notes_.push_back("closed"); }
  void start(const world::World&) override { note("start"); }
  void tick(const world::World&, const measure::Tick& tick) override { note("tick " + std::to_string(tick.tick)); }
  void finish(const world::World&, const RunEnd& end) override { note(end.interrupted ? "interrupted" : "finish"); }
  [[nodiscard]] bool wants_fiedler(const world::World&) const override { return fiedler_; }
  [[nodiscard]] std::string rest() const override { return "rest of " + fails_at_; }

 private:
  void note(const std::string& what) {
    notes_.push_back(what);
    if (what == fails_at_) throw std::runtime_error("no more");
  }
  Notes& notes_;
  std::string fails_at_;
  bool fiedler_;
};

void tell_a_run(Sinks& sinks) {
  const world::World world{world::plain_scenario()};
  measure::Tick tick;
  sinks.start(world);
  for (tick.tick = 1; tick.tick <= 3; ++tick.tick) sinks.tick(world, tick);
  sinks.finish(world, {});
}

const Notes whole{"start", "tick 1", "tick 2", "tick 3", "finish"};

TEST(Sinks, OneThatFailsIsClosedAtOnceAndTheOthersGoOn) {
  for (std::size_t k = 0; k < whole.size(); ++k) {
    Notes before, failing, after;
    Sinks sinks;
    sinks.add("a", std::make_unique<Noting>(before, ""));
    sinks.add("b", std::make_unique<Noting>(failing, whole[k]));
    sinks.add("c", std::make_unique<Noting>(after, ""));
    tell_a_run(sinks);
    EXPECT_EQ(before, whole) << whole[k];
    EXPECT_EQ(after, whole) << whole[k];
    Notes until(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    until.emplace_back("closed");
    EXPECT_EQ(failing, until);
    ASSERT_EQ(sinks.failures().size(), 1U);
    EXPECT_EQ(sinks.failures()[0].path, "b");
    EXPECT_EQ(sinks.failures()[0].text, "b: no more");
    EXPECT_EQ(sinks.failures()[0].rest, "rest of " + whole[k]);
    EXPECT_EQ(sinks.rests().size(), 2U);  // of a and c
  }
}

TEST(Sinks, FailuresComeInTheirOrderAndNameTheFileOnce) {
  class Full final : public Sink {
    void finish(const world::World&, const RunEnd&) override { throw FileError("full", "cannot write", 28); }
  };
  Notes notes;
  Sinks sinks;
  sinks.add("full", std::make_unique<Full>());
  sinks.add("early", std::make_unique<Noting>(notes, "tick 1"));
  tell_a_run(sinks);
  ASSERT_EQ(sinks.failures().size(), 2U);
  EXPECT_EQ(sinks.failures()[0].text, "early: no more");
  EXPECT_EQ(sinks.failures()[1].text, "full: cannot write: No space left on device");
}

TEST(Sinks, WhatHasFailedWantsNothing) {
  const world::World world{world::plain_scenario()};
  Notes notes;
  Sinks sinks;
  EXPECT_FALSE(sinks.wants_fiedler(world));
  sinks.add("a", std::make_unique<Noting>(notes, ""));
  EXPECT_FALSE(sinks.wants_fiedler(world));
  sinks.add("b", std::make_unique<Noting>(notes, "start", true));
  EXPECT_TRUE(sinks.wants_fiedler(world));
  sinks.start(world);
  EXPECT_FALSE(sinks.wants_fiedler(world));
}

}  // namespace
}  // namespace banyan::record
