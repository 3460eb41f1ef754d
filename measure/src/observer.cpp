// SPDX-License-Identifier: MIT
#include "banyan/measure/observer.hpp"

#include <cmath>
#include <tuple>

#include "tick_watch.hpp"

namespace banyan::measure {
namespace {

template <class... Metric>
std::tuple<Metric...> begun(const world::World& start, Run& run, std::tuple<Metric...>* /*metrics*/) {
  return {Metric(start, run)...};
}

}  // namespace

struct Observer::Impl {
  explicit Impl(const world::World& start)
      : watch(start),
        metrics(begun(start, run, static_cast<Metrics*>(nullptr))),
        pending_kills(start.pending_kills()) {}

  TickWatch watch;
  Tick tick;
  Run run;
  Metrics metrics;
  bool pending_kills;
};

Observer::Observer(const world::World& world)
    : impl_(std::make_unique<Impl>(world)),
      stop_when_complete_(world.scenario().mission.stop_when_complete),
      settle_s_(world.scenario().mission.settle_s),
      rounding_s_(world::time_rounding_s(world.scenario())) {}
Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;
Observer::~Observer() = default;

const Tick& Observer::observe(const world::World& world, bool exact_fiedler) {
  Impl& of = *impl_;
  of.watch.look(world, exact_fiedler, of.tick);
  const Moment now{world, of.tick, of.watch.holders(), of.run};
  std::apply([&](auto&... metric) { (metric.observe(now, of.run), ...); }, of.metrics);
  of.pending_kills = world.pending_kills();
  return of.tick;
}

void Observer::stop_when(const std::function<bool()>& asked) { impl_->watch.stop_when(asked); }

const Tick& Observer::last() const noexcept { return impl_->tick; }
const Run& Observer::run() const noexcept { return impl_->run; }

// Without deaths: complete, or the limit. With deaths, those of a complete run are all waited for,
// since every moment of the mission has come; those of a run that is not complete at its limit may
// wait for a moment that never comes.
bool Observer::finished() const noexcept {
  const Run& run = impl_->run;
  const bool settled = std::get<Deaths>(impl_->metrics).settled();
  const bool limit_reached = run.time_s >= run.time_limit_s - rounding_s_;
  if (!stop_when_complete_) return limit_reached;
  if (!run.complete) return limit_reached && settled;
  return run.time_s >= run.completion_time_s + settle_s_ - rounding_s_ && !impl_->pending_kills && settled;
}

Run Observer::result(const world::World& world) const {
  Run run = impl_->run;
  const Moment end{world, impl_->tick, impl_->watch.holders(), run};
  std::apply([&](auto&... metric) { (metric.sum_up(end, run), ...); }, impl_->metrics);
  return run;
}

Tick at_start(const world::World& world, bool exact_fiedler) { return Observer(world).observe(world, exact_fiedler); }

bool is_plotted(const world::World& world) noexcept {
  constexpr std::size_t most_robots = 1000;
  const world::Scenario& scenario = world.scenario();
  const double period_s = 0.1 * world::drive_s(scenario);
  const auto period = [&](std::uint64_t tick) {
    return std::floor((static_cast<double>(tick) * scenario.tick_s + world::time_rounding_s(scenario)) / period_s);
  };
  return world.size() <= most_robots && (world.tick() == 0 || period(world.tick()) > period(world.tick() - 1));
}

}  // namespace banyan::measure
