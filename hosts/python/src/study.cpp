// SPDX-License-Identifier: MIT
// A study from Python: the same plan, journal, workers and tables as `banyan study`, in the same folders.
#include <algorithm>
#include <filesystem>
#include <mutex>
#include <thread>

#include "banyan/study/execute.hpp"
#include "banyan/study/folder.hpp"
#include "banyan/study/journal.hpp"
#include "banyan/study/plan.hpp"
#include "banyan/study/study.hpp"
#include "banyan/study/workers.hpp"
#include "banyan/version.hpp"
#include "binding.hpp"

namespace banyan::python {

namespace {

using namespace study;

// Workers get a function and no more, so what it needs is here: one study at a time in a process.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
const AlgorithmList* algorithms_of_study = nullptr;
std::mutex one_study;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
std::string simulate_one(std::string_view task) { return simulate(task, *algorithms_of_study); }

struct Wanted {
  std::string folder;
  int threads = 0;  // 0: as many as there are cores
  Shard shard;
  bool replace = false, retry = false, extend = false, mix_versions = false;
};

[[noreturn]] void refuse(const std::vector<config::Problem>& problems) {
  std::string text;
  for (const config::Problem& problem : problems)
    if (!problem.warning) text += (text.empty() ? "" : "\n") + to_string(problem);
  throw ScenarioFault(text);
}

// No existing results may get lost: a folder is used only if it belongs to this very study.
void check_folder(const Folder& folder, const Study& study, const Plan& plan, const Wanted& wanted) {
  std::error_code ignored;
  const auto there = finished(folder);
  if (!there && journals_in(folder.path).empty()) {
    for (const std::string& path :
         {folder.table(), folder.statistics(), folder.comparisons(), folder.figures(), folder.runs()})
      if (std::filesystem::exists(path, ignored))
        throw std::invalid_argument(path + " is not of a study; choose another folder by out=");
  }
  if (!there || wanted.extend || wanted.replace) return;
  if (there->study != study.name)
    throw std::invalid_argument(folder.path + " holds the finished study \"" + there->study +
                                "\"; choose another folder by out=");
  if (there->plan != plan_text(plan))
    throw std::invalid_argument(
        folder.path +
        " holds this study finished with another plan; extend=True keeps the runs that both "
        "have and makes the tables anew, replace=True starts over, or choose another folder by out=");
}

void check_builds(const Gathered& gathered, bool mix_versions) {
  if (mix_versions) return;
  for (const std::string& build : gathered.builds)
    if (build != this_build())
      throw std::invalid_argument(
          "the results that are there were made by banyan " + build + ", and this is " + this_build() +
          ": mix_versions=True goes on with both, replace=True starts over, or choose another folder by out=");
}

void check_controllers(const Plan& plan, const Gathered& gathered, bool retry) {
  if (retry) return;
  std::string names;
  for (const std::string& name : changed_algorithms(plan, gathered.outcomes))
    names += (names.empty() ? "\"" : ", \"") + name + "\"";
  if (!names.empty())
    throw std::invalid_argument("the results that are there for " + names +
                                " were made by another version of the controller: retry=True does its runs anew and "
                                "keeps the others, replace=True starts over, or choose another folder by out=");
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw record::FileError(path, "cannot create", error.value());
}

Standing carry_out(const Plan& plan, const std::vector<std::size_t>& todo, const Study& study, const Folder& folder,
                   const Wanted& wanted, const py::object& told) {
  Journal journal(folder.journal(wanted.shard), study.name, std::string(version), std::string(git_id()));
  const int cores = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 256U));
  const auto workers = thread_workers(simulate_one, wanted.threads > 0 ? wanted.threads : cores);
  const py::object* const raised_by = &told;
  std::optional<py::error_already_set> raised;  // what ended it, once the workers are idle
  const Standing standing = execute(plan, todo, *workers, journal, folder.runs(), [&](const Standing& now) {
    const py::gil_scoped_acquire interpreter;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!raised_by->is_none()) (*raised_by)(now.done, now.wanted, now.failed, now.share);
    } catch (const py::error_already_set& error) {
      raised.emplace(error);
      return false;
    }
    return true;
  });
  if (raised) throw py::error_already_set(*raised);
  return standing;
}

py::dict run_study(const std::string& path, const std::optional<std::string>& text,
                   const std::vector<std::pair<std::string, std::string>>& changes, const py::sequence& own,
                   const std::string& folder_path, int threads, std::size_t shard, std::size_t shards, bool replace,
                   bool retry, bool extend, bool mix_versions,
                   const std::pair<std::string, std::string>& python_and_figures, const py::object& told) {
  const std::unique_lock alone(one_study, std::try_to_lock);
  if (!alone) throw std::runtime_error("another study is running in this process");
  const auto algorithms = algorithms_from(own);
  algorithms_of_study = &algorithms->list;
  const auto overrides = overrides_of(changes);
  const auto loaded = text ? parse_study(path, *text, overrides) : load_study(path, overrides);
  if (!loaded.ok()) refuse(loaded.problems);
  const Study& study = loaded.study;
  const Wanted wanted{folder_path.empty() ? "out/" + study.name : folder_path,
                      threads,
                      {shard, shards},
                      replace,
                      retry,
                      extend,
                      mix_versions};
  const Folder folder{wanted.folder};
  py::dict told_back;
  Standing standing;
  {
    const py::gil_scoped_release others;
    const Plan plan = make_plan(study, algorithms->list);
    if (!plan.ok()) refuse(plan.problems);
    check_folder(folder, study, plan, wanted);
    if (replace) throw_away(folder);
    auto gathered = gather(journals_in(folder.path), study.name);
    check_builds(gathered, mix_versions);
    check_controllers(plan, gathered, retry);
    const auto todo = runs_to_do(plan, wanted.shard, gathered.outcomes, retry);
    make_folder(folder.path + "/journal");
    if (!todo.empty()) {
      standing = carry_out(plan, todo, study, folder, wanted, told);
      gathered = gather(journals_in(folder.path), study.name);
    }
    const Drawer drawer{python_and_figures.second, {python_and_figures.first}};
    std::string complaint;
    if (wanted.shard.whole() && !standing.stopped)
      complaint = write_results(study, plan, gathered, folder, drawer).complaint;
    const Results results(study, plan, gathered.outcomes);
    const std::string csv = results.csv();
    const py::gil_scoped_acquire interpreter;
    told_back["csv"] = csv;
    told_back["complaint"] = complaint;
    told_back["missing"] = results.missing();
    told_back["failed"] = results.failed();
  }
  told_back["name"] = study.name;
  told_back["folder"] = folder.path;
  told_back["done"] = standing.done;
  return told_back;
}

}  // namespace

void bind_study(py::module_& m) {
  m.def("study", &run_study, py::arg("path"), py::arg("text"), py::arg("changes"), py::arg("controllers"),
        py::arg("folder"), py::arg("threads"), py::arg("shard"), py::arg("shards"), py::arg("replace"),
        py::arg("retry"), py::arg("extend"), py::arg("mix_versions"), py::arg("python_and_figures"), py::arg("told"));
}

}  // namespace banyan::python
