// SPDX-License-Identifier: MIT
// The diary of a study: one line per finished run, written as it finishes, never rewritten. What is
// in it survives a kill at any moment.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/study/simulate.hpp"

namespace banyan::study {

struct JournalEntry {
  std::string id;
  Outcome outcome;
};

// A file of lines "<crc32> <json>", each of which stands alone. The first names the study and the
// program that wrote it.
struct JournalContent {
  std::string study, version, git;    // the last two of the program that wrote to it last
  std::vector<std::string> builds;    // "0.2.0 (git 123abc)" of all that have, each once
  std::vector<JournalEntry> entries;  // in the order of the file
  std::uint64_t bytes = 0;            // of whole lines; what follows is the torn end of a last line
};
// "0.2.0 (git 123abc)"
[[nodiscard]] std::string build_text(const std::string& version, const std::string& git);
// Throws record::FileError if it cannot be read, is no journal, or a line in its middle is damaged:
// the message names the line and says that it may be deleted. A torn last line is what a kill
// leaves behind, and no fault.
[[nodiscard]] JournalContent read_journal(const std::string& path);

class Journal {
 public:
  // Creates the file, or opens it behind its last whole line. Throws record::FileBusy if another process
  // has it open, record::FileError if it is damaged or belongs to another study.
  Journal(std::string path, const std::string& study, const std::string& version, const std::string& git);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  [[nodiscard]] const JournalContent& content() const noexcept { return content_; }  // when it was opened
  // Appends a line and hands it to the operating system; to the disk at least once a second. If
  // that fails (disk full) the file ends with its last whole line and FileError is thrown. So it is
  // when somebody has removed or replaced the file, which is looked at as often. Not thread-safe.
  void append(const JournalEntry& entry);
  void sync();

 private:
  void write_line(const std::string& text);

  std::string path_;
  JournalContent content_;
  int descriptor_ = -1;
  std::uint64_t end_ = 0;
  std::int64_t synced_ns_ = 0;
};

// Keeps writers off a journal, to throw it away.
class JournalLock {
 public:
  // Throws record::FileBusy if a process is writing to it, record::FileError if it cannot be opened.
  explicit JournalLock(std::string path);
  JournalLock(JournalLock&& other) noexcept;
  JournalLock& operator=(JournalLock&&) = delete;
  ~JournalLock();
  void remove();  // the file; throws record::FileError

 private:
  std::string path_;
  int descriptor_;
};

// The journals of a study's folder, "journal/*.jsonl" by name. Throws record::FileError if there is such a folder
// but it cannot be read.
[[nodiscard]] std::vector<std::string> journals_in(const std::string& folder);

}  // namespace banyan::study
