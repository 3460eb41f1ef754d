// SPDX-License-Identifier: MIT
#include "tune_island.hpp"

#include <algorithm>
#include <boost/math/special_functions/nonfinite_num_facets.hpp>
#include <cmath>
#include <locale>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/s11n.hpp>
#include <sstream>
#include <utility>
#include <variant>

#include "banyan/controller/core/digest.hpp"
#include "tune_point.hpp"

namespace banyan::study {
namespace {

// What pagmo minimises. Infeasible points are dominated by all feasible ones, nearer ones dominate.
pagmo::vector_double objectives_of(const Merit& merit, const TunePlan& plan) {
  if (plan.optimizer.search != Search::nsga2) return {-plan.fitness.of(merit)};
  if (merit.infeasible > 0.0) return {1.0 + merit.infeasible, 1.0 + merit.infeasible};
  const auto [first, second] = plan.fitness.goals(merit);
  return {first, second};
}

double fitness_of(const std::vector<double>& objectives, const Fitness& fitness) {
  if (objectives.size() == 1) return -objectives[0];
  if (objectives[0] > 1.0) return 1.0 - objectives[0];
  return fitness.of_goals({objectives[0], objectives[1]});
}

// Evaluates points of the unit cube that lie one after the other, all at once.
pagmo::vector_double evaluate(Evaluator& evaluator, const TunePlan& plan, const pagmo::vector_double& units) {
  const std::size_t n = plan.bounds.size();
  std::vector<std::vector<double>> points;
  for (std::size_t at = 0; at < units.size(); at += n)
    points.push_back(from_unit(plan.bounds, std::span(units).subspan(at, n)));
  pagmo::vector_double all;
  for (const auto& merit : evaluator.merits(points)) {
    const auto objectives = objectives_of(merit, plan);
    all.insert(all.end(), objectives.begin(), objectives.end());
  }
  return all;
}

// The problem as pagmo wants it; pagmo copies it, so it only points.
struct Deployment {
  Evaluator* evaluator = nullptr;
  const TunePlan* plan = nullptr;

  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& unit) const {
    return evaluate(*evaluator, *plan, unit);
  }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const std::size_t n = plan ? plan->bounds.size() : 1;
    return {pagmo::vector_double(n, 0.0), pagmo::vector_double(n, 1.0)};
  }
  // NOLINTNEXTLINE(readability-identifier-naming): pagmo's name
  [[nodiscard]] pagmo::vector_double::size_type get_nobj() const {
    return plan && plan->optimizer.search == Search::nsga2 ? 2 : 1;
  }
};

using PagmoAlgorithm = std::variant<pagmo::sga, pagmo::nsga2, pagmo::cmaes>;

// Derived from the plan's seed, different for every island and purpose.
unsigned seed_of(const TunePlan& plan, std::size_t island, unsigned purpose) {
  Digest digest;
  digest.add(plan.optimizer.seed);
  digest.add(island);
  digest.add(purpose);
  return static_cast<unsigned>(digest.value() >> 32);
}

PagmoAlgorithm make_algorithm(const TuneOptimizer& o, unsigned seed) {
  constexpr double crossover_index = 10.0, mutation_index = 20.0;  // of SBX and polynomial mutation (Deb 2002)
  constexpr unsigned tournament = 2;
  switch (o.search) {
    case Search::nsga2:
      return pagmo::nsga2(1, o.crossover_probability, crossover_index, o.mutation_probability, mutation_index, seed);
    case Search::cmaes: {
      constexpr double automatic = -1.0, never = 0.0;
      return pagmo::cmaes(1, automatic, automatic, automatic, automatic, o.step, never, never, true, true, seed);
    }
    case Search::sga: break;
  }
  return pagmo::sga(1, o.crossover_probability, crossover_index, o.mutation_probability, mutation_index, tournament,
                    "sbx", "polynomial", "tournament", seed);
}

// pagmo's cmaes has a member that it neither sets nor uses, but archives: an arbitrary value, perhaps NaN.
// These write such numbers so that they can be read again.
constexpr unsigned archive_flags = boost::archive::no_codecvt;
std::locale archive_locale() {
  const std::locale writes(std::locale::classic(), new boost::math::nonfinite_num_put<char>);
  return {writes, new boost::math::nonfinite_num_get<char>};
}

}  // namespace

// Hands nsga2's whole generations to the evaluator. Archives contain it without its pointers,
// which must be set again after reading.
class WholeGeneration {
 public:
  WholeGeneration() = default;
  WholeGeneration(Evaluator& evaluator, const TunePlan& plan) : evaluator_(&evaluator), plan_(&plan) {}
  pagmo::vector_double operator()(const pagmo::problem& /*problem*/, const pagmo::vector_double& units) const {
    return evaluate(*evaluator_, *plan_, units);
  }
  template <class Archive> void serialize(Archive& /*archive*/, unsigned /*version*/) {}

 private:
  Evaluator* evaluator_ = nullptr;
  const TunePlan* plan_ = nullptr;
};

}  // namespace banyan::study

// NOLINTBEGIN: what the macros make of it
PAGMO_S11N_BFE_EXPORT(banyan::study::WholeGeneration)
// NOLINTEND

namespace banyan::study {

struct Island::Search {
  const TunePlan& plan;
  Evaluator& evaluator;
  std::size_t index;
  PagmoAlgorithm algorithm;
  std::vector<std::vector<double>> units, objectives;

  Search(const TunePlan& p, Evaluator& e, std::size_t i)
      : plan(p), evaluator(e), index(i), algorithm(make_algorithm(p.optimizer, seed_of(p, i, 0))) {
    batch();
  }

  void batch() {
    if (auto* nsga2 = std::get_if<pagmo::nsga2>(&algorithm))
      nsga2->set_bfe(pagmo::bfe(WholeGeneration(evaluator, plan)));
  }
  // An empty one. Its seed decides the random points and otherwise nothing but names of individuals.
  [[nodiscard]] pagmo::population empty() const {
    return pagmo::population(pagmo::problem(Deployment{&evaluator, &plan}), 0, seed_of(plan, index, 1));
  }
  [[nodiscard]] std::vector<double> random_unit(const pagmo::population& population) const {
    constexpr int most_tries = 2000;
    std::vector<double> best;
    double least = 2.0;
    for (int i = 0; i < most_tries && least > 0.0; ++i) {
      auto unit = population.random_decision_vector();
      const double distance = infeasibility(plan, from_unit(plan.bounds, unit));
      if (distance < least) {
        least = distance;
        best = std::move(unit);
      }
    }
    return best;
  }
};

Island::Island(const TunePlan& plan, Evaluator& evaluator, std::size_t index)
    : search_(std::make_unique<Search>(plan, evaluator, index)) {}
Island::Island(Island&&) noexcept = default;
Island::~Island() = default;

void Island::populate() {
  auto& s = *search_;
  const auto population = s.empty();
  pagmo::vector_double all;
  while (s.units.size() < s.plan.optimizer.population) {
    const bool given = s.units.empty() && !s.plan.initial.empty();
    s.units.push_back(given ? to_unit(s.plan.bounds, s.plan.initial) : s.random_unit(population));
    all.insert(all.end(), s.units.back().begin(), s.units.back().end());
  }
  const auto objectives = evaluate(s.evaluator, s.plan, all);
  const auto each = static_cast<std::ptrdiff_t>(objectives.size() / s.units.size());
  for (auto first = objectives.begin(); first != objectives.end(); first += each)
    s.objectives.emplace_back(first, first + each);
}

void Island::evolve() {
  auto& s = *search_;
  // Built every time, so that a population read from a checkpoint makes no difference.
  auto population = s.empty();
  for (std::size_t i = 0; i < s.units.size(); ++i) population.push_back(s.units[i], s.objectives[i]);
  population = std::visit([&](auto& algorithm) { return algorithm.evolve(population); }, s.algorithm);
  s.units = population.get_x();
  s.objectives = population.get_f();
}

IslandState Island::state() const {
  std::ostringstream text;
  text.imbue(archive_locale());
  boost::archive::text_oarchive archive(text, archive_flags);
  std::visit([&](const auto& algorithm) { archive << algorithm; }, search_->algorithm);
  return {search_->units, search_->objectives, text.str()};
}

void Island::restore(const IslandState& state) {
  auto& s = *search_;
  const std::size_t goals = s.plan.optimizer.search == study::Search::nsga2 ? 2 : 1;
  const auto finite = [](const std::vector<double>& list) {
    return std::all_of(list.begin(), list.end(), [](double v) { return std::isfinite(v); });
  };
  bool good = state.points.size() == s.plan.optimizer.population && state.objectives.size() == state.points.size();
  for (const auto& unit : state.points) good = good && unit.size() == s.plan.bounds.size() && finite(unit);
  for (const auto& objectives : state.objectives) good = good && objectives.size() == goals && finite(objectives);
  if (!good) throw TuneError("the population is not one of this tuning");
  try {
    std::istringstream text(state.algorithm);
    text.imbue(archive_locale());
    boost::archive::text_iarchive archive(text, archive_flags);
    std::visit([&](auto& algorithm) { archive >> algorithm; }, s.algorithm);
  } catch (const std::exception& e) {  // boost's and the standard library's
    throw TuneError(std::string("the algorithm's state cannot be read: ") + e.what());
  }
  s.batch();
  s.units = state.points;
  s.objectives = state.objectives;
}

std::vector<double> Island::fitness() const {
  std::vector<double> list;
  for (const auto& objectives : search_->objectives) list.push_back(fitness_of(objectives, search_->plan.fitness));
  return list;
}

std::vector<std::vector<double>> Island::points() const {
  std::vector<std::vector<double>> list;
  for (const auto& unit : search_->units) list.push_back(from_unit(search_->plan.bounds, unit));
  return list;
}

}  // namespace banyan::study
