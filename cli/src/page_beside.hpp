// SPDX-License-Identifier: MIT
// The page beside a mission: `banyan view` as a process of its own, which shows the recording while it is written.
// A process, since it must have the network that a fleet leaves, and go on when the mission is over.
#pragma once

#include <sys/types.h>

#include "outputs.hpp"

namespace banyan::cli {

class PageBeside {
 public:
  PageBeside() = default;  // none
  // Throws CommandError, also where nothing will be recorded.
  PageBeside(const RunOutputs& outputs, const record::OutputSettings& output);
  PageBeside(const PageBeside&) = delete;
  PageBeside& operator=(const PageBeside&) = delete;
  PageBeside(PageBeside&& other) noexcept;
  PageBeside& operator=(PageBeside&&) = delete;
  ~PageBeside();  // ends it

  // The mission is over: waits until the page is ended, by Ctrl-C. Nothing if the recording has never begun.
  void stay();

 private:
  pid_t process_ = 0;  // 0: none
  std::string recording_;
};

}  // namespace banyan::cli
