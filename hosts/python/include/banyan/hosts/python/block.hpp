// SPDX-License-Identifier: MIT
// What robots sense and what is decided for them, as plain arrays: one block of memory holds all arrays of one swarm,
// or of many swarms of the same shape beside each other. One table of fields says what there is; memory, numpy arrays
// and documents follow from it. Knows no Python.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::python {

inline constexpr std::size_t id_bytes = 2;                                     // of the sender, in every message
inline constexpr std::size_t largest_payload = largest_plain_wire - id_bytes;  // what is left of a message, bytes
inline constexpr std::size_t most_seen = 8;                                    // obstacles that a robot senses at once

struct Shape {
  std::size_t robots = 0;
  std::size_t neighbours = 0;  // heard at once; of more, the nearest
  std::size_t payload = 0;     // bytes of a message besides the id, at most largest_payload
};

// clang-format off
enum class Field : std::uint8_t {
  worker, root, steps, sent, has_target, target, given_up, odometry, obstacles, obstacle_position,
  heard, sender, position, age, message, own_role, own_parent, suggested,
  velocity, broadcast, role, parent, serves, kept, count
};
// clang-format on
inline constexpr std::size_t fields_count = static_cast<std::size_t>(Field::count);

enum class Item : std::uint8_t { flag, byte, small, whole, real };  // bool, uint8, int8, int32, float32
[[nodiscard]] constexpr std::size_t size_of(Item item) noexcept {
  return item == Item::whole || item == Item::real ? 4 : 1;
}

// Axes of a field behind that of the robots.
enum class FieldAxis : std::uint8_t { none, two, three, neighbours, payload, obstacles, kept };

struct FieldInfoOf {
  Field field;
  const char* name;
  const char* meaning;
  Item item;
  std::array<FieldAxis, 2> axes;
  bool decided;           // written by who decides, not sensed
  std::int8_t blank = 0;  // while nothing else is known
};
// In the order of Field.
[[nodiscard]] std::span<const FieldInfoOf> fields() noexcept;
[[nodiscard]] std::size_t length(FieldAxis axis, const Shape& shape) noexcept;  // 1 for none

// The arrays of one swarm.
class Exchange {
 public:
  template <class T> [[nodiscard]] T* of(Field field) const noexcept {
    return reinterpret_cast<T*>(at_[static_cast<std::size_t>(field)]);
  }

 private:
  friend class Block;
  std::array<std::byte*, fields_count> at_{};
};

class Block {
 public:
  // All fields blank.
  explicit Block(const Shape& shape, std::size_t swarms = 1);
  [[nodiscard]] const Shape& shape() const noexcept { return shape_; }
  [[nodiscard]] std::size_t swarms() const noexcept { return swarms_; }
  [[nodiscard]] Exchange exchange(std::size_t swarm) noexcept;
  [[nodiscard]] std::byte* data(Field field) noexcept {
    return memory_.data() + offsets_[static_cast<std::size_t>(field)];
  }
  [[nodiscard]] std::size_t bytes_per_swarm(Field field) const noexcept;
  // Something has been decided for this swarm that its robots do not do yet.
  [[nodiscard]] std::uint8_t& decided(std::size_t swarm) noexcept { return decided_[swarm]; }
  [[nodiscard]] std::size_t memory_bytes() const noexcept { return memory_.size(); }
  // The arrays of one swarm, from another block of the same shape.
  void copy_from(Block& other, std::size_t from, std::size_t to);
  void clear(std::size_t swarm);

 private:
  Shape shape_;
  std::size_t swarms_;
  std::array<std::size_t, fields_count> offsets_{};
  std::vector<std::byte> memory_;
  std::vector<std::uint8_t> decided_;
};

}  // namespace banyan::python
