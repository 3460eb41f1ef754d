// SPDX-License-Identifier: MIT
#include "mpi_message.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace banyan::study {
namespace {

// MPI counts in int, so a long message goes in pieces; one shorter than this, perhaps empty, ends
// it. Messages of one sender and tag cannot overtake each other.
constexpr std::size_t piece_size = std::size_t{1} << 20;

}  // namespace

Sending::Sending(std::string bytes, int to, int tag)
    : bytes_(std::move(bytes)), pieces_(bytes_.size() / piece_size + 1) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const std::size_t at = i * piece_size;
    const auto count = static_cast<int>(std::min(piece_size, bytes_.size() - at));
    MPI_Isend(bytes_.data() + at, count, MPI_BYTE, to, tag, MPI_COMM_WORLD, &pieces_[i]);
  }
}

bool Sending::sent() {
  int all = 0;
  MPI_Testall(static_cast<int>(pieces_.size()), pieces_.data(), &all, MPI_STATUSES_IGNORE);
  return all != 0;
}

void Sending::finish() { MPI_Waitall(static_cast<int>(pieces_.size()), pieces_.data(), MPI_STATUSES_IGNORE); }

std::optional<MpiMessage> receive() {
  int come = 0;
  MPI_Status status;
  // Open MPI looks first and then fetches what has come: the second look sees it.
  for (int look = 0; look < 2 && come == 0; ++look) {
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &come, &status);
  }
  if (come == 0) return std::nullopt;
  MpiMessage message{status.MPI_SOURCE, status.MPI_TAG, {}};
  for (;;) {
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    const std::size_t at = message.bytes.size();
    const auto length = static_cast<std::size_t>(count);
    message.bytes.resize(at + length);
    MPI_Recv(message.bytes.data() + at, count, MPI_BYTE, message.from, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (length < piece_size) return message;
    MPI_Probe(message.from, message.tag, MPI_COMM_WORLD, &status);
  }
}

}  // namespace banyan::study
