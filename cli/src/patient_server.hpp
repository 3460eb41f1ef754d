// SPDX-License-Identifier: MIT
// An HTTP server that slow or many visitors cannot keep from answering the next one. httplib's own has eight threads,
// and a client that sends a byte every few seconds occupies one of them for minutes.
#pragma once

#include <httplib.h>

#include <chrono>

namespace banyan::cli {

class Crowd;

// One request a connection. Every visitor has a thread of its own, up to `most_visitors`; then the one that has been
// there longest gives way to the next. All of a request's head must have come within `patience`.
class PatientServer : public httplib::Server {
 public:
  static constexpr std::size_t most_visitors = 128;

  explicit PatientServer(std::chrono::milliseconds patience);
  // Called once it is bound: httplib lets five connections wait to be accepted, and makes further ones try again
  // after a second.
  void lengthen_queue() const;

 private:
  bool process_and_close_socket(socket_t socket) override;

  std::chrono::milliseconds patience_;
  Crowd* crowd_ = nullptr;  // httplib's, while it listens
};

}  // namespace banyan::cli
