// SPDX-License-Identifier: MIT
#include "graph_watch.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

#include "banyan/measure/fiedler.hpp"
#include "living_graph.hpp"

namespace banyan::measure {
namespace {

constexpr double low_fiedler = 1e-3;           // paper Sec. IV-B
constexpr std::size_t every_tick_limit = 150;  // robots up to which lambda_2 is judged at every tick
constexpr double sample_period_drives = 0.2;   // above that

// For each robot a number at least as large as its hops from the first living one. As long as every other robot
// has a link to one with a smaller number, all are connected.
class HopCount {
 public:
  // As they have just been counted.
  void renew(const world::World& world, std::span<const std::uint32_t> hops_of_living) {
    hops_.assign(world.size(), 0);
    nearer_.assign(world.size(), 0);
    first_ = world.size();
    auto hops = hops_of_living.begin();
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.alive()[i] == 0) continue;
      first_ = std::min(first_, i);
      hops_[i] = *hops++;
    }
  }
  void forget() noexcept { hops_.clear(); }
  // Whether all robots are still connected; false if that is not certain. A robot that has lost its link to one with a
  // smaller number gets a larger one, and so may those that relied on it; if this spreads, counting again is cheaper.
  [[nodiscard]] bool holds(const world::World& world) {
    constexpr int most_rounds = 5;
    const auto alive = world.alive();
    if (hops_.empty() || alive[first_] == 0) return false;
    for (int round = 0; round < most_rounds; ++round) {
      bool raised = false;
      for (std::size_t i = 0; i < hops_.size(); ++i) {
        if (alive[i] == 0 || i == first_) continue;
        const auto links = world.links(i);
        if (has_nearer(links, i)) continue;
        if (links.empty()) return false;
        hops_[i] = hops_[links[nearer_[i]]] + 1;
        raised = true;
      }
      if (!raised) return true;
    }
    return false;
  }
  [[nodiscard]] std::uint32_t farthest() const { return *std::max_element(hops_.begin(), hops_.end()); }

 private:
  // If not, nearer_[i] is still the place of the nearest one. Usually it is where it was.
  [[nodiscard]] bool has_nearer(std::span<const std::uint32_t> links, std::size_t i) {
    if (nearer_[i] < links.size() && hops_[links[nearer_[i]]] < hops_[i]) return true;
    const auto nearer = std::min_element(links.begin(), links.end(),
                                         [&](std::uint32_t a, std::uint32_t b) { return hops_[a] < hops_[b]; });
    nearer_[i] = static_cast<std::uint32_t>(nearer - links.begin());
    return nearer != links.end() && hops_[*nearer] < hops_[i];
  }
  std::vector<std::uint32_t> hops_;    // by robot; empty: not connected
  std::vector<std::uint32_t> nearer_;  // by robot: place of a nearer robot in its row of links
  std::size_t first_ = 0;
};

// lambda_2 >= 4 / (n diameter) (Mohar 1991), and diameter <= 2 eccentricity.
bool is_high(std::size_t n, std::uint32_t eccentricity) {
  return 4.0 / (static_cast<double>(n) * 2.0 * std::max(1.0, static_cast<double>(eccentricity))) >= low_fiedler;
}

struct LambdaStopped : std::exception {};  // while lambda_2 was computed

// lambda_2 of one graph over a run: components at every tick, the threshold as often as it pays.
struct Spectrum {
  Fiedler fiedler;
  bool low = false;
  std::uint32_t components = 0;

  void judge(const Graph& graph, bool sample) {
    const Fiedler::Components found = fiedler.components(graph);
    components = found.count;
    if (found.count > 1) low = true;
    else if (is_high(graph.size(), found.eccentricity)) low = false;
    else if (sample) judge_value(graph);
  }
  // If it was stopped, the result stays what it was.
  void judge_value(const Graph& graph) {
    try {
      low = fiedler.below(graph, low_fiedler);
    } catch (const LambdaStopped&) {  // NOLINT(bugprone-empty-catch)
    }
  }
  [[nodiscard]] double value(const Graph& graph) {
    try {
      return fiedler.value(graph);
    } catch (const LambdaStopped&) { return -1.0; }
  }
  void stop_when(const std::function<bool()>& asked) {
    fiedler.on_pause([asked] {
      if (asked()) throw LambdaStopped{};
    });
  }
};

}  // namespace

struct GraphWatch::Impl {
  explicit Impl(const world::World& start)
      : sample_ticks(std::max<std::uint64_t>(
            1, static_cast<std::uint64_t>(
                   sample_period_drives * world::drive_s(start.scenario()) / start.scenario().tick_s + 0.5))) {}

  // The graph itself is examined only if what is known of it does not decide the question.
  void judge_links(const world::World& world, std::uint32_t alive, bool sample, bool exact_fiedler) {
    if (!exact_fiedler && hop_count.holds(world)) {
      with_occlusion.components = 1;
      const bool high = (sample || with_occlusion.low) && is_high(alive, hop_count.farthest());
      if (high) with_occlusion.low = false;
      if (high || !(sample || with_occlusion.low)) return;
    }
    graph.build(world);
    with_occlusion.judge(graph.graph, sample);
    if (with_occlusion.components == 1) hop_count.renew(world, with_occlusion.fiedler.hops());
    else hop_count.forget();
  }

  std::uint64_t sample_ticks;
  LivingGraph graph;
  Spectrum with_occlusion, by_distance;
  HopCount hop_count;
};

GraphWatch::GraphWatch(const world::World& start) : impl_(std::make_unique<Impl>(start)) {}
GraphWatch::GraphWatch(GraphWatch&&) noexcept = default;
GraphWatch& GraphWatch::operator=(GraphWatch&&) noexcept = default;
GraphWatch::~GraphWatch() = default;

void GraphWatch::look(const world::World& world, bool exact_fiedler, Tick& tick) {
  Impl& of = *impl_;
  const bool sample = tick.alive <= every_tick_limit || world.tick() % of.sample_ticks == 1;
  of.judge_links(world, tick.alive, sample, exact_fiedler);
  tick.components = of.with_occlusion.components;
  tick.fiedler_low = of.with_occlusion.low;
  tick.fiedler = exact_fiedler ? of.with_occlusion.value(of.graph.graph) : -1.0;
  // More edges never lower lambda_2, nor do they split a graph.
  tick.components_by_distance = tick.components;
  tick.fiedler_low_by_distance = tick.fiedler_low;
  if (tick.components == 1 && !tick.fiedler_low) return;
  const auto blocked = world.blocked();
  if (blocked.empty()) return;
  of.graph.build_by_distance(world, blocked);
  of.by_distance.judge(of.graph.graph, sample);
  tick.components_by_distance = of.by_distance.components;
  tick.fiedler_low_by_distance = of.by_distance.low;
}

void GraphWatch::stop_when(const std::function<bool()>& asked) {
  impl_->with_occlusion.stop_when(asked);
  impl_->by_distance.stop_when(asked);
}

}  // namespace banyan::measure
