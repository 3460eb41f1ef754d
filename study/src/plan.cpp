// SPDX-License-Identifier: MIT
#include "banyan/study/plan.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "banyan/controller/core/digest.hpp"
#include "file_text.hpp"
#include "hexadecimal.hpp"

namespace banyan::study {
namespace {

using config::Node;
using config::Problem;

// The identity of a run, without its name and its outputs: the same text for all seeds except for the seed
// itself.
class Identity {
 public:
  explicit Identity(config::Configuration bare) {
    const std::string_view fingerprint = world::algorithm_of(bare.scenario).fingerprint();
    if (!fingerprint.empty()) tail_ = "-" + std::string(fingerprint);
    bare.scenario.name.clear();
    bare.scenario.description.clear();
    bare.scenario.seed = 0;
    bare.output = {};
    text_ = config::config_json(bare);
    constexpr std::string_view seed = "\"seed\":";
    seed_at_ = text_.find(seed) + seed.size();
  }
  [[nodiscard]] std::string id(std::uint64_t seed) const {
    std::string text = text_;
    return hexadecimal(digest_of(text.replace(seed_at_, 1, std::to_string(seed)))) + tail_;
  }

 private:
  std::string text_, tail_;
  std::size_t seed_at_ = 0;
};

class Planner {
 public:
  Planner(const Study& study, const AlgorithmList& algorithms, const PlanProgress& progress)
      : study_(study), algorithms_(algorithms), progress_(progress) {}

  Plan plan() {
    plan_.algorithms.assign(algorithms_.names().begin(), algorithms_.names().end());
    for (std::size_t p = 0; p < study_.parts.size(); ++p) plan_part(p);
    for (auto& [text, found] : found_) report(std::move(found));
    std::stable_sort(plan_.problems.begin(), plan_.problems.end(),
                     [](const Problem& a, const Problem& b) { return !a.warning && b.warning; });
    Digest digest;
    for (const auto& row : plan_.rows) {
      digest.add(digest_of(plan_.runs[row.run].configured()));
      digest.add(row.part);
    }
    plan_.digest = digest.value();
    tell();
    return std::move(plan_);
  }

 private:
  // The same problem in many combinations is reported once.
  struct Found {
    Problem problem;
    std::string first;      // combination
    std::size_t count = 0;  // combinations
    double of = 0.0;        // of the part
  };

  void plan_part(std::size_t p) {
    const Part& part = study_.parts[p];
    seen_.clear();
    std::vector<std::size_t> values(part.axes.size(), 0);
    if (std::any_of(part.axes.begin(), part.axes.end(), [](const Axis& a) { return a.values.empty(); })) return;
    while (true) {
      plan_combination(p, values);
      std::size_t k = values.size();  // count up, the last axis first
      while (k > 0 && ++values[k - 1] == part.axes[k - 1].values.size()) values[--k] = 0;
      if (k == 0) return;
    }
  }

  void plan_combination(std::size_t p, const std::vector<std::size_t>& values) {
    const Part& part = study_.parts[p];
    std::string scenario = part.scenario;
    for (std::size_t a = 0; a < values.size(); ++a) {
      const auto& value = part.axes[a].values[values[a]];
      if (!value.scenario.empty()) scenario = value.scenario;
    }
    auto loaded = configuration_of(part, values, scenario);
    const std::string combination = name_of(part, values, ", ");
    bool ok = true;
    for (auto& problem : loaded.problems) {
      ok = ok && problem.warning;
      note(std::move(problem), combination, part.combinations());
    }
    if (!ok) return;
    plan_.combinations.push_back(loaded.configuration);
    const std::string folder = (part.name.empty() ? "" : part.name + "/") + name_of(part, values, ",", true);
    const Identity identity(loaded.configuration);
    tell();
    for (const std::uint64_t seed : part.seeds) {
      if (plan_.rows.size() % rows_between_words == 0) tell();
      loaded.configuration.scenario.seed = seed;
      const std::size_t run = add_run(loaded.configuration, identity.id(seed), folder);
      plan_.rows.push_back({p, values, seed, run});
      if (!seen_.emplace(run, combination).second && !twice_) {
        twice_ = true;
        plan_.problems.push_back({part.place, part.name.empty() ? "axes" : "parts." + part.name,
                                  "two of its runs are the same: (" + seen_.at(run) + ") and (" + combination +
                                      ") with seed " + std::to_string(seed) + " (id " + plan_.runs[run].id + ")"});
      }
    }
  }

  config::Loaded configuration_of(const Part& part, const std::vector<std::size_t>& values,
                                  const std::string& scenario) {
    std::vector<Problem> problems;
    Node root;
    try {
      root = tree_of(scenario);
    } catch (const config::DocumentError& e) { return {{}, {e.problem}}; }
    const config::Place place = root.place;
    // Outputs that a single run keeps by default, such as recordings, are kept in studies only on request.
    for (const auto& format : record::output_formats) {
      if (format.key.empty() || !format.by_default) continue;
      (void)config::assign(root, "output." + std::string(format.key), {false, place});
    }
    // A run of the study is checked: with the scenario's own seed there may be no valid world.
    if (!part.seeds.empty()) (void)config::assign(root, "seed", {static_cast<std::int64_t>(part.seeds.front()), place});
    const auto change = [&](const KeyChange& c) {
      if (c.key.empty()) config::overlay(root, c.value);
      else
        for (auto& problem : config::assign(root, c.key, c.value)) problems.push_back(std::move(problem));
    };
    for (const auto& c : part.changes) change(c);
    for (std::size_t a = 0; a < values.size(); ++a) {
      for (const auto& c : part.axes[a].values[values[a]].changes) change(c);
    }
    return config::configure(std::move(root), scenario, algorithms_, std::move(problems));
  }

  // Each file is read once.
  const Node& tree_of(const std::string& scenario) {
    const auto known = trees_.find(scenario);
    if (known != trees_.end()) return known->second;
    return trees_.emplace(scenario, config::parse_scenario(scenario, config::read_text_file(scenario))).first->second;
  }

  static std::string name_of(const Part& part, const std::vector<std::size_t>& values, const std::string& separator,
                             bool for_files = false) {
    std::string text;
    for (std::size_t a = 0; a < values.size(); ++a) {
      const auto& label = part.axes[a].values[values[a]].label;
      text += (a > 0 ? separator : "") + part.axes[a].name + "=" + (for_files ? file_text(label) : label);
    }
    return text.empty() ? "all" : text.substr(0, 200);
  }

  std::size_t add_run(const config::Configuration& configuration, std::string id, const std::string& folder) {
    PlannedRun run;
    run.id = std::move(id);
    run.combination = plan_.combinations.size() - 1;
    run.seed = configuration.scenario.seed;
    run.directory = folder + "/seed=" + std::to_string(run.seed);
    if (const auto known = index_.find(run.id); known != index_.end()) {
      share_run(plan_.runs[known->second], run, configuration);
      return known->second;
    }
    if (!directories_.insert(run.directory).second) run.directory += "-" + run.id;
    const auto& scenario = configuration.scenario;
    run.cost = static_cast<double>(world::robot_count(scenario)) * world::time_limit_s(scenario) / scenario.tick_s;
    index_.emplace(run.id, plan_.runs.size());
    plan_.runs.push_back(std::move(run));
    return plan_.runs.size() - 1;
  }

  // Two parts have the same run: if only the later one wants its files, the run is done for that one.
  void share_run(PlannedRun& first, const PlannedRun& again, const config::Configuration& configuration) {
    if (!keeps_files(configuration) || keeps_files(plan_.combinations[first.combination])) return;
    first.combination = again.combination;
    first.directory = again.directory;
    if (!directories_.insert(first.directory).second) first.directory += "-" + first.id;
  }

  void tell() const {
    if (progress_) progress_(static_cast<double>(plan_.rows.size()));
  }

  void note(Problem problem, const std::string& combination, double of) {
    auto& found = found_[to_string(problem)];
    if (found.count++ == 0) {
      found.problem = std::move(problem);
      found.first = combination;
      found.of = of;
    }
  }

  void report(Found found) {
    if (static_cast<double>(found.count) < found.of)
      found.problem.text +=
          " (in " + std::to_string(found.count) + " combinations of axes, the first: " + found.first + ")";
    plan_.problems.push_back(std::move(found.problem));
  }

  static constexpr std::size_t rows_between_words = 1000;

  const Study& study_;
  const AlgorithmList& algorithms_;
  const PlanProgress& progress_;
  Plan plan_;
  std::map<std::string, Node> trees_;
  std::map<std::string, std::size_t, std::less<>> index_;  // id -> run
  std::set<std::string> directories_;
  std::map<std::size_t, std::string> seen_;  // runs of this part -> combination
  std::map<std::string, Found> found_;
  bool twice_ = false;
};

}  // namespace

bool Plan::ok() const noexcept {
  return std::all_of(problems.begin(), problems.end(), [](const Problem& p) { return p.warning; });
}

bool keeps_files(const config::Configuration& configuration) noexcept { return configuration.output.any(); }

std::string plan_text(const Plan& plan) { return hexadecimal(plan.digest); }

config::Configuration configuration_of(const Plan& plan, const PlannedRun& run) {
  auto configuration = plan.combinations[run.combination];
  configuration.scenario.seed = run.seed;
  return configuration;
}

double count_rows(const Study& study) noexcept {
  double rows = 0.0;
  for (const auto& part : study.parts) rows += part.combinations() * static_cast<double>(part.seeds.size());
  return rows;
}

Plan make_plan(const Study& study, const AlgorithmList& algorithms, const PlanProgress& progress) {
  return Planner(study, algorithms, progress).plan();
}

}  // namespace banyan::study
