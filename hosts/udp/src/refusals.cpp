// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/refusals.hpp"

namespace banyan::udp {

std::string Refusals::robot(NodeId id) const { return "robot " + (name_of_ ? name_of_(id) : std::to_string(id)); }

void Refusals::tell_once(std::set<std::string>& told, const std::string& text) const {
  constexpr std::size_t most = 32;
  if (!tell_ || told.size() > most || !told.insert(text).second) return;
  tell_(told.size() <= most ? text : "more are refused than can be told; they are counted");
}

void Refusals::once(const std::string& text) { tell_once(told_, text); }

void Refusals::refuse(Drop reason, const Address& from, std::optional<NodeId> sender) {
  const std::string where = to_string(from);
  const std::string who =
      "refused " + (sender ? (*sender == hub_node ? "the hub" : robot(*sender)) + " at " + where : where) + ": ";
  switch (reason) {
    case Drop::foreign:
      return tell_once(told_of_strangers_,
                       who +
                           "its datagrams are another program's, or of another version of Banyan, or of a key whose "
                           "number is not in the key file");
    case Drop::forged: return tell_once(told_of_strangers_, who + "its key file has another key of the same number");
    case Drop::misaddressed:
      if (sender) once(who + "nobody of this id is expected here");
      return;
    case Drop::malformed: return once(who + "its datagrams cannot be read; is it of another version of Banyan?");
    case Drop::in_use:
      if (sender) rivals_[*sender] = from;
      return;
    case Drop::stale:
    case Drop::replayed: return;
  }
}

void Refusals::rival(NodeId id, const Address& believed) {
  const auto other = rivals_.find(id);
  once("refused a second " + (id == hub_node ? "hub" : robot(id)) +
       (other == rivals_.end() ? "" : " at " + to_string(other->second)) + ": the one at " + to_string(believed) +
       " is running; one of them needs another --id, or somebody repeats what was said earlier");
}

}  // namespace banyan::udp
