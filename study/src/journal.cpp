// SPDX-License-Identifier: MIT
#include "banyan/study/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "banyan/record/file.hpp"
#include "banyan/record/mcap.hpp"
#include "json_value.hpp"

namespace banyan::study {

std::string build_text(const std::string& version, const std::string& git) { return version + " (git " + git + ")"; }

namespace {

using nlohmann::json;
using record::FileError;

constexpr std::string_view journal_format = "banyan.journal";
constexpr int journal_format_version = 1;
constexpr std::int64_t sync_period_ns = 1'000'000'000;
constexpr std::size_t crc_digits = 8;

std::string framed(const std::string& text) {
  std::string crc(crc_digits, '0');
  std::array<char, crc_digits> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), record::mcap::crc32(text), 16).ptr;
  std::copy_backward(digits.data(), end, crc.data() + crc.size());
  return crc + " " + text + "\n";
}

// The JSON of a line, or nothing if it is damaged.
std::optional<json> unframed(std::string_view line) {
  if (line.size() < crc_digits + 1 || line[crc_digits] != ' ') return std::nullopt;
  std::uint32_t crc = 0;
  const auto [stop, error] = std::from_chars(line.data(), line.data() + crc_digits, crc, 16);
  if (error != std::errc{} || stop != line.data() + crc_digits) return std::nullopt;
  line.remove_prefix(crc_digits + 1);
  if (record::mcap::crc32(line) != crc) return std::nullopt;
  json value = json::parse(line, nullptr, false);
  return value.is_object() ? std::optional(std::move(value)) : std::nullopt;
}

json header(const std::string& study, const std::string& version, const std::string& git) {
  return {{"format", journal_format},
          {"format_version", journal_format_version},
          {"study", study},
          {"version", version},
          {"git", git}};
}

// Reads which program wrote the following lines; false if the line does not say so.
bool read_header(const json& line, JournalContent& content) {
  const auto study = value_in<std::string>(line, "study"), version = value_in<std::string>(line, "version"),
             git = value_in<std::string>(line, "git");
  if (!study || !version || !git) return false;
  content.study = *study;
  content.version = *version;
  content.git = *git;
  const auto build = build_text(*version, *git);
  if (std::find(content.builds.begin(), content.builds.end(), build) == content.builds.end())
    content.builds.push_back(build);
  return true;
}

// What a study writes of a run; nothing for anything else.
std::optional<JournalEntry> entry_in(const json& line) {
  const auto id = value_in<std::string>(line, "id"), row = value_in<std::string>(line, "row"),
             error = value_in<std::string>(line, "error");
  const auto wall_s = value_in<double>(line, "wall_s");
  if (!id || !row || !error || !wall_s) return std::nullopt;
  return JournalEntry{*id, {*row, *error, *wall_s}};
}

JournalContent parse(const std::string& path, std::string_view text) {
  JournalContent content;
  std::size_t number = 0;
  const auto fail = [&](const std::string& what) -> void {
    throw FileError(path, "line " + std::to_string(number) + ": " + what);
  };
  while (!text.empty()) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return content;  // torn by a kill: as if never written
    ++number;
    const auto line = unframed(text.substr(0, end));
    if (number == 1 || (line && line->contains("format"))) {
      if (!line || value_in<std::string>(*line, "format") != journal_format) fail("this is no journal of a study");
      if (value_in<double>(*line, "format_version") != journal_format_version)
        fail(
            "the journal is of another format version; go on with the version of banyan that wrote it, or in another "
            "folder");
      if (!read_header(*line, content)) fail("this is no journal of a study");
    } else if (auto entry = line ? entry_in(*line) : std::nullopt) {
      content.entries.push_back(std::move(*entry));
    } else {
      fail(
          "the line is damaged; delete it (or the file), and its run is done again. All other lines are sound or "
          "will be named one by one");
    }
    text.remove_prefix(end + 1);
    content.bytes += end + 1;
  }
  return content;
}

std::string whole_file(const std::string& path) {
  const record::InputFile file(path);
  std::string text;
  if (!file.read(0, file.size(), text)) throw FileError(path, "read", EIO);
  return text;
}

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// For a writer, or to make sure that there is none.
int open_journal(const std::string& path, int flags) {
  try {
    return record::open_locked(path, flags);
  } catch (const record::FileBusy&) {
    throw record::FileBusy(path, "another banyan is at work on this study (or this shard of it)");
  }
}

}  // namespace

JournalContent read_journal(const std::string& path) { return parse(path, whole_file(path)); }

Journal::Journal(std::string path, const std::string& study, const std::string& version, const std::string& git)
    : path_(std::move(path)) {
  descriptor_ = open_journal(path_, O_RDWR | O_CREAT);  // NOLINT(hicpp-signed-bitwise)
  try {
    content_ = parse(path_, whole_file(path_));
    if (content_.bytes > 0 && content_.study != study)
      throw FileError(path_, "belongs to the study \"" + content_.study + "\", not to \"" + study + "\"");
    end_ = content_.bytes;
    if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0) throw FileError(path_, "truncate", errno);
    if (::lseek(descriptor_, static_cast<off_t>(end_), SEEK_SET) < 0) throw FileError(path_, "seek", errno);
    if (end_ == 0 || content_.version != version || content_.git != git) write_line(header(study, version, git).dump());
    if (end_ == 0) content_.study = study;
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  (void)::fdatasync(descriptor_);
  ::close(descriptor_);
}

void Journal::append(const JournalEntry& entry) {
  const json line{
      {"id", entry.id}, {"wall_s", entry.outcome.wall_s}, {"error", entry.outcome.error}, {"row", entry.outcome.row}};
  write_line(line.dump(-1, ' ', false, json::error_handler_t::replace));
  if (now_ns() - synced_ns_ >= sync_period_ns) sync();
}

void Journal::sync() {
  if (::fdatasync(descriptor_) != 0) throw FileError(path_, "write to the disk", errno);
  if (!record::has_name(descriptor_, path_))
    throw FileError(path_, "this file was removed or replaced while runs were added to it: they are lost");
  synced_ns_ = now_ns();
}

void Journal::write_line(const std::string& text) {
  const std::string line = framed(text);
  try {
    record::write_all(descriptor_, line, path_);
  } catch (const FileError&) {
    // A file that cannot be cut back ends in a torn line, which the next reader drops as well.
    (void)::ftruncate(descriptor_, static_cast<off_t>(end_));
    (void)::lseek(descriptor_, static_cast<off_t>(end_), SEEK_SET);
    throw;
  }
  end_ += line.size();
}

JournalLock::JournalLock(std::string path) : path_(std::move(path)), descriptor_(open_journal(path_, O_RDONLY)) {}

JournalLock::JournalLock(JournalLock&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

JournalLock::~JournalLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void JournalLock::remove() {
  if (::unlink(path_.c_str()) != 0 && errno != ENOENT) throw FileError(path_, "cannot be removed", errno);
}

std::vector<std::string> journals_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/journal", error)) {
    if (entry.path().extension() == ".jsonl") found.push_back(entry.path().string());
  }
  if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
    throw FileError(folder + "/journal", "cannot read", error.value());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace banyan::study
