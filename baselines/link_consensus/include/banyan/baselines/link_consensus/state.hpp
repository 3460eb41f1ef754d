// SPDX-License-Identifier: MIT
// All that a robot of link consensus remembers between two steps.
#pragma once

#include <array>
#include <cstdint>

#include "banyan/baselines/common/motion.hpp"
#include "banyan/baselines/common/table.hpp"
#include "banyan/baselines/common/ticks.hpp"
#include "banyan/baselines/link_consensus/message.hpp"

namespace banyan::baselines::link_consensus {

// One end of a link. It is kept once both ends list it; until then it is an offer.
struct Link {
  RobotId to = nobody;
  bool kept = false;
  bool repairs = false;  // it is the way back of a robot that was cut off
  std::uint8_t offered_steps = 0;
};

// The links of a robot, in the order in which they were made.
class Links {
 public:
  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] bool full() const noexcept { return size_ == static_cast<int>(most_kept_links); }
  [[nodiscard]] Link& operator[](int k) noexcept { return links_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] const Link& operator[](int k) const noexcept { return links_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] int find(RobotId to) const noexcept {
    for (int k = 0; k < size_; ++k)
      if ((*this)[k].to == to) return k;
    return -1;
  }
  [[nodiscard]] bool keeps(RobotId to) const noexcept {
    const int k = find(to);
    return k >= 0 && (*this)[k].kept;
  }
  void offer(RobotId to, bool repairs) noexcept {
    if (!full()) links_[static_cast<std::size_t>(size_++)] = {to, false, repairs, 0};
  }
  void remove(int k) noexcept {
    for (int j = k; j + 1 < size_; ++j) (*this)[j] = (*this)[j + 1];
    (*this)[--size_] = {};
  }

 private:
  std::array<Link, most_kept_links> links_{};
  int size_ = 0;
};

struct State {
  RobotId id = nobody;
  OwnTarget assignment;
  Ticks ticks;

  // The root and the way to it (root.cpp)
  RobotId root = nobody;
  Serial beat = 0;
  std::uint16_t way = not_rooted;
  RobotId parent = nobody;
  std::uint16_t silent_ticks = 0;  // since the root's count last grew
  RobotId lost_root = nobody;      // the last root that fell silent,
  Serial lost_beat = 0;            // its last count,
  std::uint16_t lost_ticks = 0;    // and how long that is ago

  // Links (links.cpp)
  Links links;
  RobotId given_up = nobody;  // the link given up last, until its other end no longer lists it

  // The agreement (agreement.cpp)
  Bid bid;  // vouched for
  bool agrees = false;
  Bid last_bid;                       // vouched for before that: not again
  std::uint8_t serial = 0;            // of my last own bid
  std::uint16_t own_lease_ticks = 1;  // its full length
  bool insists = false;               // my next bid has the largest reach
  std::uint16_t tried = 0xFFFF;       // my next bid is about a link shorter than this
  std::uint16_t rest_ticks = 0;       // time until my next bid

  Tally tally;  // never read
  Table<Message> neighbors;

  // About `entries` entries of the table are needed soon, and all the rest.
  void prefetch(std::size_t entries) const noexcept { neighbors.prefetch(entries); }
};

}  // namespace banyan::baselines::link_consensus
