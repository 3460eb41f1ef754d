// SPDX-License-Identifier: MIT
// Ownership of a folder: one tuning at a time, and never a folder with files of other origin.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "banyan/record/file.hpp"
#include "banyan/study/tune.hpp"

namespace banyan::study {
namespace {

// The locked descriptor. A file of its own, because the checkpoint is replaced after every generation.
int lock(const std::string& path) {
  try {
    return record::open_locked(path, O_RDWR | O_CREAT);  // NOLINT(hicpp-signed-bitwise)
  } catch (const record::FileBusy&) { throw TuneBusy(path + ": another banyan is at work on this tuning"); }
}

}  // namespace

TuneLock::TuneLock(const std::string& directory) : path_(directory + "/tune.lock"), descriptor_(lock(path_)) {}

TuneLock::~TuneLock() {
  // Before it is unlocked, so that no other process has locked the removed file. A file of the user's stays.
  struct stat now {};
  if (::fstat(descriptor_, &now) == 0 && now.st_size == 0) ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace banyan::study
