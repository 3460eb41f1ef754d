// SPDX-License-Identifier: MIT
// A tuning as data: what counts for its result, in one text and one digest.
#include <nlohmann/json.hpp>

#include "banyan/study/tune.hpp"
#include "hexadecimal.hpp"

namespace banyan::study {

using Json = nlohmann::ordered_json;

std::string_view name_of(Search search) noexcept {
  switch (search) {
    case Search::sga: return "sga";
    case Search::nsga2: return "nsga2";
    case Search::cmaes: return "cmaes";
  }
  return "?";
}

std::uint64_t TunePlan::evaluations() const noexcept {
  return static_cast<std::uint64_t>(optimizer.population) * (optimizer.generations + 1ULL);
}

std::string tune_json(const TunePlan& plan) {
  const auto& o = plan.optimizer;
  Json optimizer{{"algorithm", name_of(o.search)},
                 {"generations", o.generations},
                 {"population", o.population},
                 {"islands", o.islands},
                 {"seed", o.seed}};
  if (o.search == Search::cmaes) {
    optimizer["step"] = o.step;
  } else {
    optimizer["crossover_probability"] = o.crossover_probability;
    optimizer["mutation_probability"] = o.mutation_probability;
  }
  Json bounds = Json::object(), initial = Json::object(), worlds = Json::array();
  for (std::size_t i = 0; i < plan.bounds.size(); ++i) {
    const auto& bound = plan.bounds[i];
    bounds[bound.parameter] = {bound.low, bound.high};
    if (!plan.initial.empty()) initial[bound.parameter] = plan.initial[i];
  }
  for (const auto& world : plan.worlds) worlds.push_back(Json::parse(config::config_json(world)));
  Json root{{"name", plan.name},
            {"description", plan.description},
            {"seeds", {{"training", plan.training}, {"test", plan.test}}},
            {"optimizer", optimizer},
            {"bounds", bounds}};
  if (plan.fitness.judgement == Judgement::graded) {
    const auto& w = plan.fitness.weights;
    root["fitness"] = {{"kind", name_of(plan.fitness.judgement)},
                       {"held", w.held},
                       {"time", w.time},
                       {"disconnected", w.disconnected},
                       {"committed", w.committed}};
  }
  if (!initial.empty()) root["initial"] = initial;
  root["worlds"] = worlds;
  return root.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string tune_digest(const TunePlan& plan) { return hexadecimal(digest_of(tune_json(plan))); }

}  // namespace banyan::study
