// SPDX-License-Identifier: MIT
// Reads a table of a file strictly, for files that are no scenarios (studies, tunings): each key is
// asked for by name and type, and what nobody has asked for is an error with the nearest name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/config/document.hpp"
#include "banyan/config/keys.hpp"

namespace banyan::config {

class TableReader {
 public:
  // `path` names the table in messages ("figures[1]", "" at the top). All three must outlive the
  // reader. Faults go to `problems`; every function then returns as if the key were not there.
  TableReader(const Node& table, std::string path, std::vector<Problem>& problems);

  [[nodiscard]] std::string text(std::string_view name, std::string fallback = "");
  [[nodiscard]] bool boolean(std::string_view name, bool fallback);
  [[nodiscard]] double number(std::string_view name, double fallback, const Range& range = {});
  [[nodiscard]] std::optional<double> number(std::string_view name, const Range& range = {});
  [[nodiscard]] std::int64_t whole(std::string_view name, std::int64_t fallback, const Range& range = {});
  // The index of one of `names`.
  [[nodiscard]] std::size_t choice(std::string_view name, const std::vector<std::string_view>& names,
                                   std::size_t fallback);
  // A list of texts, or a single text for a list of one; not empty if it is there.
  [[nodiscard]] std::vector<std::string> texts(std::string_view name);
  // Seeds, each a whole number from 0 to 2^53, none twice: a list of numbers, or "1-50".
  [[nodiscard]] std::vector<std::uint64_t> seeds(std::string_view name);
  // Sub-tables: null if not there. A list of tables ([[axes]]): empty if not there.
  [[nodiscard]] const Node* table(std::string_view name);
  [[nodiscard]] std::vector<const Node*> tables(std::string_view name);
  // A list of any values, not empty if it is there; null if not there.
  [[nodiscard]] const Node* list(std::string_view name);
  [[nodiscard]] const Node* any(std::string_view name);

  [[nodiscard]] bool has(std::string_view name) const noexcept { return table_.find(name) != nullptr; }
  // That the key is there, else a fault.
  void require(std::string_view name, std::string_view why = "");
  void report(std::string_view name, std::string text);
  // The path of a key: "figures[1].metric".
  [[nodiscard]] std::string path(std::string_view name) const;
  [[nodiscard]] Place place(std::string_view name) const;
  // Reports the keys that nobody has asked for. Last.
  void finish();

 private:
  const Node* find(std::string_view name);

  const Node& table_;
  std::string path_;
  std::vector<Problem>& problems_;
  std::vector<std::string> known_;
};

// "1-50" or "7": a run of whole numbers, first to last. Nothing if it is none.
[[nodiscard]] std::optional<std::vector<std::uint64_t>> seed_range(std::string_view text);

}  // namespace banyan::config
