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
constexpr int study_format_version = 1;

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
          {"format_version", study_format_version},
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

std::vector<std::size_t> runs_to_do(const Plan& plan, const Shard& shard, const Outcomes& known, bool retry) {
  std::vector<std::size_t> todo;
  for (std::size_t run = 0; run < plan.runs.size(); ++run) {
    if (!shard.holds(run)) continue;
    const auto at = known.find(plan.runs[run].id);
    if (at == known.end() || (retry && !at->second.error.empty())) todo.push_back(run);
  }
  return todo;
}

std::vector<std::string> changed_algorithms(const Plan& plan, const Outcomes& known) {
  std::vector<std::string> changed;
  for (const PlannedRun& run : plan.runs) {
    if (run.id == run.configured() || known.contains(run.id)) continue;
    const auto at = known.lower_bound(run.configured());
    if (at == known.end() || !at->first.starts_with(run.configured())) continue;
    const std::string& name = plan.combinations[run.combination].scenario.mission.algorithm;
    if (std::find(changed.begin(), changed.end(), name) == changed.end()) changed.push_back(name);
  }
  return changed;
}

// No other process may work here while files are removed: its new files would be removed with the rest. study.json
// goes last: until then the folder is recognised as that of a study.
void throw_away(const Folder& folder) {
  namespace fs = std::filesystem;
  std::vector<JournalLock> journals;
  for (auto& journal : journals_in(folder.path)) journals.emplace_back(std::move(journal));
  std::error_code ignored;
  for (const auto& file : {folder.table(), folder.statistics(), folder.comparisons()}) fs::remove(file, ignored);
  fs::remove_all(folder.figures(), ignored);
  fs::remove_all(folder.runs(), ignored);
  for (auto& journal : journals) journal.remove();
  fs::remove(folder.json(), ignored);
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
  if (value_in<double>(json, "format_version") != study_format_version)
    throw FileError(folder.json(),
                    "was written by another version of banyan; go on with that one, or in another folder");
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

// A row that this program cannot put into its tables counts as a run that failed.
static Outcome readable(const Outcome& outcome, const std::string& path) {
  if (!outcome.error.empty() || record::run_cells(outcome.row)) return outcome;
  return {"", path + ": the row was written by another version of banyan; --retry runs it again", outcome.wall_s};
}

static void add_build(Gathered& gathered, const std::string& build) {
  if (std::find(gathered.builds.begin(), gathered.builds.end(), build) == gathered.builds.end())
    gathered.builds.push_back(build);
}

static void add_outcome(Gathered& gathered, const std::string& path, const std::string& id, const Outcome& written) {
  const Outcome outcome = readable(written, path);
  const auto [at, added] = gathered.outcomes.emplace(id, outcome);
  if (added) return;
  if (!at->second.error.empty()) at->second = outcome;
  else if (outcome.error.empty() && !same_result(outcome.row, at->second.row))
    throw FileError(path, "holds another result of the run " + id +
                              " than was read before: builds or "
                              "machines that do not agree");
}

static void gather_journal(Gathered& gathered, const std::string& path, const std::string& study) {
  const auto content = read_journal(path);
  if (content.bytes == 0) return;  // killed before its first line
  if (content.study != study)
    throw FileError(path, "belongs to the study \"" + content.study + "\", not to \"" + study + "\"");
  for (const auto& build : content.builds) add_build(gathered, build);
  for (const auto& entry : content.entries) add_outcome(gathered, path, entry.id, entry.outcome);
}

// Where the columns of a table stand.
struct TableColumns {
  std::size_t study = 0, run = 0, error = 0, count = 0;
  std::vector<std::size_t> of_run;  // by column of a run
};

[[noreturn]] static void refuse_table(const std::string& path, const std::string& why) {
  throw FileError(path, why +
                            ": the table was written by another version of banyan; collect it with that version, "
                            "or run the study again");
}

static TableColumns table_columns(const std::string& path, const std::string& header) {
  const auto names = record::csv_cells(header);
  const auto find = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  TableColumns columns{find("study"), find("run"), find("error"), names.size(), {}};
  if (std::max({columns.study, columns.run, columns.error}) == names.size())
    throw FileError(path, "has no columns \"study\", \"run\" and \"error\": not the table of a study");
  for (const auto& column : record::run_columns()) {
    columns.of_run.push_back(find(column.name));
    if (columns.of_run.back() == names.size()) refuse_table(path, "has no column \"" + std::string(column.name) + "\"");
  }
  return columns;
}

static void gather_row(Gathered& gathered, const std::string& path, const std::vector<std::string>& cells,
                       const TableColumns& columns) {
  std::string row, version, git;
  for (std::size_t c = 0; c < columns.of_run.size(); ++c) {
    const std::string& cell = cells[columns.of_run[c]];
    row += (c > 0 ? "," : "") + record::csv_quoted(cell);
    if (record::run_columns()[c].name == "version") version = cell;
    if (record::run_columns()[c].name == "git") git = cell;
  }
  const std::string& error = cells[columns.error];
  if (error.empty() && !record::run_cells(row)) refuse_table(path, "has rows of another format_version");
  add_build(gathered, build_text(version, git));
  add_outcome(gathered, path, cells[columns.run], {error.empty() ? row : "", error, 0.0});
}

// The end of the line that begins there: a cell in quotes may hold line breaks.
static std::size_t end_of_line(const std::string& text, std::size_t begin) {
  bool quoted = false;
  for (std::size_t k = begin; k < text.size(); ++k) {
    if (text[k] == '"') quoted = !quoted;
    if (text[k] == '\n' && !quoted) return k;
  }
  return text.size();
}

static void gather_table(Gathered& gathered, const std::string& path, const std::string& study) {
  const record::InputFile file(path);
  std::string text;
  if (!file.read(0, file.size(), text)) throw FileError(path, "cannot be read");
  std::size_t number = 0;
  TableColumns columns;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = end_of_line(text, begin);
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (++number == 1) {
      columns = table_columns(path, line);
      continue;
    }
    const auto cells = record::csv_cells(line);
    if (cells.size() != columns.count)
      throw FileError(path, "line " + std::to_string(number) + " has " + std::to_string(cells.size()) + " cells of " +
                                std::to_string(columns.count));
    if (cells[columns.study] != study)
      throw FileError(path, "belongs to the study \"" + cells[columns.study] + "\", not to \"" + study + "\"");
    gather_row(gathered, path, cells, columns);
  }
}

std::vector<std::string> sources_in(const std::string& folder) {
  auto sources = journals_in(folder);
  std::error_code none;
  if (const std::string table = Folder{folder}.table(); sources.empty() && std::filesystem::exists(table, none))
    sources.push_back(table);
  return sources;
}

Gathered gather(const std::vector<std::string>& sources, const std::string& study) {
  Gathered gathered;
  for (const auto& path : sources) {
    if (path.ends_with(".csv")) gather_table(gathered, path, study);
    else gather_journal(gathered, path, study);
  }
  return gathered;
}

Drawn write_results(const Study& study, const Plan& plan, const Gathered& gathered, const Folder& folder,
                    const Drawer& drawer) {
  const Results results(study, plan, gathered.outcomes);
  record::write_file(folder.table(), results.csv(), Existing::replace);
  record::write_file(folder.statistics(), statistics_csv(study, results), Existing::replace);
  record::write_file(folder.comparisons(), comparisons_csv(study, results), Existing::replace);
  Drawn drawn;
  if (!study.figures.empty()) {
    std::error_code error;
    std::filesystem::create_directories(folder.figures(), error);
    if (error) throw FileError(folder.figures(), "cannot be created: " + error.message());
    drawn = draw_figures(study, results, folder.figures(), drawer);
  }
  // Last, since it shows that the rest is complete.
  // Paths may hold any bytes.
  const auto json = study_json(study, plan, gathered.outcomes, results, gathered.builds);
  record::write_file(folder.json(), json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n",
                     Existing::replace);
  return drawn;
}

}  // namespace banyan::study
