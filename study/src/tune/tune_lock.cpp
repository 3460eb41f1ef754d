// SPDX-License-Identifier: MIT
// Whose folder it is: one tuning at a time, and never a folder with other people's files.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "banyan/record/file.hpp"
#include "banyan/study/tune.hpp"

namespace banyan::study {
namespace {

// Whether the open file is still the one that has the name: a tuning removes it when it ends.
bool has_name(int descriptor, const std::string& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

// The locked descriptor. A file of its own, because the checkpoint is replaced after every generation.
int lock(const std::string& path) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);  // NOLINT(hicpp-signed-bitwise)
    if (descriptor < 0) throw record::FileError(path, "open", errno);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {  // NOLINT(hicpp-signed-bitwise)
      const int reason = errno;
      ::close(descriptor);
      if (reason == EWOULDBLOCK) throw TuneBusy(path + ": another banyan is at work on this tuning");
      throw record::FileError(path, "lock", reason);
    }
    if (has_name(descriptor, path)) return descriptor;
    ::close(descriptor);
  }
}

}  // namespace

TuneLock::TuneLock(const std::string& directory) : path_(directory + "/tune.lock"), descriptor_(lock(path_)) {}

TuneLock::~TuneLock() {
  // Before it is unlocked, so that nobody has locked what is removed. Somebody's own file stays.
  struct stat now {};
  if (::fstat(descriptor_, &now) == 0 && now.st_size == 0) ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace banyan::study
