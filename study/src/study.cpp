// SPDX-License-Identifier: MIT
#include "banyan/study/study.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "banyan/config/table_reader.hpp"
#include "banyan/study/results.hpp"
#include "base.hpp"
#include "figure/figure_plan.hpp"
#include "figure/words.hpp"
#include "study_checks.hpp"

namespace banyan::study {
namespace {

using config::Node;
using config::Problem;
using config::TableReader;

constexpr const char* seeds_instead = "a study takes its seeds from its own key, seeds = \"1-50\"";

// [set]: dotted keys, quoted or not, and sections.
std::vector<KeyChange> read_set(TableReader& table) {
  std::vector<KeyChange> changes;
  const Node* set = table.table("set");
  if (!set) return changes;
  for (const auto& [name, value] : *set->table()) {
    if (name == "seed") {
      table.report("set", std::string("sets seed; ") + seeds_instead);
    } else if (name.find('.') != std::string::npos) {
      changes.push_back({name, config::as_option(value)});
    } else {
      Node tree{Node::Table{}, value.place};
      tree.table()->push_back({name, value});
      changes.push_back({"", config::as_option(std::move(tree))});
    }
  }
  return changes;
}

// A file of keys as a change, such as parameters/*.toml.
std::optional<KeyChange> read_overlay(const std::string& path, const config::Place& place, const std::string& key,
                                      std::vector<Problem>& problems) {
  try {
    return KeyChange{"", config::as_option(config::parse_document(path, config::read_text_file(path)))};
  } catch (const config::DocumentError& e) {
    problems.push_back({place, key, "names a file that cannot be used: " + config::to_string(e.problem)});
    return std::nullopt;
  }
}

// What else a file is, by the keys at its top; "" for a study.
std::string_view other_file(const Node& root) {
  const auto has = [&](std::initializer_list<std::string_view> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return root.find(key) != nullptr; });
  };
  if (has({"worlds", "bounds"})) return "a file for tuning, which banyan tune reads";
  if (!has({"scenario", "axes", "parts"}) && has({"mission", "swarm", "targets"}))
    return "a scenario, which banyan run reads";
  return "";
}

class StudyReader {
 public:
  StudyReader(std::string path, std::vector<Problem>& problems) : path_(std::move(path)), problems_(problems) {}

  Study read(const Node& root, const std::vector<config::Override>& overrides) {
    Study study;
    if (const std::string_view other = other_file(root); !other.empty()) {
      problems_.push_back({root.place, "", "no study, but " + std::string(other)});
      return study;
    }
    TableReader top(root, "", problems_);
    study.name = top.text("name", config::name_from(path_, "study"));
    check_name(top, study.name);
    study.description = top.text("description");
    Part common = read_part(top, Part{}, "axes");
    study.parts = read_parts(top, common);
    read_statistics(top, study);
    read_figures(top, study, problems_);
    top.finish();
    add_overrides(study, overrides);
    return study;
  }

 private:
  // Scenario, seeds, [set], `with` and axes of `table`, over those of `common`.
  Part read_part(TableReader& table, Part part, std::string_view axes) {
    if (table.has("scenario")) part.scenario = beside(table.place("scenario"), path_, table.text("scenario"));
    if (auto seeds = table.seeds("seeds"); !seeds.empty()) part.seeds = std::move(seeds);
    for (const auto& file : table.texts("with")) {
      if (auto change = read_overlay(beside(table.place("with"), path_, file), table.place("with"), table.path("with"),
                                     problems_))
        part.changes.push_back(std::move(*change));
    }
    for (auto& change : read_set(table)) part.changes.push_back(std::move(change));
    const auto list = table.tables(axes);
    std::set<std::string> own;
    for (std::size_t i = 0; i < list.size(); ++i) {
      Axis axis = read_axis(*list[i], table.path(axes) + "[" + std::to_string(i) + "]");
      if (!own.insert(axis.name).second)
        problems_.push_back({list[i]->place, table.path(axes), "has two axes named \"" + axis.name + "\""});
      const auto same =
          std::find_if(part.axes.begin(), part.axes.end(), [&](const Axis& a) { return a.name == axis.name; });
      if (same != part.axes.end()) *same = std::move(axis);
      else part.axes.push_back(std::move(axis));
    }
    return part;
  }

  std::vector<Part> read_parts(TableReader& top, const Part& common) {
    std::vector<Part> parts;
    const auto list = top.tables("parts");
    if (top.has("parts") && list.empty()) top.report("parts", "is an empty list: give at least one part, or none");
    for (std::size_t i = 0; i < list.size(); ++i) {
      TableReader table(*list[i], "parts[" + std::to_string(i) + "]", problems_);
      table.require("name");
      const std::string name = table.text("name");
      check_name(table, name);
      if (std::any_of(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; }))
        table.report("name", "is the name of an earlier part");
      parts.push_back(read_part(table, common, "axes"));
      parts.back().name = name;
      parts.back().place = list[i]->place;
      table.finish();
    }
    if (list.empty()) parts.push_back(common);
    for (const Part& part : parts) check_part(part, top);
    return parts;
  }

  void check_part(const Part& part, TableReader& top) {
    const std::string key = part.name.empty() ? "" : "parts." + part.name;
    const auto place = part.name.empty() ? top.place("") : part.place;
    const bool by_axis = std::any_of(part.axes.begin(), part.axes.end(), [](const Axis& axis) {
      return !axis.values.empty() && std::all_of(axis.values.begin(), axis.values.end(),
                                                 [](const AxisValue& v) { return !v.scenario.empty(); });
    });
    if (part.scenario.empty() && !by_axis)
      problems_.push_back({place, key, "has no scenario: name the file to start from, scenario = \"...\""});
    if (part.seeds.empty() && !seeds_at_fault())
      problems_.push_back({place, key, "has no seeds: give them as seeds = \"1-50\""});
  }
  [[nodiscard]] bool seeds_at_fault() const {
    return std::any_of(problems_.begin(), problems_.end(), [](const Problem& p) { return p.key.ends_with("seeds"); });
  }

  // ---------------------------------------------------------------------------------- axes --

  Axis read_axis(const Node& node, const std::string& path) {
    TableReader table(node, path, problems_);
    Axis axis;
    const std::string key = table.text("key");
    const auto keys = table.texts("keys");
    if (table.has("key") == table.has("keys"))
      table.report("", "needs either key, a key of a scenario, or keys, a list of keys that vary together");
    check_keys(table, key, keys);
    axis.name = table.text("name", last_name(keys.empty() ? key : keys.front()));
    check_name(table, axis.name);
    if (taken(axis.name))
      table.report("name", "\"" + axis.name + "\" is a column of results; give the axis another name");
    axis.title = table.text("title", words_of_name(axis.name));
    table.require("values");
    if (const Node* values = table.list("values")) {
      for (const Node& value : *values->array()) {
        axis.values.push_back(keys.empty() ? read_value(value, key, table) : read_zipped(value, keys, table));
      }
    }
    if (is_identifying(axis.name) && (table.has("labels") || !told_by_its_column(axis)))
      table.report("name", "\"" + axis.name +
                               "\" is a column of runs, which holds no labels and does not tell these values "
                               "apart; give the axis another name");
    read_labels(table, axis);
    table.finish();
    return axis;
  }

  // Names of the tables' other columns.
  static bool taken(const std::string& name) {
    constexpr std::string_view others[] = {"study", "part", "run", "error", "metric", "runs", "missing", "hash"};
    return (is_metric(name) && !is_identifying(name)) ||
           std::find(std::begin(others), std::end(others), name) != std::end(others);
  }

  // In the table a column of the same name stands for the axis: one change a value, all different.
  static bool told_by_its_column(const Axis& axis) {
    std::set<std::string> told;
    for (const auto& value : axis.values) {
      if (value.scenario.empty() && value.changes.size() == 1 && !value.changes.front().key.empty())
        told.insert(value.label);
    }
    return told.size() == axis.values.size();
  }

  static void check_keys(TableReader& table, const std::string& key, const std::vector<std::string>& keys) {
    const auto check = [&](std::string_view name, const std::string& one) {
      if (one.empty()) table.report(name, "is empty; keys look like radio.loss");
      if (one == "seed") table.report(name, std::string("is seed; ") + seeds_instead);
    };
    if (table.has("key")) check("key", key);
    for (const auto& one : keys) check("keys", one);
  }

  static std::string last_name(const std::string& key) {
    const auto dot = key.rfind('.');
    return dot == std::string::npos ? key : key.substr(dot + 1);
  }

  AxisValue read_value(const Node& value, const std::string& key, TableReader& table) {
    AxisValue result;
    result.label = label_of(value);
    if (key == "scenario" || key == "with") {
      if (!value.string()) {
        table.report("values", "holds " + value.describe() + "; key = \"" + key + "\" needs names of files");
        return result;
      }
      result.label = value.string()->empty() ? "none" : std::filesystem::path(*value.string()).stem().string();
      if (key == "scenario") result.scenario = beside(value.place, path_, *value.string());
      else if (!value.string()->empty()) {
        if (auto change =
                read_overlay(beside(value.place, path_, *value.string()), value.place, table.path("values"), problems_))
          result.changes.push_back(std::move(*change));
      }
      return result;
    }
    result.changes.push_back({key, config::as_option(value)});
    return result;
  }

  AxisValue read_zipped(const Node& value, const std::vector<std::string>& keys, TableReader& table) {
    AxisValue result;
    const auto* items = value.array();
    if (!items || items->size() != keys.size()) {
      table.report("values", "holds " + value.describe() + "; with " + std::to_string(keys.size()) +
                                 " keys each value is a list of " + std::to_string(keys.size()));
      return result;
    }
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const AxisValue one = read_value((*items)[k], keys[k], table);
      if (!one.scenario.empty()) result.scenario = one.scenario;
      result.changes.insert(result.changes.end(), one.changes.begin(), one.changes.end());
      result.label += (k > 0 ? "," : "") + one.label;
    }
    return result;
  }

  static void read_labels(TableReader& table, Axis& axis) {
    const auto labels = table.texts("labels");
    if (!labels.empty() && labels.size() != axis.values.size()) {
      table.report("labels",
                   "are " + std::to_string(labels.size()) + " for " + std::to_string(axis.values.size()) + " values");
      return;
    }
    std::set<std::string> seen;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      std::string& label = axis.values[i].label;
      if (!labels.empty()) label = labels[i];
      if (label.empty()) table.report("labels", "are needed: value " + std::to_string(i + 1) + " has no short text");
      if (!seen.insert(label).second && !label.empty())
        table.report(labels.empty() ? "values" : "labels", "holds \"" + label + "\" twice");
    }
  }

  // ---------------------------------------------------------------------------- statistics --

  // That some part has an axis of that name with that label.
  static void check_label(TableReader& table, std::string_view name, const std::string& label, const std::string& axis,
                          const std::vector<Part>& parts) {
    std::vector<std::string_view> known;
    for (const auto& part : parts) {
      for (const auto& one : part.axes) {
        if (one.name == axis)
          for (const auto& value : one.values) known.push_back(value.label);
      }
    }
    if (std::find(known.begin(), known.end(), label) != known.end()) return;
    const auto near = config::nearest(label, known);
    table.report(name, "\"" + label + "\" is no value of the axis \"" + axis + "\"" +
                           (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?"));
  }

  void read_statistics(TableReader& top, Study& study) {
    auto& plan = study.statistics;
    plan.metrics = {
        "complete",           "normalized_time", "disconnected_time_ratio", "disconnected_time_ratio_by_distance",
        "fiedler_time_ratio", "committed"};
    const auto known = axis_names(study.parts);
    if (!known.empty() && std::find(known.begin(), known.end(), plan.compare) == known.end())
      plan.compare = known.front();
    const Node* node = top.table("statistics");
    if (!node) return;
    TableReader table(*node, "statistics", problems_);
    if (auto metrics = table.texts("metrics"); !metrics.empty()) plan.metrics = std::move(metrics);
    for (const auto& metric : plan.metrics) check_metric(table, "metrics", metric);
    plan.compare = table.text("compare", plan.compare);
    if (table.has("compare")) check_axis(table, "compare", plan.compare, known);
    plan.against = table.texts("against");
    for (const auto& label : plan.against) check_label(table, "against", label, plan.compare, study.parts);
    plan.confidence = table.number("confidence", plan.confidence, {0.5, 0.9999});
    plan.margin = table.number("margin", plan.margin, {0.0, 1.0});
    plan.resamples = static_cast<std::size_t>(table.whole("resamples", 2000, {100, 1e6}));
    if (const Node* by = table.list("by")) {
      for (const auto& group : *by->array()) {
        plan.by.emplace_back();
        const auto* names = group.array();
        if (!names) table.report("by", "is a list of lists of axes, such as [[\"algorithm\", \"r\"], [\"algorithm\"]]");
        for (std::size_t i = 0; names && i < names->size(); ++i) {
          const auto* name = (*names)[i].string();
          plan.by.back().push_back(name ? *name : "");
          check_axis(table, "by", name ? *name : (*names)[i].describe(), known);
        }
      }
    }
    table.finish();
  }

  // ----------------------------------------------------------------------------- overrides --

  void add_overrides(Study& study, const std::vector<config::Override>& overrides) {
    for (const auto& o : overrides) {
      std::vector<KeyChange> changes;
      if (o.file.empty()) {
        if (auto change = read_assignment(o)) {
          check_varied(study, o, change->key);
          changes.push_back(std::move(*change));
        }
      } else if (auto change = read_overlay(o.file, {}, o.origin, problems_)) {
        changes.push_back(std::move(*change));
      }
      for (auto& part : study.parts) part.changes.insert(part.changes.end(), changes.begin(), changes.end());
    }
  }

  // An axis has the last word on its keys: an option for one of them would do nothing.
  void check_varied(const Study& study, const config::Override& o, const std::string& key) {
    for (const auto& part : study.parts) {
      for (const auto& axis : part.axes) {
        const bool varied = std::any_of(axis.values.begin(), axis.values.end(), [&](const AxisValue& value) {
          return std::any_of(value.changes.begin(), value.changes.end(),
                             [&](const KeyChange& c) { return c.key == key; });
        });
        if (!varied) continue;
        Problem problem;
        problem.place.origin = std::make_shared<const std::string>(o.origin);
        problem.key = key;
        problem.text = "is varied by the axis \"" + axis.name + "\"";
        problems_.push_back(std::move(problem));
        return;
      }
    }
  }

  // "key=value", applied later: a key may refer to a list that only the scenario has.
  std::optional<KeyChange> read_assignment(const config::Override& o) {
    const auto equals = std::min(o.assignment.find('='), o.assignment.size());
    std::string key = o.assignment.substr(0, equals);
    key.erase(0, key.find_first_not_of(' '));
    key.erase(key.find_last_not_of(' ') + 1);
    Node tree{Node::Table{}, {}};
    const bool whole = key.empty() || equals == o.assignment.size();  // not of that form: reported later
    auto found = config::apply(tree, {whole ? o.assignment : "value" + o.assignment.substr(equals), o.origin});
    if (key == "seed") {
      Problem problem;
      problem.place.origin = std::make_shared<const std::string>(o.origin);
      problem.key = key;
      problem.text = seeds_instead;
      found.push_back(std::move(problem));
    }
    problems_.insert(problems_.end(), found.begin(), found.end());
    Node* value = tree.find("value");
    if (!found.empty() || !value) return std::nullopt;
    return KeyChange{key, std::move(*value)};
  }

  std::string path_;
  std::vector<Problem>& problems_;
};

}  // namespace

double Part::combinations() const noexcept {
  double product = 1.0;
  for (const auto& axis : axes) product *= static_cast<double>(axis.values.size());
  return product;
}

LoadedStudy parse_study(const std::string& path, std::string_view text,
                        const std::vector<config::Override>& overrides) {
  LoadedStudy loaded;
  try {
    const Node root = with_base(config::parse_document(path, text), path, loaded.problems);
    loaded.study = StudyReader(path, loaded.problems).read(root, overrides);
    loaded.study.path = path;
    loaded.study.text = text;
    std::stable_sort(loaded.problems.begin(), loaded.problems.end(),
                     [](const Problem& a, const Problem& b) { return a.place.line < b.place.line; });
  } catch (const config::DocumentError& e) { loaded.problems.push_back(e.problem); }
  return loaded;
}

LoadedStudy load_study(const std::string& path, const std::vector<config::Override>& overrides) {
  try {
    return parse_study(path, config::read_text_file(path), overrides);
  } catch (const config::DocumentError& e) { return {{}, {e.problem}}; }
}

}  // namespace banyan::study
