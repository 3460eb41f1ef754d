// SPDX-License-Identifier: MIT
// A web server for one visitor: the page that shows recordings, and the file it is to show. It listens on
// this machine's loopback interface only.
#pragma once

#include <chrono>
#include <memory>
#include <string>

namespace banyan::cli {

// What a recording is called as well: "run.mcap.part" while it is written, "run.mcap" from then on.
[[nodiscard]] std::string other_name(const std::string& recording);

struct PageContent {
  std::string page;       // folder with index.html: /
  std::string recording;  // file: /file, by ranges, under either of its names; "": none
  std::string scenario;   // JSON object for /start.json if there is no recording; "": nothing to start with
  std::string scenarios;  // folder with *.toml: /scenarios.json
};

class PageServer {
 public:
  // Answers from now on. `port` 0: any that is free. Throws CommandError (exit_lost) if the port is taken
  // or cannot be used. A request must have come within `patience` of its connection.
  PageServer(PageContent content, int port, std::chrono::milliseconds patience = std::chrono::seconds(5));
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;
  ~PageServer();  // ends all answers that are being given

  [[nodiscard]] int port() const noexcept;
  [[nodiscard]] std::string address() const;  // "http://127.0.0.1:8000/"

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::cli
