// SPDX-License-Identifier: MIT
// The tune file: from its text to a plan, with everything that is wrong in it.
#include <algorithm>
#include <limits>
#include <set>

#include "banyan/config/table_reader.hpp"
#include "banyan/controller/core/algorithm.hpp"
#include "banyan/study/tune.hpp"
#include "banyan/world/faults.hpp"
#include "base.hpp"
#include "tune_point.hpp"

namespace banyan::study {
namespace {

using config::Node;
using config::number_text;
using config::Place;
using config::Problem;
using config::Range;
using config::TableReader;

constexpr double largest_seed = 9007199254740992.0;  // 2^53: exact in every reader of JSON

std::string in_quotes(std::string_view name) { return "\"" + std::string(name) + "\""; }

// Whether there are only warnings; otherwise it is too early to check how values fit together.
bool sound(const std::vector<Problem>& problems) {
  return std::all_of(problems.begin(), problems.end(), [](const Problem& p) { return p.warning; });
}

class TuneFileReader {
 public:
  TuneFileReader(const Node& root, const std::string& path, const AlgorithmList& algorithms,
                 std::vector<Problem>& problems)
      : path_(path), algorithms_(algorithms), problems_(problems), top_(root, "", problems) {}

  TunePlan read() {
    plan_.name = top_.text("name", config::name_from(path_, "tuning"));
    if (!config::good_name(plan_.name))
      top_.report("name", "is " + in_quotes(plan_.name) + "; allowed: " + std::string(config::name_rule));
    plan_.description = top_.text("description");
    read_seeds();
    read_bounds();
    read_fitness();
    read_optimizer();
    read_worlds();
    const Node* initial = top_.table("initial");
    top_.finish();
    if (sound(problems_)) check_algorithms();
    if (sound(problems_)) check_parameters();
    if (sound(problems_) && initial) read_initial(*initial);
    if (sound(problems_)) warn_of_narrow_bounds();
    return std::move(plan_);
  }

 private:
  // Not its base: what that says for another optimizer or fitness does no harm.
  [[nodiscard]] bool says_itself(const TableReader& table, std::string_view name) const {
    if (!table.has(name)) return false;
    const Place place = table.place(name);
    return !place.origin || *place.origin == path_;
  }

  // -------------------------------------------------------------------------------------- seeds --

  void read_seeds() {
    top_.require("seeds", "the section [seeds] says which seeds to train on and to test with");
    const Node* node = top_.table("seeds");
    if (!node) return;
    TableReader table(*node, "seeds", problems_);
    table.require("training", "\"1-5\" or a list of whole numbers");
    table.require("test", "\"1001-1050\" or a list of whole numbers");
    plan_.training = table.seeds("training");
    plan_.test = table.seeds("test");
    table.finish();
    const std::set<std::uint64_t> seen(plan_.training.begin(), plan_.training.end());
    std::string both;
    std::size_t count = 0;
    for (const auto seed : plan_.test) {
      if (seen.contains(seed) && ++count <= 5) both += (both.empty() ? "" : ", ") + std::to_string(seed);
    }
    if (count > 0)
      table.report("test", "overlaps seeds.training (" + both + (count > 5 ? ", ..." : "") +
                               "): a test must be of runs that the search never saw");
  }

  // ------------------------------------------------------------------------------------- bounds --

  // The parameter of a key of [bounds] or [initial]; null, and a problem, if there is none to search.
  const ParameterInfo* searchable(const Place& place, const std::string& section, const std::string& name) {
    std::vector<std::string_view> known;
    for (const auto& info : algorithms_.parameters()) {
      if (info.key == name) return &info;
      known.push_back(info.key);
    }
    std::string what = "there is no such parameter";
    if (const auto near = config::nearest(name, known); !near.empty())
      what += "; did you mean " + std::string(near) + "?";
    problems_.push_back({place, section + "." + name, what + " (`banyan algorithms` lists them)"});
    return nullptr;
  }
  void read_bounds() {
    top_.require("bounds", "the section [bounds] says what to search");
    const Node* node = top_.table("bounds");
    if (!node) return;
    for (const auto& [name, value] : *node->table()) {
      if (const auto* info = searchable(value.place, "bounds", name)) read_bound(name, value, *info);
    }
    if (node->table()->empty()) top_.report("bounds", "is empty; at least one parameter is needed");
  }
  void read_bound(const std::string& name, const Node& node, const ParameterInfo& info) {
    const auto refuse = [&](const std::string& text) { problems_.push_back({node.place, "bounds." + name, text}); };
    const auto number = [](const Node& n) -> std::optional<double> {
      if (const auto* real = std::get_if<double>(&n.value)) return *real;
      if (const auto* whole = std::get_if<std::int64_t>(&n.value)) return static_cast<double>(*whole);
      return std::nullopt;
    };
    const auto* list = node.array();
    const auto low = list && list->size() == 2 ? number((*list)[0]) : std::nullopt;
    const auto high = list && list->size() == 2 ? number((*list)[1]) : std::nullopt;
    if (!low || !high) return refuse("must be two numbers, [lowest, highest], not " + node.describe());
    const Range range{config::widened(info.minimum), config::widened(info.maximum)};
    const std::string given = "is [" + number_text(*low) + ", " + number_text(*high) + "]";
    // Written so that nan is outside.
    if (!(*low >= range.minimum && *low <= range.maximum && *high >= range.minimum && *high <= range.maximum))
      return refuse(given + "; allowed: " + config::range_text(range, info.unit));
    if (!(*low < *high)) return refuse(given + "; the lowest must be below the highest");
    plan_.bounds.push_back({name, *low, *high});
  }

  // ------------------------------------------------------------------------------------ fitness --

  void read_fitness() {
    const Node* node = top_.table("fitness");
    if (!node) return;
    TableReader table(*node, "fitness", problems_);
    auto& fitness = plan_.fitness;
    constexpr auto two_step = Judgement::two_step, graded = Judgement::graded;
    fitness.judgement = static_cast<Judgement>(table.choice("kind", {name_of(two_step), name_of(graded)}, 0));
    auto& w = fitness.weights;
    double sum = 0.0;
    for (auto [name, weight] : {std::pair{"held", &w.held}, std::pair{"time", &w.time},
                                std::pair{"disconnected", &w.disconnected}, std::pair{"committed", &w.committed}}) {
      if (fitness.judgement == two_step && says_itself(table, name))
        table.report(name, "has no meaning with kind = " + in_quotes(name_of(two_step)));
      *weight = table.number(name, *weight, {0.0, 1e6});
      sum += *weight;
    }
    if (!(sum > 0.0)) table.report("", "has no weight above 0: everything would be equally good");
    table.finish();
  }
  // With one goal only, all that no other beats is one point.
  void check_goals(TableReader& table) const {
    const auto& w = plan_.fitness.weights;
    if (plan_.optimizer.search != Search::nsga2 || plan_.fitness.judgement != Judgement::graded) return;
    if (w.time > 0.0 && w.held + w.disconnected + w.committed > 0.0) return;
    table.report("algorithm",
                 "is \"nsga2\", whose two goals are the time and the rest: [fitness] needs a weight of time "
                 "and another one above 0");
  }

  // ---------------------------------------------------------------------------------- optimizer --

  void read_optimizer() {
    auto& o = plan_.optimizer;
    o.mutation_probability = 1.0 / static_cast<double>(std::max<std::size_t>(plan_.bounds.size(), 1));
    const Node* node = top_.table("optimizer");
    if (!node) return;
    TableReader table(*node, "optimizer", problems_);
    const auto before = problems_.size();
    o.search = static_cast<Search>(table.choice("algorithm", {"sga", "nsga2", "cmaes"}, 0));
    const bool known = problems_.size() == before;
    o.generations = static_cast<std::uint32_t>(table.whole("generations", o.generations, {1.0, 100000.0}));
    o.population = static_cast<std::uint32_t>(table.whole("population", o.population, {2.0, 10000.0}));
    o.islands = static_cast<std::uint32_t>(table.whole("islands", o.islands, {1.0, 256.0}));
    o.seed = static_cast<std::uint64_t>(table.whole("seed", 1, {0.0, largest_seed}));
    o.crossover_probability = table.number("crossover_probability", o.crossover_probability, {0.0, 0.999});
    o.mutation_probability = table.number("mutation_probability", o.mutation_probability, {0.0, 1.0});
    o.step = table.number("step", o.step, {0.001, 1.0});
    table.finish();
    if (known) check_optimizer(table);
  }
  void check_optimizer(TableReader& table) const {
    const auto& o = plan_.optimizer;
    check_goals(table);
    const bool cmaes = o.search == Search::cmaes;
    const std::string is = "is " + std::to_string(o.population) + "; ";
    if (o.search == Search::sga && o.population % 2 != 0)
      table.report("population", is + "sga takes even sizes, because parents cross in pairs");
    if (o.search == Search::nsga2 && (o.population < 8 || o.population % 4 != 0))
      table.report("population", is + "nsga2 takes multiples of 4, at least 8");
    if (cmaes && o.population < 5) table.report("population", is + "cmaes needs at least 5");
    const auto meaningless = [&](std::string_view name) {
      if (says_itself(table, name))
        table.report(name, "has no meaning with algorithm = " + in_quotes(name_of(o.search)));
    };
    if (cmaes) {
      meaningless("crossover_probability");
      meaningless("mutation_probability");
    } else {
      meaningless("step");
    }
  }

  // ------------------------------------------------------------------------------------- worlds --

  using Changes = std::vector<std::pair<std::string, Node>>;
  // Changes to a scenario; nested tables are dotted keys too.
  static void collect(const Node& table, const std::string& prefix, Changes& changes) {
    for (const auto& [name, node] : *table.table()) {
      const std::string key = prefix.empty() ? name : prefix + "." + name;
      if (node.table()) collect(node, key, changes);
      else changes.emplace_back(key, config::as_option(node));
    }
  }
  // The [set] of the file or of one world.
  void read_set(TableReader& table, Changes& changes) {
    const Node* set = table.table("set");
    if (!set) return;
    for (const auto& [name, value] : *set->table()) {
      if (name == "seed")
        problems_.push_back({value.place, table.path("set"), "sets seed; a tuning takes its seeds from [seeds]"});
    }
    collect(*set, "", changes);
  }
  void read_worlds() {
    Changes everywhere;
    read_set(top_, everywhere);
    top_.require("worlds", "[[worlds]] with a scenario, once for each kind of trial");
    const auto worlds = top_.tables("worlds");
    if (const Node* list = top_.any("worlds"); list && list->array() && list->array()->empty())
      top_.report("worlds", "is empty; at least one world is needed");
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      TableReader table(*worlds[i], "worlds[" + std::to_string(i) + "]", problems_);
      read_world(table, everywhere);
      table.finish();
    }
  }
  void read_world(TableReader& table, Changes changes) {
    table.require("scenario");
    const std::string file = table.text("scenario");
    read_set(table, changes);
    if (file.empty()) return;
    const std::string where = beside(table.place("scenario"), path_, file);
    try {
      Node scenario = config::parse_scenario(where, config::read_text_file(where));
      std::vector<Problem> faults;
      for (const auto& [key, value] : changes) {
        for (auto& fault : config::assign(scenario, key, value)) faults.push_back(std::move(fault));
      }
      auto loaded = config::configure(std::move(scenario), where, algorithms_, std::move(faults));
      if (loaded.ok()) check_random_targets(loaded, table);
      for (auto& problem : loaded.problems) add_once(std::move(problem));
      plan_.worlds.push_back(std::move(loaded.configuration));
      places_.push_back(table.place("scenario"));
    } catch (const config::DocumentError& e) {
      table.report("scenario", e.problem.place.text() + ": " + e.problem.text);
    }
  }
  // Targets that are drawn from the seed may be out of reach with one and not with another.
  void check_random_targets(config::Loaded& loaded, const TableReader& table) {
    auto scenario = loaded.configuration.scenario;
    if (!std::holds_alternative<world::RandomTargets>(scenario.targets)) return;
    for (const auto& seeds : {plan_.training, plan_.test}) {
      for (const auto seed : seeds) {
        scenario.seed = seed;
        for (const auto& fault : world::faults(scenario)) {
          if (!fault.warning)
            loaded.problems.push_back({table.place("scenario"), table.path("scenario"),
                                       "with seed " + std::to_string(seed) + ": " + fault.key + ": " + fault.text});
        }
      }
    }
  }
  // Problems of [set] would be reported once per world.
  void add_once(Problem problem) {
    if (told_.insert(config::to_string(problem)).second) problems_.push_back(std::move(problem));
  }

  // ------------------------------------------------------------------------ what hangs together --

  void check_algorithms() {
    const auto describe = [](const world::Mission& m) { return m.algorithm + " (" + m.reading + ")"; };
    const auto first = describe(plan_.worlds.front().scenario.mission);
    for (std::size_t i = 1; i < plan_.worlds.size(); ++i) {
      const auto here = describe(plan_.worlds[i].scenario.mission);
      if (here != first)
        problems_.push_back({places_[i], "worlds[" + std::to_string(i) + "]",
                             "runs " + here + ", the first world " + first + "; one search is for one algorithm"});
    }
  }
  // Other algorithms' parameters would be searched in vain.
  void check_parameters() {
    const auto& scenario = plan_.worlds.front().scenario;
    const Algorithm& algorithm = world::algorithm_of(scenario);
    std::vector<std::string_view> known;
    for (const auto* row : algorithm.parameters()) known.push_back(row->key);
    for (const auto& [name, value] : *top_.table("bounds")->table()) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string whose(algorithm.name());
      problems_.push_back({value.place, "bounds." + name,
                           "is no parameter of " + whose + " (`banyan algorithms " + whose + "` lists them)"});
    }
  }
  void read_initial(const Node& node) {
    TableReader table(node, "initial", problems_);
    auto point = untuned_point(plan_);
    for (std::size_t i = 0; i < point.size(); ++i) {
      const auto& bound = plan_.bounds[i];
      if (const auto given = table.number(bound.parameter, {bound.low, bound.high})) point[i] = *given;
      else if (!table.has(bound.parameter) && !(point[i] >= bound.low && point[i] <= bound.high))
        table.report("", bound.parameter + " is missing, and the scenario's own, " + number_text(point[i]) +
                             ", is outside of [bounds]");
    }
    for (const auto& [name, value] : *node.table()) {
      const bool searched = std::any_of(plan_.bounds.begin(), plan_.bounds.end(),
                                        [&key = name](const TuneBound& b) { return b.parameter == key; });
      if (searched || !searchable(value.place, "initial", name)) continue;
      problems_.push_back({value.place, "initial." + name, "is not searched: [bounds] does not have it"});
    }
    if (!sound(problems_)) return;
    for (const auto& world : plan_.worlds) {
      const auto scenario = with_parameters(world.scenario, plan_.bounds, point);
      const auto why = world::algorithm_of(scenario).fault(world::setup_of(scenario));
      if (!why.empty()) return table.report("", "cannot be run: " + why);
    }
    plan_.initial = point;
  }
  // Doubtful rather than wrong: a search can find its way in from outside.
  void warn_of_narrow_bounds() {
    if (!plan_.initial.empty()) return;
    constexpr int tries = 2000;
    std::vector<double> unit(plan_.bounds.size());
    std::uint64_t state = 1;
    for (int i = 0; i < tries; ++i) {
      for (double& u : unit) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;  // Knuth's MMIX generator
        u = static_cast<double>(state >> 11U) * 0x1p-53;
      }
      if (infeasibility(plan_, from_unit(plan_.bounds, unit)) <= 0.0) return;
    }
    problems_.push_back({top_.place("bounds"), "bounds",
                         "none of 2000 random points in them keeps A < E < S < delta < C: the search may find nothing "
                         "that can be run",
                         true});
  }

  const std::string& path_;
  const AlgorithmList& algorithms_;
  std::vector<Problem>& problems_;
  TableReader top_;
  std::set<std::string> told_;
  std::vector<Place> places_;  // of the worlds
  TunePlan plan_;
};

}  // namespace

bool LoadedTune::ok() const noexcept { return sound(problems); }

LoadedTune parse_tune(const std::string& path, std::string_view text, const AlgorithmList& algorithms) {
  LoadedTune loaded;
  try {
    Node root = config::parse_document(path, text);
    root = with_base(std::move(root), path, loaded.problems);
    root.place.line = 0;
    TuneFileReader reader(root, path, algorithms, loaded.problems);
    loaded.plan = reader.read();
    // What is in the scenarios comes after.
    const auto rank = [&](const Problem& p) {
      return p.place.origin && *p.place.origin == path ? p.place.line : std::numeric_limits<int>::max();
    };
    std::stable_sort(loaded.problems.begin(), loaded.problems.end(),
                     [&](const Problem& a, const Problem& b) { return rank(a) < rank(b); });
  } catch (const config::DocumentError& e) { loaded.problems.push_back(e.problem); }
  return loaded;
}

LoadedTune load_tune(const std::string& path, const AlgorithmList& algorithms) {
  try {
    return parse_tune(path, config::read_text_file(path), algorithms);
  } catch (const config::DocumentError& e) {
    LoadedTune loaded;
    loaded.problems.push_back(e.problem);
    return loaded;
  }
}

}  // namespace banyan::study
