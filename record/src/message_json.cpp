// SPDX-License-Identifier: MIT
// What a robot broadcast, as numbers (message_json.hpp).
#include "message_json.hpp"

#include <array>
#include <concepts>
#include <limits>
#include <type_traits>

#include "banyan/record/frame.hpp"

namespace banyan::record {

namespace {

using M = Message;
using Kept = MessageField::Kept;

// Enumerators, flags and plain numbers.
template <auto member> double number(const M& m) { return static_cast<double>(m.*member); }
// A robot: ids are indices.
template <auto member> double robot(const M& m) { return m.*member == nobody ? -1.0 : static_cast<double>(m.*member); }
// A number whose largest value says that there is none.
template <auto member> double known(const M& m) {
  using Number = std::remove_cvref_t<decltype(m.*member)>;
  static_assert(std::unsigned_integral<Number>);
  return m.*member == std::numeric_limits<Number>::max() ? -1.0 : static_cast<double>(m.*member);
}
static_assert(unknown_label == std::numeric_limits<decltype(Message::label_cm)>::max());
static_assert(unreachable == std::numeric_limits<decltype(Message::tree_hops)>::max());
static_assert(nobody_calls == std::numeric_limits<decltype(Message::call_hops)>::max());

constexpr int of_q = 3, of_pull = 3;

constexpr auto of_message = std::to_array<MessageField>({
    {"role", "0 spare, 1 connector, 2 worker, 3 root", number<&M::role>, 0, Kept::in_frame},
    {"phase", "0 init, 1 start_tree, 2 select_parent, 3 grow_tree, 4 select_root", number<&M::phase>, 0,
     Kept::in_frame},
    {"need", "of the edge to the parent: 0 no_need, 1 need, 2 await", number<&M::need>, 0, Kept::in_frame},
    {"flood_done", "1: everybody below in the flood has answered", [](const M& m) { return m.flood_done ? 1.0 : 0.0; }},
    {"committed", "1: in this epoch's tree", [](const M& m) { return m.committed ? 1.0 : 0.0; }},
    {"parent_silent", "1: the parent has not been heard for too long",
     [](const M& m) { return m.parent_silent ? 1.0 : 0.0; }},
    {"root_told", "1: knows where the root is", number<&M::root_told>},
    {"pinned", "1: a corner is about to cut the edge to the parent", [](const M& m) { return m.pinned ? 1.0 : 0.0; }},
    {"id", "of the sender", robot<&M::id>, 0, Kept::in_frame},
    {"epoch", "counts the trees", number<&M::epoch>, 0, Kept::in_frame},
    {"root_sequence", "newest root token known: sequence",
     [](const M& m) { return static_cast<double>(m.root.sequence); }},
    {"root_id", "newest root token known: holder, -1: nobody",
     [](const M& m) { return m.root.id == nobody ? -1.0 : static_cast<double>(m.root.id); }},
    {"root_size", "robots that this root counted last, 0: none yet", number<&M::root_size>},
    {"label_cm", "distance to the root along hops when the epoch began, -1: unknown", known<&M::label_cm>, 0,
     Kept::in_frame},
    {"pulse", "the root's count as it came down the tree", number<&M::pulse>},
    {"depth", "in the tree, root 1; 0: no path of tree edges to the root", number<&M::depth>, 0, Kept::in_frame},
    {"tree_hops", "hops over free spares to the rooted tree, 0: in it, -1: no way known", known<&M::tree_hops>},
    {"call_hops", "hops to a need that nobody answers, -1: nobody calls", known<&M::call_hops>},
    {"parent", "robot, -1: nobody", robot<&M::parent>, 0, Kept::in_frame},
    {"old_parent", "in the old tree while trees are switched, -1: nobody", robot<&M::old_parent>, 0, Kept::in_frame},
    {"flood_parent", "the neighbour that gave the label, -1: nobody", robot<&M::flood_parent>},
    {"flood_robots", "robots labelled through this one, itself included", number<&M::flood_robots>},
    {"flood_workers", "workers among them", number<&M::flood_workers>},
    {"subtree", "1 + sum over the children", number<&M::subtree>},
    {"subtree_workers", "workers among them", number<&M::subtree_workers>},
    {"count", "c of Alg. 2; nobody decides by it", number<&M::count>},
    {"want_cm", "largest remaining way of a worker below, 0: all have arrived", number<&M::want_cm>, 0, Kept::in_frame},
    {"q_x_m", "Alg. 1's contribution, along the edge from the sender to its parent",
     [](const M& m) { return static_cast<double>(m.q.x); }, of_q},
    {"q_y_m", "the same, to the left of that edge", [](const M& m) { return static_cast<double>(m.q.y); }, of_q},
    {"pull_x", "attraction to the targets below, along the edge from the sender to its parent, -2 to 2",
     [](const M& m) { return m.pull_x / static_cast<double>(pull_unit); }, of_pull},
    {"pull_y", "the same, to the left of that edge",
     [](const M& m) { return m.pull_y / static_cast<double>(pull_unit); }, of_pull},
    {"grant", "the spare let into the edge to the parent, -1: nobody", robot<&M::grant>, 0, Kept::in_frame},
    {"request", "the owner of the edge a spare wants to join, -1: nobody", robot<&M::request>, 0, Kept::in_frame},
    {"inserted_child", "the robot above which the sender has just been inserted, -1: nobody",
     robot<&M::inserted_child>},
    {"warned", "the child whose line of sight to the sender is about to be cut, -1: nobody", robot<&M::warned>},
    {"new_root", "to whom the next root token is offered, -1: nobody", robot<&M::new_root>},
    {"centroid_x_cm", "centroid relative to new_root, along the edge from the sender to it", number<&M::centroid_x_cm>},
    {"centroid_y_cm", "the same, to the left of that edge", number<&M::centroid_y_cm>},
    {"hinge_x_cm", "known obstacle point nearest to the edge to the parent, relative to the parent, along that edge",
     number<&M::hinge_x_cm>},
    {"hinge_y_cm", "the same, to the left of that edge; 0, 0: none", number<&M::hinge_y_cm>},
    {"heartbeat", "the root's count of ticks, modulo 65536", number<&M::heartbeat>},
    {"serves", "of a worker: its target, by the worker first sent there, -1: none", robot<&M::serves>},
    {"told", "addressee of root and task, -1: nobody", robot<&M::told>},
    {"root_x_cm", "where the root is, relative to `told`, along the edge from the sender to it", number<&M::root_x_cm>,
     0, Kept::nowhere},
    {"root_y_cm", "the same, to the left of that edge", number<&M::root_y_cm>, 0, Kept::nowhere},
    {"task", "a target, by the worker first sent there, -1: none", robot<&M::task_serves>},
    {"task_holder", "who serves it, -1: given up", robot<&M::task_holder>},
    {"task_host", "at which target its branch is to begin, -1: no plan", robot<&M::task_host>},
    {"task_beat", "the holder's count of ticks, modulo 65536", number<&M::task_beat>},
    {"task_x_cm", "where it is, relative to `told`, along the edge from the sender to it", number<&M::task_x_cm>, 0,
     Kept::nowhere},
    {"task_y_cm", "the same, to the left of that edge", number<&M::task_y_cm>, 0, Kept::nowhere},
    {"child_count", "living children that are no spares", number<&M::child_count>},
    {"above", "next worker above in the tree, by its target, -1: none", robot<&M::above>},
    {"below", "the only worker below, by its target, -1: none or branches", robot<&M::below>},
});

// The name behind an enumerator's field; nothing for other fields.
std::string_view word(std::string_view field, const Message& message) noexcept {
  if (field == "role") return name_of(message.role);
  if (field == "phase") return name_of(message.phase);
  if (field == "need") return name_of(message.need);
  return {};
}

}  // namespace

std::span<const MessageField> message_fields() noexcept { return of_message; }

void write_message(Text& out, const Message& message) {
  out.put('{');
  for (const MessageField& field : of_message) {
    out.json_string(field.name);
    out.put(':');
    const std::string_view name = word(field.name, message);
    name.empty() ? out.shortest(field.get(message)) : out.json_string(name);
    out.put(',');
  }
  out.drop_last();
  out.put('}');
}

}  // namespace banyan::record
