// SPDX-License-Identifier: MIT
// What a study file says: which runs, and what is to be made of their results. docs/studies.md
// describes the file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "banyan/config/config.hpp"

namespace banyan::study {

// A change to a scenario: a key and its value, or (key "") a tree of keys laid over it.
struct KeyChange {
  std::string key;
  config::Node value;
};

struct AxisValue {
  std::string label;     // "9", "on", "tuned": in folder names, tables and figures
  std::string scenario;  // another base scenario, "" if it stays
  std::vector<KeyChange> changes;
};

// What is varied: one key, several keys that vary together (zipped), the base scenario, or files
// laid over it.
struct Axis {
  std::string name;               // "r"; unique in its part
  std::string title;              // for figures, "target radius r (m)"; the name in words by default
  std::vector<AxisValue> values;  // not empty, labels unique
};

// A block of runs: every combination of its axes' values, each with every seed.
struct Part {
  std::string name;                // "" if the file has no [[parts]]
  std::string scenario;            // path of the base scenario
  std::vector<KeyChange> changes;  // to all of its runs
  std::vector<Axis> axes;
  std::vector<std::uint64_t> seeds;
  config::Place place;
  [[nodiscard]] double combinations() const noexcept;  // may be huge
};

// Runs picked by the labels of axes: every axis named must have one of these labels.
using Where = std::vector<std::pair<std::string, std::vector<std::string>>>;

enum class FigureScale { linear, log, ratio };  // ratio: logarithmic, to the same run of another series

// What a figure shows upwards.
struct FigureMetric {
  std::string column;  // of the table, of numbers or booleans
  std::string title;
  FigureScale scale = FigureScale::linear;
};

// Box plots (paper Figs. 5-7): one figure per combination of the labels of `each`, a panel per label of `panels` and
// metric, a group of boxes per combination of labels of `x`, a colour per label of `series`.
struct FigurePlan {
  std::string name;  // file name without ending
  std::string title;
  std::vector<FigureMetric> metrics;  // not empty
  std::string ratio_to;               // a label of `series`, where a scale is a ratio
  std::string part;
  Where where;
  std::vector<std::string> each, x;
  std::string panels, series;
  std::optional<std::size_t> columns;
  std::optional<double> y_minimum, y_maximum;
  std::optional<double> width_in;  // 3.5 or 7
};

struct StatisticsPlan {
  std::vector<std::string> metrics;  // columns of the table
  // Axes by which runs are grouped; the other axes are pooled. One more grouping, by all axes, is
  // always made.
  std::vector<std::vector<std::string>> by;
  std::string compare = "algorithm";  // axis whose values are compared pair by pair, in parts that have it;
                                      // the first axis of the study if there is none of this name
  std::vector<std::string> against;   // labels of it: only comparisons with one of these; empty: all pairs
  double confidence = 0.95;
  double margin = 0.05;  // of the median of the second value; of shares the difference: less does not matter
  std::size_t resamples = 2000;
};

struct Study {
  std::string name;
  std::string description;
  std::string path;         // of the file
  std::string text;         // its content
  std::vector<Part> parts;  // not empty
  std::vector<FigurePlan> figures;
  StatisticsPlan statistics;
};

struct LoadedStudy {
  Study study;  // complete only if ok()
  std::vector<config::Problem> problems;
  [[nodiscard]] bool ok() const noexcept { return problems.empty(); }
};

// Reads a study (TOML or JSON); paths in it are relative to it. `overrides` change all runs
// (`--set`, `--with`). Everything wrong with the file itself is reported at once; what is wrong with
// the scenarios that come out of it is found by make_plan().
[[nodiscard]] LoadedStudy load_study(const std::string& path, const std::vector<config::Override>& overrides = {});
[[nodiscard]] LoadedStudy parse_study(const std::string& path, std::string_view text,
                                      const std::vector<config::Override>& overrides = {});

}  // namespace banyan::study
