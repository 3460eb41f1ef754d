// SPDX-License-Identifier: MIT
#include "banyan/hosts/python/block.hpp"

#include <algorithm>
#include <cstring>

namespace banyan::python {
namespace {

constexpr std::size_t cache_line = 64;

// A row for each field.
// clang-format off
constexpr std::array<FieldInfoOf, fields_count> table{{
    {Field::worker, "worker", "it was sent to a target at the start", Item::flag, {}, false},
    {Field::root, "root", "it was the root at the start", Item::flag, {}, false},
    {Field::steps, "steps", "it lives, and its clock says that it steps now", Item::flag, {}, false},
    {Field::sent, "sent", "it has been sent to a target", Item::flag, {}, false},
    {Field::has_target, "has_target", "that target is sensed now", Item::flag, {}, false},
    {Field::target, "target", "from the robot to its target, m, own frame", Item::real,
      {FieldAxis::two, FieldAxis::none}, false},
    {Field::given_up, "given_up", "a target that has been given up, by the robot first sent there; -1: none",
      Item::whole, {}, false, -1},
    {Field::odometry, "odometry", "own motion since the last step: forward m, left m, turn rad", Item::real,
      {FieldAxis::three, FieldAxis::none}, false},
    {Field::obstacles, "obstacles", "how many obstacles are within reach of its sensor", Item::whole, {}, false},
    {Field::obstacle_position, "obstacle_position", "their nearest points, m, own frame", Item::real,
      {FieldAxis::obstacles, FieldAxis::two}, false},
    {Field::heard, "heard", "how many neighbours are heard", Item::whole, {}, false},
    {Field::sender, "sender", "their ids; -1 behind the last", Item::whole, {FieldAxis::neighbours, FieldAxis::none},
      false, -1},
    {Field::position, "position", "where they are, m, own frame", Item::real, {FieldAxis::neighbours, FieldAxis::two},
      false},
    {Field::age, "age", "ticks since they composed the message", Item::whole, {FieldAxis::neighbours, FieldAxis::none},
      false},
    {Field::message, "message", "what they broadcast", Item::byte, {FieldAxis::neighbours, FieldAxis::payload}, false},
    {Field::own_role, "own_role", "the role that it reported last", Item::small, {}, false},
    {Field::own_parent, "own_parent", "the parent that it reported last; -1: nobody", Item::whole, {}, false, -1},
    {Field::suggested, "suggested", "velocity of the algorithm beneath, if there is one", Item::real,
      {FieldAxis::three, FieldAxis::none}, false},
    {Field::velocity, "velocity", "forward m/s, left m/s, turn rad/s", Item::real, {FieldAxis::three, FieldAxis::none},
      true},
    {Field::broadcast, "broadcast", "what its neighbours hear", Item::byte, {FieldAxis::payload, FieldAxis::none},
      true},
    {Field::role, "role", "spare 0, connector 1, worker 2, root 3; -1: as it was sent", Item::small, {}, true, -1},
    {Field::parent, "parent", "the robot whose link it promises to keep; -1: nobody", Item::whole, {}, true, -1},
    {Field::serves, "serves", "a worker's target, by the robot first sent there; -1: none, -2: its own", Item::whole,
      {}, true, -2},
    {Field::kept, "kept", "further links that it promises to keep; -1: nobody", Item::whole,
      {FieldAxis::kept, FieldAxis::none}, true, -1},
}};
// clang-format on

}  // namespace

std::span<const FieldInfoOf> fields() noexcept { return table; }

std::size_t length(FieldAxis axis, const Shape& shape) noexcept {
  switch (axis) {
    case FieldAxis::two: return 2;
    case FieldAxis::three: return 3;
    case FieldAxis::neighbours: return shape.neighbours;
    case FieldAxis::payload: return shape.payload;
    case FieldAxis::obstacles: return most_seen;
    case FieldAxis::kept: return most_kept_links;
    default: return 1;
  }
}

Block::Block(const Shape& shape, std::size_t swarms) : shape_(shape), swarms_(swarms), decided_(swarms, 0) {
  std::size_t size = 0;
  for (std::size_t f = 0; f < fields_count; ++f) {
    offsets_[f] = size;
    const std::size_t bytes = swarms * bytes_per_swarm(static_cast<Field>(f));
    size += (bytes + cache_line - 1) / cache_line * cache_line;
  }
  memory_.resize(size);
  for (std::size_t s = 0; s < swarms; ++s) clear(s);
}

std::size_t Block::bytes_per_swarm(Field field) const noexcept {
  const FieldInfoOf& info = table[static_cast<std::size_t>(field)];
  return shape_.robots * size_of(info.item) * length(info.axes[0], shape_) * length(info.axes[1], shape_);
}

Exchange Block::exchange(std::size_t swarm) noexcept {
  Exchange exchange;
  for (const FieldInfoOf& info : table)
    exchange.at_[static_cast<std::size_t>(info.field)] = data(info.field) + swarm * bytes_per_swarm(info.field);
  return exchange;
}

void Block::copy_from(Block& other, std::size_t from, std::size_t to) {
  for (const FieldInfoOf& info : table) {
    const std::size_t bytes = bytes_per_swarm(info.field);
    if (bytes > 0) std::memcpy(data(info.field) + to * bytes, other.data(info.field) + from * bytes, bytes);
  }
  decided_[to] = other.decided_[from];
}

void Block::clear(std::size_t swarm) {
  for (const FieldInfoOf& info : table) {
    const std::size_t bytes = bytes_per_swarm(info.field);
    std::byte* const begin = data(info.field) + swarm * bytes;
    if (info.item == Item::whole)
      std::fill_n(reinterpret_cast<std::int32_t*>(begin), bytes / size_of(info.item), info.blank);
    else std::fill_n(begin, bytes, static_cast<std::byte>(info.blank));
  }
  decided_[swarm] = 0;
}

}  // namespace banyan::python
