// SPDX-License-Identifier: MIT
// Byte strings of any length between processes. One thread of a process does all of this: the one
// that called MPI_Init_thread. An error in MPI ends all processes, as MPI does unless told otherwise.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

namespace banyan::study {

// A message on its way; lives until sent() or after finish().
class Sending {
 public:
  Sending(std::string bytes, int to, int tag);
  Sending(const Sending&) = delete;  // MPI reads from bytes_ where they are
  Sending& operator=(const Sending&) = delete;
  ~Sending() = default;

  [[nodiscard]] bool sent();
  void finish();  // waits until sent

 private:
  std::string bytes_;
  std::vector<MPI_Request> pieces_;
};

struct MpiMessage {
  int from = 0, tag = 0;
  std::string bytes;
};

// The next message if one has come.
[[nodiscard]] std::optional<MpiMessage> receive();

}  // namespace banyan::study
