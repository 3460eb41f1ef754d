// SPDX-License-Identifier: MIT
// Whom a hub, a robot or a listener refuses, in words, at once. Each is told once, and not more than 32 with a key and
// 32 without: whoever has none must not fill a log.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "banyan/hosts/udp/envelope.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {

class Refusals {
 public:
  using Tell = std::function<void(const std::string& text)>;
  using NameOf = std::function<std::string(NodeId id)>;
  // Nobody is told, by default. Robots are called by their ids, or else by `name_of` them.
  void tell(Tell tell, NameOf name_of = {}) {
    tell_ = std::move(tell);
    name_of_ = std::move(name_of);
  }

  // Datagrams from there are dropped; `sender` where it is authentic. What happens to everybody now and then (stale,
  // replayed) is not told.
  void refuse(Drop reason, const Address& from, std::optional<NodeId> sender);
  // Two programs say that they are the same robot: the one here is believed, another one is not.
  void rival(NodeId id, const Address& believed);
  // Anything else that is told once.
  void once(const std::string& text);

 private:
  [[nodiscard]] std::string robot(NodeId id) const;
  Tell tell_;
  NameOf name_of_;
  void tell_once(std::set<std::string>& told, const std::string& text) const;
  std::set<std::string> told_, told_of_strangers_;  // whoever has no key must not use up the lines of those who have
  std::map<NodeId, Address> rivals_;                // where somebody was heard last whose id was in use
};

}  // namespace banyan::udp
