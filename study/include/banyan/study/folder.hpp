// SPDX-License-Identifier: MIT
// Where a study keeps what: everything below one folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "banyan/study/plan.hpp"
#include "banyan/study/report.hpp"
#include "banyan/study/results.hpp"

namespace banyan::study {

// journal/      raw results, a line per run as it finishes: never rewritten
// runs/         recordings and series, where the study asks for them
// runs.csv, statistics.csv, comparisons.csv, figures/, study.json    made from the journal
struct Folder {
  std::string path;
  [[nodiscard]] std::string journal(const Shard& shard) const;
  [[nodiscard]] std::string runs() const { return path + "/runs"; }
  [[nodiscard]] std::string table() const { return path + "/runs.csv"; }
  [[nodiscard]] std::string statistics() const { return path + "/statistics.csv"; }
  [[nodiscard]] std::string comparisons() const { return path + "/comparisons.csv"; }
  [[nodiscard]] std::string figures() const { return path + "/figures"; }
  [[nodiscard]] std::string json() const { return path + "/study.json"; }
};

// What study.json of a finished study says.
struct Finished {
  std::string study;
  std::string plan;  // Plan::digest, hexadecimal
  std::uint64_t runs = 0;
};
// Nothing if the study has not finished there; throws record::FileError for a study.json that is none.
[[nodiscard]] std::optional<Finished> finished(const Folder& folder);

// What is known of the runs of a study: its journals, or the table runs.csv of a folder that was kept without them.
[[nodiscard]] std::vector<std::string> sources_in(const std::string& folder);
// Results of several journals and tables together.
struct Gathered {
  Outcomes outcomes;
  std::vector<std::string> builds;  // "0.2.0 (git 123abc)" of each journal, each once
};
// A run that failed and succeeded elsewhere has succeeded; one whose row in a journal another version wrote has failed.
// Throws record::FileError for what read_journal() throws, for a source of another study, for a table that is damaged
// or of another version, and for two different results of one run.
[[nodiscard]] Gathered gather(const std::vector<std::string>& sources, const std::string& study);

// All that a study has written there, for it to start over. Throws record::FileBusy while another process writes there.
void throw_away(const Folder& folder);

// Indices of the shard's runs that are not known yet; with `retry` those that have failed, too.
[[nodiscard]] std::vector<std::size_t> runs_to_do(const Plan& plan, const Shard& shard, const Outcomes& known,
                                                  bool retry);

// Of the algorithms whose results are there, the names of those that have another fingerprint now: some run of the plan
// is known of another one only.
[[nodiscard]] std::vector<std::string> changed_algorithms(const Plan& plan, const Outcomes& known);

// "0.2.0 (git 123abc)" of this program.
[[nodiscard]] std::string this_build();

// Writes everything that is made from the journals, replacing what was made before; returns what became of the figures.
// Throws record::FileError.
Drawn write_results(const Study& study, const Plan& plan, const Gathered& gathered, const Folder& folder,
                    const Drawer& drawer = {});

}  // namespace banyan::study
