// SPDX-License-Identifier: MIT
// Another program, run to its end.
#pragma once

#include <string>
#include <vector>

namespace banyan::study {

struct ChildEnd {
  int start_error = 0;  // errno, if it could not be started
  int status = 0;       // how it exited; -1 by a signal
  std::string ended;    // "with status 1", "by signal 9"; "" for success
  std::string said;     // the end of what it wrote, without the last line break
};

// Runs a program, looked up in PATH and started without a shell, and waits for it. It has nothing on standard input,
// and the signals that end it are as they are by default.
[[nodiscard]] ChildEnd run_program(std::vector<std::string> words);

}  // namespace banyan::study
