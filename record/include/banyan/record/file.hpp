// SPDX-License-Identifier: MIT
// Files that are either whole or not there: written under a temporary name in the same directory,
// forced to the disk and renamed. Every write and close is checked, so a full disk is an error.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace banyan::record {

// A file could not be opened, read, written or renamed. what() is "path: action: reason".
class FileError : public std::runtime_error {
 public:
  FileError(std::string path, std::string_view action, int error_number);
  FileError(std::string path, std::string_view text);  // no errno: the content is at fault
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] int error_number() const noexcept { return error_number_; }  // errno, or 0

 private:
  std::string path_;
  int error_number_ = 0;
};

// Another process has the file locked.
class FileBusy : public FileError {
 public:
  using FileError::FileError;
};

// A descriptor of the file `path`, opened with `flags` (and mode 0666) and locked against everybody else who opens
// it so; FileBusy if somebody has. What is locked is the file that has the name then: one that was removed or renamed
// between opening and locking is let go of and the name opened anew. A file system without locks gives none.
[[nodiscard]] int open_locked(const std::string& path, int flags);
// Whether the open file still is the one of that name.
[[nodiscard]] bool has_name(int descriptor, const std::string& path);

// What happens to a file that is already there when the new one is finished.
enum class Existing : std::uint8_t { keep, replace };  // keep: FileError with EEXIST, the old file stays

// Buffered. Until commit() the file is `path` + ".part"; only one process can have it open.
class OutputFile {
 public:
  explicit OutputFile(std::string path, Existing existing = Existing::keep);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();  // without commit(): closes, and removes the part unless keep_part()

  void write(std::string_view bytes);
  void flush();   // to the operating system
  void commit();  // flush, fsync, close, rename, fsync of the directory
  void keep_part() noexcept { keep_part_ = true; }
  [[nodiscard]] std::uint64_t position() const noexcept { return position_; }  // bytes written so far
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] const std::string& part_path() const noexcept { return part_path_; }

 private:
  void close_part();
  void rename_part();

  std::string path_;
  std::string part_path_;
  std::string buffer_;
  std::uint64_t position_ = 0;
  int descriptor_ = -1;
  Existing existing_;
  bool keep_part_ = false;
  bool replaceable_ = true;  // false for devices and pipes: written in place, never renamed
};

// The whole of `text` as the file `path`, atomically.
void write_file(const std::string& path, std::string_view text, Existing existing = Existing::keep);

// All of `bytes` to an open descriptor (such as standard output); `name` is for the error.
void write_all(int descriptor, std::string_view bytes, const std::string& name);

// Random access for readers; never past the end.
class InputFile {
 public:
  explicit InputFile(std::string path);  // FileError: missing, no permission, a directory
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  // Replaces `into` by `size` bytes at `offset`; false if the file is shorter.
  [[nodiscard]] bool read(std::uint64_t offset, std::uint64_t size, std::string& into) const;
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  // Whether an OutputFile has it; and for how long nobody has changed it.
  [[nodiscard]] bool is_being_written() const noexcept;
  [[nodiscard]] double unchanged_s() const noexcept { return unchanged_s_; }

 private:
  std::string path_;
  std::uint64_t size_ = 0;
  double unchanged_s_ = 0.0;
  int descriptor_ = -1;
};

}  // namespace banyan::record
