// SPDX-License-Identifier: MIT
// Missions in processes of their own: however one ends, the soak continues and reports it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "watch.hpp"

namespace banyan::soak {

class Isolated {
 public:
  // Starts watching. Throws CommandError if the system has no process or pipe left.
  Isolated(const world::Scenario& scenario, bool twice);
  Isolated(Isolated&& other) noexcept;
  Isolated& operator=(Isolated&& other) noexcept;
  ~Isolated();  // ends it

  // Becomes readable when there is something to take.
  [[nodiscard]] int descriptor() const noexcept { return pipe_; }
  // Reads its output; returns the outcome once it has ended. A process that dies has found a "crash", and so
  // has one that takes longer than `most_s`.
  [[nodiscard]] std::optional<SoakOutcome> take();
  // Nothing if this program is told to stop meanwhile.
  [[nodiscard]] SoakOutcome wait();

  // Whether it is a mission that took longer than `most_s`.
  [[nodiscard]] static bool has_no_end(const Finding& finding) {
    return finding.kind == "crash" && finding.text.starts_with("no end");
  }

  static constexpr double most_s = 1800.0;

 private:
  [[nodiscard]] SoakOutcome read_outcome(int status) const;
  void end() noexcept;

  pid_t process_ = -1;
  int pipe_ = -1;
  std::string said_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace banyan::soak
