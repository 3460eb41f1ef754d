// SPDX-License-Identifier: MIT
#include "journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>

#include "banyan/record/file.hpp"
#include "mission.hpp"
#include "outputs.hpp"
#include "terminal.hpp"

namespace banyan::soak {

using namespace cli;
namespace {

constexpr const char* header = "seed,index,kind,robots,targets,complete,complete_s,bound_s,time_s,hash,findings\n";

std::string line_of(std::uint64_t seed, const SoakRow& row) {
  return format("%" PRIu64 ",%" PRIu64 ",\"%s\",%zu,%zu,%s,%.1f,%.3f,%.1f,%016" PRIx64 ",%s\n", seed, row.index,
                row.kind.c_str(), row.robots, row.targets, row.complete ? "true" : "false", row.complete_s, row.bound_s,
                row.time_s, row.hash, row.findings.c_str());
}

// The fields of a line: the kind alone is quoted, and it has commas.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    else if (c == ',' && !quoted) fields.emplace_back();
    else fields.back() += c;
  }
  return fields;
}

// Nothing unless writing it again makes the same line.
std::optional<std::pair<std::uint64_t, SoakRow>> row_from(const std::string& line) {
  const std::vector<std::string> f = fields_of(line);
  if (f.size() != 11) return std::nullopt;
  const auto whole = [&](std::size_t k, int base = 10) { return std::strtoull(f[k].c_str(), nullptr, base); };
  const auto number = [&](std::size_t k) { return std::strtod(f[k].c_str(), nullptr); };
  const SoakRow row{whole(1),  f[2],      whole(3),  whole(4),     f[5] == "true",
                    number(6), number(7), number(8), whole(9, 16), f[10]};
  if (line_of(whole(0), row) != line + '\n') return std::nullopt;
  return std::pair{whole(0), row};
}

int lock_of(const std::string& path) {
  try {
    return record::open_locked(path, O_RDWR | O_CREAT | O_CLOEXEC);
  } catch (const record::FileBusy&) {
    throw CommandError(exit_lost, "another soak is writing to " + path);
  } catch (const record::FileError& e) {
    throw CommandError(exit_lost, std::string("cannot write ") + path + ": " + e.what());
  }
}

// The smallest that at least this share of them do not exceed.
double quantile(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

std::string line_of_kind(const std::string& kind, const std::vector<const SoakRow*>& rows) {
  std::vector<double> ratios;
  std::size_t complete = 0, findings = 0;
  for (const SoakRow* row : rows) {
    complete += row->complete ? 1 : 0;
    findings += row->findings.empty() ? 0 : 1;
    if (row->complete && row->bound_s > 0.0) ratios.push_back(row->complete_s / row->bound_s);
  }
  std::sort(ratios.begin(), ratios.end());
  std::string text = format("  %-18s %8zu %9zu %9zu", kind.c_str(), rows.size(), complete, findings);
  if (!ratios.empty())
    text += format(" %10.2f %7.2f %7.2f", quantile(ratios, 0.5), quantile(ratios, 0.95), ratios.back());
  return text + "\n";
}

}  // namespace

SoakRow row_of(std::uint64_t index, const world::Scenario& scenario, const SoakOutcome& outcome) {
  std::string findings;
  for (const Finding& f : outcome.findings)
    findings += (findings.empty() ? "" : " ") + format("%s@%.1f", f.kind.c_str(), f.time_s);
  return {index,
          text_of(traits_of(scenario)),
          world::robot_count(scenario),
          world::target_positions(scenario).size(),
          outcome.complete,
          outcome.complete_s,
          outcome.bound_s,
          outcome.time_s,
          outcome.hash,
          findings};
}

SoakJournal::SoakJournal(const std::string& path, std::uint64_t seed, bool force)
    : path_(path), seed_{seed}, lock_(path) {
  std::error_code error;
  if (force) std::filesystem::resize_file(path, 0, error);
  std::ifstream in(path);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  if (error || !in) throw CommandError(exit_lost, "cannot read " + path);
  text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  if (!text.empty() && !text.starts_with(header))
    throw CommandError(exit_usage, path + " is no journal of this version's soak; --force replaces it");
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    const auto row = row_from(line);
    if (!row)
      throw CommandError(exit_usage, format("%s:%zu: this is no mission of a soak; --force begins the journal anew",
                                            path.c_str(), number));
    if (row->first == seed) rows_[row->second.index] = row->second;
  }
  std::filesystem::resize_file(path, text.size(), error);
  out_.open(path, std::ios::app);
  if (text.empty()) write(header);
}

SoakJournal::Lock::Lock(const std::string& path) : descriptor{lock_of(path)} {}
SoakJournal::Lock::~Lock() { static_cast<void>(::close(descriptor)); }

void SoakJournal::add(const SoakRow& row) {
  write(line_of(seed_, row));
  rows_[row.index] = row;
}

void SoakJournal::write(const std::string& text) {
  out_ << text << std::flush;
  if (!out_) throw CommandError(exit_lost, "cannot write " + path_ + ": " + std::strerror(errno));
}

std::string table_of(const std::map<std::uint64_t, SoakRow>& rows) {
  std::map<std::string, std::vector<const SoakRow*>> by_kind;
  std::vector<const SoakRow*> all;
  for (const auto& [index, row] : rows) {
    all.push_back(&row);
    std::istringstream kinds(row.kind);
    for (std::string kind; std::getline(kinds >> std::ws, kind, ',');) by_kind[kind].push_back(&row);
  }
  std::string text = format("  %-18s %8s %9s %9s %10s %7s %7s\n", "kind", "missions", "complete", "findings",
                            "time/bound", "95 %", "worst");
  for (const auto& [kind, of_kind] : by_kind) text += line_of_kind(kind, of_kind);
  return text + line_of_kind("all", all);
}

}  // namespace banyan::soak
