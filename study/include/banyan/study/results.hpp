// SPDX-License-Identifier: MIT
// The table of a study: what every planned row came to.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/study/plan.hpp"
#include "banyan/study/simulate.hpp"

namespace banyan::study {

using Outcomes = std::map<std::string, Outcome, std::less<>>;  // by id

// A column of results: NaN where there is none. Booleans are 0 or 1.
using Values = std::vector<double>;

class Results {
 public:
  // Rows whose outcome is not there are missing: counted, and left out of every table. Outcomes are as gather()
  // has them: one without an error has a row of this program's columns. All arguments must outlive it.
  Results(const Study& study, const Plan& plan, const Outcomes& outcomes);

  // The axes' names over all parts, each once, in order of appearance.
  [[nodiscard]] const std::vector<std::string>& axes() const noexcept { return axes_; }
  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
  [[nodiscard]] std::size_t rows() const noexcept { return present_.size(); }
  [[nodiscard]] std::size_t missing() const noexcept { return plan_.rows.size() - present_.size(); }
  [[nodiscard]] std::size_t failed() const noexcept { return failed_; }

  [[nodiscard]] const PlannedRow& planned(std::size_t row) const noexcept { return plan_.rows[present_[row]]; }
  // The label of an axis, "" if the row's part has no such axis.
  [[nodiscard]] const std::string& label(std::size_t row, std::string_view axis) const;
  [[nodiscard]] Values values(std::string_view column) const;

  // The tidy table: study, part, run, the axes that are no columns of a run anyway, error, and the
  // columns of a run (record/table.hpp). The same bytes for the same plan and program.
  [[nodiscard]] std::string csv() const;

 private:
  const Study& study_;
  const Plan& plan_;
  std::vector<std::string> axes_;
  std::vector<std::size_t> present_;             // rows of the plan
  std::vector<std::string> errors_;              // of these, "" if there is none
  std::vector<std::vector<std::string>> cells_;  // of these, by column of a run; empty if failed
  std::size_t failed_ = 0;
};

// Whether `name` is a column of a run that holds numbers or booleans; and all such columns.
[[nodiscard]] bool is_metric(std::string_view name);
[[nodiscard]] bool is_boolean(std::string_view name);
[[nodiscard]] std::vector<std::string_view> metrics();
// Whether `name` is a column of a run that says what was run (algorithm, range_m, seed ...).
[[nodiscard]] bool is_identifying(std::string_view name);

}  // namespace banyan::study
