// SPDX-License-Identifier: MIT
#include "banyan/study/folder.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "banyan/record/file.hpp"
#include "banyan/record/table.hpp"
#include "banyan/study/journal.hpp"
#include "banyan/study/report.hpp"
#include "banyan/version.hpp"
#include "json_value.hpp"
#include "machine.hpp"

namespace banyan::study {
namespace {

using nlohmann::ordered_json;
using record::Existing;
using record::FileError;

constexpr std::string_view study_format = "banyan.study";

ordered_json study_json(const Study& study, const Plan& plan, const Outcomes& outcomes, const Results& results,
                        const std::vector<std::string>& builds) {
  double runs_wall_s = 0.0;  // sum over all runs, however many ran at once
  for (const auto& run : plan.runs) {
    if (const auto at = outcomes.find(run.id); at != outcomes.end()) runs_wall_s += at->second.wall_s;
  }
  ordered_json parts = ordered_json::array();
  for (const auto& part : study.parts) {
    ordered_json axes = ordered_json::array();
    for (const auto& axis : part.axes) {
      ordered_json labels = ordered_json::array();
      for (const auto& value : axis.values) labels.push_back(value.label);
      axes.push_back({{"name", axis.name}, {"title", axis.title}, {"values", labels}});
    }
    parts.push_back({{"name", part.name}, {"scenario", part.scenario}, {"seeds", part.seeds}, {"axes", axes}});
  }
  return {{"format", study_format},
          {"format_version", 1},
          {"study", study.name},
          {"description", study.description},
          {"plan", plan_text(plan)},
          {"runs", plan.runs.size()},
          {"rows", results.rows()},
          {"failed", results.failed()},
          {"missing", results.missing()},
          {"runs_wall_s", runs_wall_s},
          {"version", std::string(version)},
          {"git", std::string(git_id())},
          {"builds", builds},
          {"machine", {{"processor", processor_name()}, {"cores", std::thread::hardware_concurrency()}}},
          {"parts", parts},
          {"config", study.text}};
}

}  // namespace

std::string Folder::journal(const Shard& shard) const {
  if (shard.whole()) return path + "/journal/all.jsonl";
  return path + "/journal/shard-" + std::to_string(shard.number) + "-of-" + std::to_string(shard.count) + ".jsonl";
}

std::string this_build() { return build_text(std::string(version), std::string(git_id())); }

std::optional<Finished> finished(const Folder& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder.json(), error)) {
    if (error) throw FileError(folder.json(), "cannot read", error.value());
    return std::nullopt;
  }
  const record::InputFile file(folder.json());
  std::string text;
  if (!file.read(0, file.size(), text)) throw FileError(folder.json(), "cannot be read");
  const auto json = nlohmann::json::parse(text, nullptr, false);
  const auto study = value_in<std::string>(json, "study"), plan = value_in<std::string>(json, "plan");
  const auto runs = value_in<std::uint64_t>(json, "runs");
  if (value_in<std::string>(json, "format") != study_format || !study || !plan || !runs)
    throw FileError(folder.json(), "is not what a study writes; choose another folder, or remove it");
  return Finished{*study, *plan, *runs};
}

// The same run, whatever its name and origin: all columns from the first of the results on.
static bool same_result(const std::string& row, const std::string& other) {
  if (row == other) return true;
  const auto first = record::csv_cells(row), second = record::csv_cells(other);
  const auto& columns = record::run_columns();
  if (first.size() != second.size() || first.size() != columns.size()) return false;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!is_identifying(columns[c].name) && first[c] != second[c]) return false;
  }
  return true;
}

// The rows that this program can put into its tables. A row with other columns is ignored.
static Outcome readable(const Outcome& outcome) {
  if (!outcome.error.empty() || record::csv_cells(outcome.row).size() == record::run_columns().size()) return outcome;
  return {"", "its row has other columns: written by another version of banyan", outcome.wall_s};
}

Gathered gather(const std::vector<std::string>& journals, const std::string& study) {
  Gathered gathered;
  for (const auto& path : journals) {
    const auto content = read_journal(path);
    if (content.bytes == 0) continue;  // killed before its first line
    if (content.study != study)
      throw FileError(path, "belongs to the study \"" + content.study + "\", not to \"" + study + "\"");
    for (const auto& build : content.builds) {
      if (std::find(gathered.builds.begin(), gathered.builds.end(), build) == gathered.builds.end())
        gathered.builds.push_back(build);
    }
    for (const auto& entry : content.entries) {
      const Outcome outcome = readable(entry.outcome);
      const auto [at, added] = gathered.outcomes.emplace(entry.id, outcome);
      if (added) continue;
      if (!at->second.error.empty())
        at->second = outcome;
      else if (outcome.error.empty() && !same_result(outcome.row, at->second.row))
        throw FileError(path, "holds another result of the run " + entry.id +
                                  " than an earlier journal: builds or "
                                  "machines that do not agree");
    }
  }
  return gathered;
}

Written write_results(const Study& study, const Plan& plan, const Gathered& gathered, const Folder& folder) {
  const Results results(study, plan, gathered.outcomes);
  record::write_file(folder.table(), results.csv(), Existing::replace);
  record::write_file(folder.statistics(), statistics_csv(study, results), Existing::replace);
  record::write_file(folder.comparisons(), comparisons_csv(study, results), Existing::replace);
  Drawn drawn;
  if (!study.figures.empty()) {
    std::error_code error;
    std::filesystem::create_directories(folder.figures(), error);
    if (error) throw FileError(folder.figures(), "cannot be created: " + error.message());
    drawn = draw_figures(study, results, folder.figures());
  }
  // Last, since it shows that the rest is complete.
  // Paths may hold any bytes.
  const auto json = study_json(study, plan, gathered.outcomes, results, gathered.builds);
  record::write_file(folder.json(), json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n",
                     Existing::replace);
  return {drawn.figures, drawn.complaints};
}

}  // namespace banyan::study
