// SPDX-License-Identifier: MIT
// Whole files or none (file.hpp).
#include "banyan/record/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "banyan/controller/core/printable.hpp"

namespace banyan::record {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16;

// Somebody who only looks whether a file is locked (InputFile) has it for less than that.
constexpr int lock_attempts = 25;
constexpr useconds_t between_attempts_us = 2000;

bool lock(int descriptor) {
  for (int attempt = 1; ::flock(descriptor, LOCK_EX | LOCK_NB) != 0; ++attempt) {
    if (errno != EWOULDBLOCK) return true;  // a file system without locks
    if (attempt == lock_attempts) return false;
    ::usleep(between_attempts_us);
  }
  return true;
}

std::string reason(int error_number) { return std::generic_category().message(error_number); }

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

// A rename would replace a symbolic link itself; the user wants its target written.
std::string resolved(const std::string& path) {
  char* real = ::realpath(path.c_str(), nullptr);
  if (real == nullptr) return path;
  std::string result(real);
  std::free(real);
  return result;
}

// A locked part, which no other process writes. One that its writer renamed while we opened it is a finished file and
// stays as it is.
int open_part(const std::string& part, const std::string& path) {
  int descriptor = -1;
  try {
    descriptor = open_locked(part, O_WRONLY | O_CREAT);
  } catch (const FileBusy&) {
    throw FileBusy(path, "is being written by another process (" + part + ")");
  } catch (const FileError& error) { throw FileError(path, "cannot create", error.error_number()); }
  if (::ftruncate(descriptor, 0) == 0) return descriptor;
  const int error = errno;
  ::close(descriptor);
  throw FileError(path, "cannot create", error);
}

void sync_directory(const std::string& path) {
  // Best effort: some file systems cannot sync a directory, and the file itself is safe already.
  const int descriptor = ::open(directory_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  (void)::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

FileError::FileError(std::string path, std::string_view action, int error_number)
    : std::runtime_error(printable(path + ": " + std::string(action) + ": " + reason(error_number))),
      path_(std::move(path)),
      error_number_(error_number) {}

FileError::FileError(std::string path, std::string_view text)
    : std::runtime_error(printable(path + ": " + std::string(text))), path_(std::move(path)) {}

int open_locked(const std::string& path, int flags) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0) throw FileError(path, "cannot open", errno);
    if (!lock(descriptor)) {
      ::close(descriptor);
      throw FileBusy(path, "is in use by another process");
    }
    if (has_name(descriptor, path)) return descriptor;
    ::close(descriptor);
  }
}

bool has_name(int descriptor, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

void write_all(int descriptor, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw FileError(name, "cannot write", errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

OutputFile::OutputFile(std::string path, Existing existing) : path_(std::move(path)), existing_(existing) {
  if (path_.empty()) throw FileError("(no name)", "cannot create", ENOENT);
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) throw FileError(path_, "cannot create", EISDIR);
  replaceable_ = !exists || S_ISREG(status.st_mode);
  if (!replaceable_) {
    part_path_ = path_;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw FileError(path_, "cannot open", errno);
    return;
  }
  if (exists && existing_ == Existing::keep) throw FileError(path_, "will not be replaced", EEXIST);
  part_path_ = (exists ? resolved(path_) : path_) + ".part";
  descriptor_ = open_part(part_path_, path_);
  buffer_.reserve(buffer_bytes);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  if (replaceable_ && !keep_part_) ::unlink(part_path_.c_str());
  ::close(descriptor_);
}

void OutputFile::write(std::string_view bytes) {
  position_ += bytes.size();
  if (buffer_.size() + bytes.size() <= buffer_bytes) {
    buffer_.append(bytes);
    return;
  }
  flush();
  if (bytes.size() >= buffer_bytes) {
    write_all(descriptor_, bytes, path_);
  } else {
    buffer_.append(bytes);
  }
}

void OutputFile::flush() {
  // Emptied first: after a failure a destructor must not write the same bytes again.
  std::string pending;
  pending.swap(buffer_);
  write_all(descriptor_, pending, path_);
  pending.clear();
  buffer_.swap(pending);
}

void OutputFile::commit() {
  flush();
  if (replaceable_) {
    if (::fsync(descriptor_) != 0) throw FileError(path_, "cannot write", errno);
    rename_part();
    sync_directory(part_path_);
  }
  close_part();
}

void OutputFile::rename_part() {
  const std::string target = part_path_.substr(0, part_path_.size() - std::string_view(".part").size());
  if (existing_ == Existing::keep) {
    // link(), unlike rename(), atomically refuses to replace a file that has appeared meanwhile.
    if (::link(part_path_.c_str(), target.c_str()) == 0) {
      ::unlink(part_path_.c_str());
      return;
    }
    if (errno == EEXIST || ::access(target.c_str(), F_OK) == 0) {
      keep_part_ = true;  // neither result is thrown away
      throw FileError(path_, "will not be replaced (the new one is " + part_path_ + ")", EEXIST);
    }
  }
  if (::rename(part_path_.c_str(), target.c_str()) != 0) {
    const int error = errno;
    keep_part_ = true;
    throw FileError(path_, "cannot rename from " + part_path_, error);
  }
}

void OutputFile::close_part() {
  const int descriptor = std::exchange(descriptor_, -1);
  // After EINTR the descriptor is closed all the same on Linux.
  if (::close(descriptor) != 0 && errno != EINTR) throw FileError(path_, "cannot close", errno);
}

void write_file(const std::string& path, std::string_view text, Existing existing) {
  OutputFile file(path, existing);
  file.write(text);
  file.commit();
}

InputFile::InputFile(std::string path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a FIFO must not block us
  if (descriptor_ < 0) throw FileError(path_, "cannot open", errno);
  struct stat status {};
  int error = ::fstat(descriptor_, &status) != 0 ? errno : 0;
  if (error == 0 && S_ISDIR(status.st_mode)) error = EISDIR;
  if (error == 0 && !S_ISREG(status.st_mode)) error = ESPIPE;
  if (error != 0) {
    ::close(descriptor_);
    throw FileError(path_, "cannot open", error);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  struct timespec now {};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const struct timespec& changed = status.st_mtim;
  unchanged_s_ =
      static_cast<double>(now.tv_sec - changed.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - changed.tv_nsec);
}

bool InputFile::is_being_written() const noexcept {
  if (::flock(descriptor_, LOCK_SH | LOCK_NB) != 0) return errno == EWOULDBLOCK;
  ::flock(descriptor_, LOCK_UN);
  return false;
}

InputFile::~InputFile() { ::close(descriptor_); }

bool InputFile::read(std::uint64_t offset, std::uint64_t size, std::string& into) const {
  if (offset > size_ || size > size_ - offset) return false;
  into.resize(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::pread(descriptor_, into.data() + done, size - done, static_cast<off_t>(offset + done));
    if (got < 0) {
      if (errno == EINTR) continue;
      throw FileError(path_, "cannot read", errno);
    }
    if (got == 0) return false;  // has become shorter since it was opened
    done += static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace banyan::record
