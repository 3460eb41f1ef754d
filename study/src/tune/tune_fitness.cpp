// SPDX-License-Identifier: MIT
// From rows of the table of runs to one number, the paper's two-step performance or a graded one.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "banyan/record/table.hpp"
#include "banyan/study/statistics.hpp"
#include "banyan/study/tune.hpp"
#include "tune_point.hpp"

namespace banyan::study {
namespace {

std::size_t column(std::string_view name) {
  const auto columns = record::run_columns();
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
  return static_cast<std::size_t>(found - columns.begin());
}

// The number in a cell; nothing if there is none, or no finite one.
std::optional<double> number_in(const std::vector<std::string>& cells, std::string_view name) {
  const auto at = column(name);
  if (at >= cells.size()) return std::nullopt;
  const std::string& text = cells[at];
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// How far these parameters are from 0 < A < E < S < delta < C, in units of C; nothing if they keep it.
std::optional<double> disorder(const Algorithm& algorithm, const Setup& setup) {
  const auto rows = algorithm.parameters();
  const auto values = algorithm.values(setup);
  const auto value = [&](std::string_view key) {
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const ParameterInfo* info) { return info->key == key; });
    return row == rows.end() ? std::numeric_limits<float>::quiet_NaN()
                             : values[static_cast<std::size_t>(row - rows.begin())];
  };
  constexpr std::string_view ascending[] = {"avoidance_range", "recruitment_distance", "safe_range", "ideal_distance"};
  std::vector<std::pair<float, float>> ordered;
  for (std::size_t k = 1; k < std::size(ascending); ++k)
    ordered.emplace_back(value(ascending[k - 1]), value(ascending[k]));
  ordered.emplace_back(value(ascending[std::size(ascending) - 1]), 1.0F);
  std::optional<double> sum;
  for (const auto& [smaller, larger] : ordered) {
    if (!(smaller >= larger)) continue;  // in order, or the algorithm has no such length
    sum = sum.value_or(0.0) + static_cast<double>(smaller - larger);
  }
  return sum;
}

bool has_fault(const TunePlan& plan, const world::Scenario& world, std::span<const double> point) {
  const auto scenario = with_parameters(world, plan.bounds, point);
  return !world::algorithm_of(scenario).fault(world::setup_of(scenario)).empty();
}

// For parameters that do not fit together: how far, as a share, to move towards the untuned ones until they fit;
// nothing if not even these fit. So an algorithm need not say which rule they break.
std::optional<double> way_back(const TunePlan& plan, const world::Scenario& world, std::span<const double> point) {
  const auto home = plan.initial.empty() ? untuned_point(plan) : plan.initial;
  if (has_fault(plan, world, home)) return std::nullopt;
  double out = 0.0, back = 1.0;
  for (int halving = 0; halving < 20; ++halving) {
    const double middle = 0.5 * (out + back);
    std::vector<double> between;
    for (std::size_t k = 0; k < home.size(); ++k) between.push_back(point[k] + middle * (home[k] - point[k]));
    (has_fault(plan, world, between) ? out : back) = middle;
  }
  return back;
}

}  // namespace

std::optional<Trial> trial_of(std::string_view run_csv_row) {
  const auto row = record::run_cells(run_csv_row);
  if (!row) return std::nullopt;
  const auto& cells = *row;
  const std::string& complete = cells[column("complete")];
  // Of the ticks rather than of the rounded ratio: a single broken tick of a long run counts.
  const auto ticks = number_in(cells, "ticks"), broken = number_in(cells, "broken_ticks"),
             split = number_in(cells, "split_ticks"), time = number_in(cells, "normalized_time"),
             done_s = number_in(cells, "completion_time_s"), held = number_in(cells, "held_ratio"),
             committed = number_in(cells, "committed"), robots = number_in(cells, "robots");
  if (!ticks || !broken || !split || !time || !held || !committed || !robots) return std::nullopt;
  if (complete != "true" && complete != "false") return std::nullopt;
  Trial trial;
  trial.complete = complete == "true";
  if (trial.complete && !done_s) return std::nullopt;
  trial.disconnected = *ticks > 0.0 ? std::min(std::max(*broken, *split) / *ticks, 1.0) : 0.0;
  trial.normalized_time = std::clamp(*time, 0.0, 1.0);
  trial.completion_time_s = trial.complete ? *done_s : 0.0;
  trial.held = std::clamp(*held, 0.0, 1.0);
  trial.committed = *robots > 0.0 ? std::min(*committed / *robots, 1.0) : 1.0;
  return trial;
}

std::string_view name_of(Judgement judgement) noexcept {
  return judgement == Judgement::graded ? "graded" : "two-step";
}

double Fitness::of(const Merit& merit) const noexcept {
  return merit.infeasible > 0.0 ? -merit.infeasible : of_goals(goals(merit));
}

Fitness::Goals Fitness::goals(const Merit& merit) const noexcept {
  if (judgement == Judgement::two_step) return {merit.disconnected, merit.time};
  const double others = weights.held + weights.disconnected + weights.committed;
  const double cost = weights.held * (1.0 - merit.held) + weights.disconnected * merit.disconnected +
                      weights.committed * merit.committed;
  return {others > 0.0 ? cost / others : 0.0, merit.time};
}

double Fitness::of_goals(const Goals& goals) const noexcept {
  const auto [first, time] = goals;
  if (judgement == Judgement::two_step) return first > 0.0 ? 1.0 - first : 2.0 - time;
  const double others = weights.held + weights.disconnected + weights.committed;
  return 1.0 - (others * first + weights.time * time) / (others + weights.time);
}

std::array<std::string_view, 2> Fitness::goal_names() const noexcept {
  return {judgement == Judgement::graded ? "cost" : "disconnected_time_ratio", "normalized_time"};
}

Merit merit_of(std::span<const Trial> trials) noexcept {
  Merit merit{0.0, 0.0, 0.0, 0.0, 0.0};
  for (const auto& trial : trials) {
    merit.disconnected += trial.disconnected;
    merit.time += trial.normalized_time;
    merit.held += trial.held;
    merit.committed += trial.committed;
  }
  for (double* sum : {&merit.disconnected, &merit.time, &merit.held, &merit.committed})
    *sum /= static_cast<double>(trials.size());
  return merit;
}

double infeasibility(const TunePlan& plan, std::span<const double> point) {
  constexpr double least = 1e-6;  // two parameters that should differ are equal
  double worst = 0.0;
  for (const auto& world : plan.worlds) {
    const auto scenario = with_parameters(world.scenario, plan.bounds, point);
    const Algorithm& algorithm = world::algorithm_of(scenario);
    const Setup setup = world::setup_of(scenario);
    if (algorithm.fault(setup).empty()) continue;
    auto distance = disorder(algorithm, setup);
    if (!distance) distance = way_back(plan, world.scenario, point);
    worst = std::max(worst, distance ? std::max(*distance / (1.0 + *distance), least) : 1.0);
  }
  return worst;
}

TuneScore score_of(std::span<const Trial> trials) {
  TuneScore score;
  score.merit = merit_of(trials);
  score.trials = trials.size();
  std::vector<double> times_s;  // a run that was never complete is later than all
  std::size_t complete = 0, disconnected = 0;
  for (const auto& trial : trials) {
    times_s.push_back(trial.complete ? trial.completion_time_s : std::numeric_limits<double>::infinity());
    if (trial.complete) ++complete;
    if (trial.disconnected > 0.0) ++disconnected;
  }
  const auto count = static_cast<double>(trials.size());
  score.complete_share = static_cast<double>(complete) / count;
  score.disconnected_share = static_cast<double>(disconnected) / count;
  std::sort(times_s.begin(), times_s.end());
  // Infinite, or of two infinite ones NaN.
  if (const double median = quantile(times_s, 0.5); std::isfinite(median)) score.median_time_s = median;
  return score;
}

}  // namespace banyan::study
