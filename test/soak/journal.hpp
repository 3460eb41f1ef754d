// SPDX-License-Identifier: MIT
// What soaks in one directory have done: a line a mission.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "watch.hpp"

namespace banyan::soak {

struct SoakRow {
  std::uint64_t index = 0;
  std::string kind{};  // text_of(Traits)
  std::size_t robots = 0, targets = 0;
  bool complete = false;
  double complete_s = 0.0, bound_s = 0.0, time_s = 0.0;  // as in Verdict
  std::uint64_t hash = 0;
  std::string findings{};  // "split@2.7 incomplete@60.0"
};
[[nodiscard]] SoakRow row_of(std::uint64_t index, const world::Scenario& scenario, const SoakOutcome& outcome);

// No other process writes to the file meanwhile. An incomplete last line is ignored.
class SoakJournal {
 public:
  // Throws CommandError for a file that is in use, of another version, damaged, or not to be written.
  SoakJournal(const std::string& path, std::uint64_t seed, bool force);
  SoakJournal(const SoakJournal&) = delete;
  SoakJournal& operator=(const SoakJournal&) = delete;
  ~SoakJournal() = default;

  void add(const SoakRow& row);
  [[nodiscard]] bool has(std::uint64_t index) const { return rows_.contains(index); }
  [[nodiscard]] const std::map<std::uint64_t, SoakRow>& rows() const { return rows_; }  // of this seed

 private:
  void write(const std::string& text);
  std::string path_;
  std::uint64_t seed_;
  struct Lock {
    explicit Lock(const std::string& path);
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    ~Lock();
    int descriptor;
  } lock_;
  std::map<std::uint64_t, SoakRow> rows_;
  std::ofstream out_;
};

// By kind of mission: how many, how many complete, how many with findings, and their time over its bound. A mission
// of several kinds counts in each.
[[nodiscard]] std::string table_of(const std::map<std::uint64_t, SoakRow>& rows);

}  // namespace banyan::soak
