// SPDX-License-Identifier: MIT
// Who is who in a fleet: in the order in which a world numbers its robots, each one's id on the wire and its name.
//
// A robot's name is what people and trackers call it; the number at its end is its id. So of `--names lead_9,cf{01-12}`
// the first robot is lead_9 with id 9, the second cf01 with id 1. Where no name ends in a number, ids are 0, 1, 2, ...
// in their order; without names, each robot's id is its name. Robots that join later are named as the others are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/hosts/udp/envelope.hpp"

namespace banyan::udp {

class Roster {
 public:
  // Ids from 0. `room`: so many may join.
  explicit Roster(std::size_t robots, std::size_t room = 0);
  // Of names, separated by commas; {01-12} in a name stands for each of these numbers, with as many digits as the
  // first. Throws OptionError for what is no such list, and for names or ids that occur twice.
  explicit Roster(const std::string& names, std::size_t room = 0);

  [[nodiscard]] std::size_t size() const noexcept { return robots_.size(); }
  [[nodiscard]] std::size_t most() const noexcept { return most_; }  // with those that may join
  [[nodiscard]] NodeId id(std::size_t robot) const noexcept { return robots_[robot].id; }
  [[nodiscard]] const std::string& name(std::size_t robot) const noexcept { return robots_[robot].name; }
  [[nodiscard]] std::optional<std::size_t> with_id(NodeId id) const;
  // By its name, or else its id in decimals.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
  // Likewise; the id that somebody would have who is not there yet, nothing if there is none.
  [[nodiscard]] std::optional<NodeId> id_of(std::string_view name) const;
  // Whoever it is, also one that is not there.
  [[nodiscard]] std::string name_of(NodeId id) const;
  // "cf_1, cf_2"
  [[nodiscard]] std::string list_of(const std::vector<std::size_t>& robots) const;
  // One more, as the last; its index. There must be room, and the id must be new.
  std::size_t add(NodeId id);

 private:
  struct Entry {
    NodeId id = 0;
    std::string name;
  };
  void keep(Entry entry);
  std::vector<Entry> robots_;
  std::map<NodeId, std::size_t> by_id_;
  std::map<std::string, std::size_t, std::less<>> by_name_;
  std::size_t most_ = 0;
  std::string prefix_;      // of all names; "" also if they differ
  std::size_t digits_ = 1;  // at least, in the names of those that join
};

}  // namespace banyan::udp
