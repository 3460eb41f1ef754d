// SPDX-License-Identifier: MIT
// This process as one of several that a launcher started together: what Processes needs of MPI, so
// that a build without it has the same code.
#pragma once

#include <cstddef>
#include <memory>

#include "task_queue.hpp"

namespace banyan::study {

class Team {
 public:
  Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  // The first process releases the others; each of the others waits for that.
  virtual ~Team() = default;

  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;

  // For the first process. Waits until every other process has said how many threads it has.
  [[nodiscard]] virtual std::size_t threads_elsewhere() = 0;
  // From now on the others get tasks from this queue; from none if it is null. `threads` is the
  // number of threads of all processes together.
  virtual void draw_from(std::shared_ptr<TaskQueue> queue, std::size_t threads) = 0;

  // For the other processes: tasks come into this queue, from which `threads` threads draw, until
  // the first process lets go.
  virtual void serve(TaskQueue& queue, std::size_t threads) = 0;
};

#ifdef BANYAN_HAVE_MPI
// Waits for all processes of the launcher. std::runtime_error if this MPI does not support threads.
[[nodiscard]] std::unique_ptr<Team> join_team();
#endif

}  // namespace banyan::study
