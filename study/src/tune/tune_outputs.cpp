// SPDX-License-Identifier: MIT
#include "tune_outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "banyan/record/file.hpp"
#include "banyan/record/table.hpp"
#include "banyan/study/figure.hpp"
#include "banyan/version.hpp"
#include "machine.hpp"
#include "tune_point.hpp"

namespace banyan::study {
namespace {

using Json = nlohmann::ordered_json;
using config::number_text;

// The file that identifies them goes last: if this is stopped half-way, the rest is still recognised.
constexpr const char* files[] = {"generations.csv", "best.toml",   "front.csv",        "fitness.json", "fitness.svg",
                                 "fitness.pdf",     "fitness.png", "checkpoint.jsonl", "tune.json"};

bool is_there(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

// Whether a file starts with this, or is empty, as after a power failure.
bool starts_with(const std::string& path, std::string_view start) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream in(path, std::ios::binary);
  std::string text(start.size(), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  return in.eof() ? start.starts_with(text.substr(0, static_cast<std::size_t>(in.gcount()))) : text == start;
}

std::string parameter_names(const TunePlan& plan) {
  std::string text;
  for (const auto& bound : plan.bounds) text += "," + bound.parameter;
  return text;
}
std::string parameter_values(const std::vector<double>& point) {
  std::string text;
  for (const double value : point) text += "," + number_text(value);
  return text;
}

// "paper-large: 36 robots, radio.range_m = 2, line of sight off, loss 0".
std::string in_words(const world::Scenario& scenario) {
  return scenario.name + ": " + std::to_string(world::robot_count(scenario)) +
         " robots, radio.range_m = " + number_text(scenario.radio.range_m) + ", line of sight " +
         (scenario.radio.line_of_sight ? "on" : "off") + ", loss " + number_text(scenario.radio.loss) + ".";
}

// A fragment for a scenario. Its header is the same however often the tuning was stopped.
std::string best_toml(const TunePlan& plan, const TuneCandidate& best) {
  const auto& o = plan.optimizer;
  const auto& mission = plan.worlds.front().scenario.mission;
  const auto number = [](auto n) { return std::to_string(n); };
  const auto fitness = [&](const auto& seeds) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.6g", plan.fitness.of(seeds.merit));
    return std::string(digits.data());
  };
  std::string text = "# The best parameters of the tuning " + plan.name + " for " + mission.algorithm + " (" +
                     mission.reading + "),\n";
  text += "# by " + std::string(name_of(o.search)) + ": " + number(o.generations) + " generations of " +
          number(o.population) + " individuals on " + number(o.islands) + " islands, seed " + number(o.seed) + ".\n";
  text += "# Fitness (" + std::string(name_of(plan.fitness.judgement)) + ") " + fitness(best.training) +
          " on the training seeds, " + fitness(best.test) + " on the test seeds.\n";
  text +=
      "# Banyan " + std::string(version) + " (git " + std::string(git_id()) + "), tuning " + tune_digest(plan) + ".\n";
  for (const auto& world : plan.worlds) text += "# Tuned in " + in_words(world.scenario) + "\n";
  text += "[mission.parameters]\n";
  for (std::size_t i = 0; i < plan.bounds.size(); ++i)
    text += plan.bounds[i].parameter + " = " + number_text(best.point[i]) + "\n";
  return text;
}

std::string front_csv(const TunePlan& plan, const std::vector<FrontPoint>& front) {
  const auto names = plan.fitness.goal_names();
  std::string text = "island," + std::string(names[0]) + "," + std::string(names[1]) + ",held,disconnected,committed" +
                     parameter_names(plan) + "\n";
  for (const auto& p : front) {
    text += std::to_string(p.island);
    for (const double value : {p.goals[0], p.goals[1], p.merit.held, p.merit.disconnected, p.merit.committed})
      text += "," + number_text(value);
    text += parameter_values(p.point) + "\n";
  }
  return text;
}

Json score_json(const Fitness& fitness, const TuneScore& score) {
  return {{"fitness", fitness.of(score.merit)},
          {"runs", score.trials},
          {"complete_share", score.complete_share},
          {"median_completion_time_s", score.median_time_s ? Json(*score.median_time_s) : Json()},
          {"mean_normalized_time", score.merit.time},
          {"disconnected_share", score.disconnected_share},
          {"mean_disconnected_time_ratio", score.merit.disconnected},
          {"mean_held_ratio", score.merit.held},
          {"mean_committed_share", score.merit.committed}};
}

std::string result_json(const TunePlan& plan, const TuneResult& result) {
  Json candidates = Json::array();
  for (const auto& c : result.candidates) {
    Json parameters = Json::object();
    for (std::size_t i = 0; i < plan.bounds.size(); ++i) parameters[plan.bounds[i].parameter] = c.point[i];
    candidates.push_back({{"name", c.name},
                          {"parameters", parameters},
                          {"training", score_json(plan.fitness, c.training)},
                          {"test", score_json(plan.fitness, c.test)}});
  }
  const Json root{{"format", "banyan.tune"},
                  {"format_version", 1},
                  {"version", version},
                  {"git", git_id()},
                  {"machine", {{"processor", processor_name()}, {"cores", std::thread::hardware_concurrency()}}},
                  {"digest", tune_digest(plan)},
                  {"tuning", Json::parse(tune_json(plan))},
                  {"evaluations", result.evaluations},
                  {"candidates", candidates}};
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// The mean over islands of a number per generation.
template <class Member>
std::vector<double> mean_over_islands(const TunePlan& plan, const std::vector<GenerationRow>& history, Member member) {
  std::vector<double> sums(plan.optimizer.generations + 1ULL, 0.0);
  for (const auto& row : history) sums[row.generation] += row.*member / plan.optimizer.islands;
  return sums;
}

// From the lowest to the highest value, rounded: near the end all the difference is in the last per
// cent.
void fit_axis(CurveFigure& figure) {
  double low = figure.curves.front().y.front(), high = low;
  for (const auto& curve : figure.curves) {
    for (const auto& values : {curve.y, curve.low, curve.high}) {
      for (const double value : values) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  const double step = high > low ? std::pow(10.0, std::floor(std::log10(high - low))) : 0.1;
  figure.y_minimum = std::floor(low / step) * step;
  figure.y_maximum = std::max(std::ceil(high / step) * step, *figure.y_minimum + step);
}

CurveFigure fitness_figure(const TunePlan& plan, const std::vector<GenerationRow>& history) {
  constexpr std::uint32_t most_islands = 6;  // beyond, their curves say less than the mean and the range
  CurveFigure figure{plan.name, "generation", "fitness", {}, std::nullopt, std::nullopt};
  std::vector<double> generations;
  for (std::uint32_t g = 0; g <= plan.optimizer.generations; ++g) generations.push_back(g);
  const auto islands = plan.optimizer.islands;
  std::vector<std::vector<double>> best(islands);
  for (const auto& row : history) best[row.island].push_back(row.best);
  if (islands <= most_islands) {
    for (std::uint32_t i = 0; i < islands; ++i)
      figure.curves.push_back({"best, island " + std::to_string(i), generations, best[i], {}, {}, false});
  } else {
    auto low = best.front(), high = best.front();
    for (const auto& island : best) {
      for (std::size_t g = 0; g < low.size(); ++g) {
        low[g] = std::min(low[g], island[g]);
        high[g] = std::max(high[g], island[g]);
      }
    }
    figure.curves.push_back({"best, mean and range of the islands", generations,
                             mean_over_islands(plan, history, &GenerationRow::best), low, high, false});
  }
  figure.curves.push_back(
      {"mean of the populations", generations, mean_over_islands(plan, history, &GenerationRow::mean), {}, {}, false});
  fit_axis(figure);
  return figure;
}

bool dominates(const FrontPoint& a, const FrontPoint& b) {
  return a.goals[0] <= b.goals[0] && a.goals[1] <= b.goals[1] && a.goals != b.goals;
}

}  // namespace

std::string checkpoint_path(const std::string& directory) { return directory + "/checkpoint.jsonl"; }

bool tune_finished(const std::string& directory) { return is_there(directory + "/tune.json"); }

std::string foreign_tune_output(const std::string& directory) {
  std::string finished = directory + "/tune.json", under_way = checkpoint_path(directory);
  if (is_there(finished) && !starts_with(finished, "{\n  \"format\": \"banyan.tune\",")) return finished;
  if (is_there(under_way) && !starts_with(under_way, "{\"format\":\"banyan.tune-checkpoint\",")) return under_way;
  if (is_there(finished) || is_there(under_way)) return "";
  for (const char* file : files) {
    if (std::string path = directory + "/" + file; is_there(path)) return path;
  }
  return "";
}

void remove_tune_outputs(const std::string& directory) {
  for (const char* file : files) {
    std::error_code error;
    const std::string path = directory + "/" + file;
    std::filesystem::remove(path, error);
    if (error) throw record::FileError(path, "remove", error.value());
  }
}

void write_generations(const std::string& directory, const TunePlan& plan, const std::vector<GenerationRow>& history) {
  std::string text =
      "generation,island,evaluations,best_fitness,mean_fitness,worst_fitness" + parameter_names(plan) + "\n";
  for (const auto& row : history) {
    const std::uint64_t evaluations = plan.optimizer.population * (row.generation + 1ULL);
    text += std::to_string(row.generation) + "," + std::to_string(row.island) + "," + std::to_string(evaluations) +
            "," + number_text(row.best) + "," + number_text(row.mean) + "," + number_text(row.worst) +
            parameter_values(row.best_point) + "\n";
  }
  record::write_file(directory + "/generations.csv", text, record::Existing::replace);
}

std::vector<FrontPoint> front_of(const TunePlan& plan, const std::vector<IslandState>& islands) {
  std::vector<FrontPoint> all;
  for (std::uint32_t i = 0; i < islands.size(); ++i) {
    for (std::size_t k = 0; k < islands[i].points.size(); ++k) {
      const auto& goals = islands[i].objectives[k];
      if (goals.size() == 2 && goals[0] <= 1.0)  // above: cannot be run
        all.push_back({i, {goals[0], goals[1]}, from_unit(plan.bounds, islands[i].points[k]), {}});
    }
  }
  std::vector<FrontPoint> front;
  for (const auto& p : all) {
    const auto beaten = [&](const FrontPoint& q) { return dominates(q, p); };
    const auto same = [&](const FrontPoint& q) { return q.goals == p.goals; };
    if (std::none_of(all.begin(), all.end(), beaten) && std::none_of(front.begin(), front.end(), same))
      front.push_back(p);
  }
  std::stable_sort(front.begin(), front.end(), [](const auto& a, const auto& b) { return a.goals[0] < b.goals[0]; });
  return front;
}

void write_results(const std::string& directory, const TunePlan& plan, const std::vector<GenerationRow>& history,
                   const std::vector<FrontPoint>& front, const Drawer& drawer, TuneResult& result) {
  constexpr auto replace = record::Existing::replace;
  record::write_file(directory + "/best.toml", best_toml(plan, result.candidates.front()), replace);
  if (plan.optimizer.search == Search::nsga2) {
    record::write_file(directory + "/front.csv", front_csv(plan, front), replace);
    result.front = front.size();
  }
  record::write_file(directory + "/fitness.json", figure_json(fitness_figure(plan, history)), replace);
  if (std::string complaint = draw_folder(drawer, directory); !complaint.empty())
    result.warnings.push_back(std::move(complaint));
  record::write_file(directory + "/tune.json", result_json(plan, result), replace);
  std::error_code ignored;  // if it stays, it does no harm
  std::filesystem::remove(checkpoint_path(directory), ignored);
}

}  // namespace banyan::study
