// SPDX-License-Identifier: MIT
#include "message_json.hpp"

#include <array>

#include "banyan/record/frame.hpp"

namespace banyan::record {
namespace {

using M = Message;

template <class T> constexpr double whole(T value) { return static_cast<double>(value); }
constexpr double id(RobotId robot) { return robot == nobody ? -1.0 : static_cast<double>(robot); }
constexpr double pull(std::int16_t value) { return static_cast<double>(value) / static_cast<double>(pull_unit); }

constexpr std::array<MessageField, 54> fields{{
    {"id", "of the sender", [](const M& m) { return id(m.id); }},
    {"role", "0 spare, 1 connector, 2 worker, 3 root", [](const M& m) { return whole(m.role); }},
    {"phase", "0 init, 1 start_tree, 2 select_parent, 3 grow_tree, 4 select_root",
     [](const M& m) { return whole(m.phase); }},
    {"need", "of the edge to the parent: 0 no_need, 1 need, 2 await", [](const M& m) { return whole(m.need); }},
    {"flood_done", "1: the flood's echo is complete below the sender",
     [](const M& m) { return m.flood_done ? 1.0 : 0.0; }},
    {"committed", "1: in this epoch's tree", [](const M& m) { return m.committed ? 1.0 : 0.0; }},
    {"parent_silent", "1: the parent has not been heard for longer than the table keeps it",
     [](const M& m) { return m.parent_silent ? 1.0 : 0.0; }},
    {"pinned", "1: a corner is about to cut the edge to the parent, and the sender has to go on",
     [](const M& m) { return m.pinned ? 1.0 : 0.0; }},
    {"epoch", "counts the trees", [](const M& m) { return whole(m.epoch); }},
    {"root_sequence", "of the newest root token known", [](const M& m) { return whole(m.root.sequence); }},
    {"root_id", "its holder, -1: nobody", [](const M& m) { return id(m.root.id); }},
    {"root_size", "robots that this root counted last, 0: none yet", [](const M& m) { return whole(m.root_size); }},
    {"label_cm", "cm; distance to the root along hops when the epoch began, -1: none yet",
     [](const M& m) { return m.label_cm == unknown_label ? -1.0 : whole(m.label_cm); }},
    {"pulse", "the root's count as it came down the tree", [](const M& m) { return whole(m.pulse); }},
    {"depth", "in the tree, root 1; 0: not connected to the root by tree edges",
     [](const M& m) { return whole(m.depth); }},
    {"tree_hops", "over free spares to the rooted tree, 0: in it, -1: no way known",
     [](const M& m) { return m.tree_hops == unreachable ? -1.0 : whole(m.tree_hops); }},
    {"call_hops", "to a need that nobody answers, -1: nobody calls",
     [](const M& m) { return m.call_hops == nobody_calls ? -1.0 : whole(m.call_hops); }},
    {"parent", "robot index, -1: nobody", [](const M& m) { return id(m.parent); }},
    {"old_parent", "the edge kept from the last epoch, -1: nobody", [](const M& m) { return id(m.old_parent); }},
    {"flood_parent", "the neighbour that gave the label, -1: nobody", [](const M& m) { return id(m.flood_parent); }},
    {"flood_robots", "robots labelled through the sender, itself included",
     [](const M& m) { return whole(m.flood_robots); }},
    {"flood_workers", "workers among them", [](const M& m) { return whole(m.flood_workers); }},
    {"subtree", "1 + sum over children", [](const M& m) { return whole(m.subtree); }},
    {"subtree_workers", "workers among them", [](const M& m) { return whole(m.subtree_workers); }},
    {"count", "c of the paper's Alg. 2", [](const M& m) { return whole(m.count); }},
    {"want_cm", "cm; the largest remaining way of a worker below, 0: all have arrived",
     [](const M& m) { return whole(m.want_cm); }},
    {"q_x_m", "m; Alg. 1's contribution, edge frame to the parent",
     [](const M& m) { return static_cast<double>(m.q.x); }},
    {"q_y_m", "m; Alg. 1's contribution, edge frame to the parent (y)",
     [](const M& m) { return static_cast<double>(m.q.y); }},
    {"pull_x", "attraction to the targets below, edge frame to the parent", [](const M& m) { return pull(m.pull_x); }},
    {"pull_y", "attraction to the targets below, edge frame to the parent (y)",
     [](const M& m) { return pull(m.pull_y); }},
    {"grant", "the spare let into the edge to the parent, -1: nobody", [](const M& m) { return id(m.grant); }},
    {"request", "the robot into whose edge a spare wants to be inserted, -1: nobody",
     [](const M& m) { return id(m.request); }},
    {"inserted_child", "the robot above which the sender has just been inserted, -1: nobody",
     [](const M& m) { return id(m.inserted_child); }},
    {"warned", "the child whose line of sight to the sender is about to be cut, -1: nobody",
     [](const M& m) { return id(m.warned); }},
    {"new_root", "to whom the root token with the next sequence is offered, -1: nobody",
     [](const M& m) { return id(m.new_root); }},
    {"centroid_x_cm", "cm; relative to the new root, edge frame to it",
     [](const M& m) { return whole(m.centroid_x_cm); }},
    {"centroid_y_cm", "cm; relative to the new root, edge frame to it (y)",
     [](const M& m) { return whole(m.centroid_y_cm); }},
    {"hinge_x_cm", "cm; the obstacle point nearest to the edge to the parent, relative to it, edge frame; 0, 0: none",
     [](const M& m) { return whole(m.hinge_x_cm); }},
    {"hinge_y_cm",
     "cm; the obstacle point nearest to the edge to the parent, relative to it, edge frame; 0, 0: none (y)",
     [](const M& m) { return whole(m.hinge_y_cm); }},
    {"heartbeat", "the root's count of ticks, modulo 2^16", [](const M& m) { return whole(m.heartbeat); }},
    {"serves", "of a worker: its target, named by the worker first sent there, -1: none",
     [](const M& m) { return id(m.serves); }},
    {"told", "addressee of the next vectors, -1: nobody", [](const M& m) { return id(m.told); }},
    {"root_told", "1: the sender knows where the root is", [](const M& m) { return m.root_told ? 1.0 : 0.0; }},
    {"root_x_cm", "cm; where the root is, relative to the addressee, edge frame",
     [](const M& m) { return whole(m.root_x_cm); }},
    {"root_y_cm", "cm; where the root is, relative to the addressee, edge frame (y)",
     [](const M& m) { return whole(m.root_y_cm); }},
    {"task_serves", "a target, by its first worker, -1: none", [](const M& m) { return id(m.task_serves); }},
    {"task_holder", "who serves it, -1: it has been given up", [](const M& m) { return id(m.task_holder); }},
    {"task_host", "the plan: at which target its branch is to begin, -1: no plan",
     [](const M& m) { return id(m.task_host); }},
    {"task_beat", "the holder's count of ticks, modulo 2^16", [](const M& m) { return whole(m.task_beat); }},
    {"task_x_cm", "cm; where it is, relative to the addressee, edge frame",
     [](const M& m) { return whole(m.task_x_cm); }},
    {"task_y_cm", "cm; where it is, relative to the addressee, edge frame (y)",
     [](const M& m) { return whole(m.task_y_cm); }},
    {"child_count", "living children that are no spares", [](const M& m) { return whole(m.child_count); }},
    {"above", "the next worker above in the tree, by its target, -1: none", [](const M& m) { return id(m.above); }},
    {"below", "the only worker below, -1: none, or there are branches", [](const M& m) { return id(m.below); }},
}};

// The name behind an enumerator's field; nothing for other fields.
std::string_view word(std::string_view field, const Message& message) noexcept {
  if (field == "role") return name_of(message.role);
  if (field == "phase") return name_of(message.phase);
  if (field == "need") return name_of(message.need);
  return {};
}

}  // namespace

std::span<const MessageField> message_fields() noexcept { return fields; }

void write_message(Text& out, const Message& message) {
  out.put('{');
  for (const MessageField& field : fields) {
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
