// SPDX-License-Identifier: MIT
// What a hub has taken from its robots and from its tracker, tick by tick, in a file. The world is a function of that,
// so a hub that was killed plays the journal and goes on where it was: with the same poses, assignment, recording and
// account.
//
//   8 bytes "banyan3\n"; 8 bytes digest of the configuration; 4 bytes number of the mission; 4 bytes length of where
//   the tracker saw robots in the beginning (lines as in pose_stream.hpp; 0: there is no tracker), and those; then of
//   each tick 4 bytes tick, 2 bytes count, and as often: 2 bytes robot, 2 bytes length, a status (messages.hpp); of
//   length 0: the robot counts as dead from then on; of robot 65535: lines of the tracker; of robot 65534: 2 bytes id,
//   whose robot joins, a new one or one that counted as dead
//
// A tick that was cut off by the end of the hub is not there.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "banyan/hosts/udp/bytes.hpp"

namespace banyan::udp {

class HubJournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct HubJournalEntry {
  static constexpr std::uint16_t tracker = 65535, joins = 65534;
  std::uint16_t robot = 0;
  Bytes status;  // empty: dead
  [[nodiscard]] static HubJournalEntry of_newcomer(std::uint16_t id);
  [[nodiscard]] std::optional<std::uint16_t> newcomer() const noexcept;  // its id
  [[nodiscard]] bool says_dead() const noexcept { return robot != tracker && robot != joins && status.empty(); }
  friend bool operator==(const HubJournalEntry&, const HubJournalEntry&) = default;
};
using HubJournalTick = std::vector<HubJournalEntry>;

class HubJournal {
 public:
  // A new one; replaces what is there. Throws HubJournalError.
  HubJournal(const std::string& path, std::uint64_t configuration, std::uint32_t mission,
             const std::string& start = "");
  // Goes on with the one that is there. Throws HubJournalError if there is none, or it is of another configuration.
  HubJournal(const std::string& path, std::uint64_t configuration);
  ~HubJournal();
  HubJournal(const HubJournal&) = delete;
  HubJournal& operator=(const HubJournal&) = delete;

  [[nodiscard]] std::uint32_t mission() const noexcept { return mission_; }
  [[nodiscard]] const std::string& start() const noexcept { return start_; }
  [[nodiscard]] const std::vector<HubJournalTick>& recorded() const noexcept {
    return recorded_;
  }                                                                // when it was opened
  void append(std::uint32_t tick, const HubJournalTick& entries);  // throws HubJournalError

 private:
  std::size_t read(const std::string& path, std::uint64_t configuration);
  void write(const Bytes& bytes);

  std::string path_;
  int file_ = -1;
  std::uint32_t mission_ = 0;
  std::string start_;
  std::vector<HubJournalTick> recorded_;
};

}  // namespace banyan::udp
