// SPDX-License-Identifier: MIT
// From a message to bytes and back (protocol 1). A message type lists its fields once, in
// `visit_fields(visitor, message)`; everything here follows from that list:
//   visitor.choice(name, meaning, field, bits, last)  an enumerator up to `last`
//   visitor.flag(name, meaning, field)                one bit
//   visitor.number(name, meaning, field)              a whole number
//   visitor.known(name, meaning, field)               the same; its largest value says that there is none
//   visitor.robot(name, meaning, field)               an id
//   visitor.count(name, meaning, field)               a number of robots
//   visitor.scaled(name, meaning, field, unit)        a whole number of 1 / unit
//   visitor.coordinate(name, meaning, field)          a coordinate of a place, C (fixed_point.hpp)
//   visitor.real(name, meaning, field, limit)         a float of at most that magnitude
// and names its blocks in `blocks`. On the wire: a header byte, the choices and flags packed into bits,
// then the rest, little-endian, in the order of the list, without padding.
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/core/inputs.hpp"

namespace banyan {

// The header byte: the version of the format in its low three bits, and what a message is made of. The highest bit is
// reserved: nobody sets it.
inline constexpr std::uint8_t wire_version = 1;
namespace block {
inline constexpr std::uint8_t tree = 0;           // always there
inline constexpr std::uint8_t further = 1U << 3;  // a second byte follows, which names blocks beyond these
inline constexpr std::uint8_t healing = 1U << 4;
inline constexpr std::uint8_t obstacles = 1U << 5;
inline constexpr std::uint8_t convoy = 1U << 6;
// In the second byte:
inline constexpr std::uint8_t power = 1U << 0;
}  // namespace block

inline constexpr std::size_t largest_plain_wire = 96;  // bytes, without further blocks
inline constexpr std::size_t largest_wire = 112;       // with them

// The second byte of messages of this type; 0: they have none.
template <class Message> constexpr std::uint8_t further_blocks_of() noexcept {
  if constexpr (requires { Message::further_blocks; }) return Message::further_blocks;
  else return 0;
}

namespace wire {

// Visitors are inlined: firmware then contains no names and meanings.

// First pass: what is packed into bits.
class BitWriter {
 public:
  explicit BitWriter(std::uint8_t* out) noexcept : out_(out) {}
  template <class E> [[gnu::always_inline]] void choice(const char*, const char*, const E& v, int bits, E) noexcept {
    put(static_cast<unsigned>(v), bits);
  }
  [[gnu::always_inline]] void flag(const char*, const char*, bool v) noexcept { put(v ? 1U : 0U, 1); }
  template <class T> [[gnu::always_inline]] void number(const char*, const char*, const T&) noexcept {}
  template <class T> [[gnu::always_inline]] void known(const char*, const char*, const T&) noexcept {}
  [[gnu::always_inline]] void robot(const char*, const char*, RobotId) noexcept {}
  [[gnu::always_inline]] void count(const char*, const char*, RobotCount) noexcept {}
  template <class T> [[gnu::always_inline]] void scaled(const char*, const char*, const T&, float) noexcept {}
  [[gnu::always_inline]] void coordinate(const char*, const char*, Coordinate) noexcept {}
  [[gnu::always_inline]] void real(const char*, const char*, float, float) noexcept {}
  [[nodiscard]] std::uint8_t* end() const noexcept { return out_ + (used_ > 0 ? 1 : 0); }

 private:
  void put(unsigned v, int bits) noexcept {
    for (int k = 0; k < bits; ++k) {
      if (used_ == 0) *out_ = 0;
      *out_ = static_cast<std::uint8_t>(*out_ | ((v >> k & 1U) << used_));
      if (++used_ == 8) {
        used_ = 0;
        ++out_;
      }
    }
  }
  std::uint8_t* out_;
  int used_ = 0;
};

class BitReader {
 public:
  explicit BitReader(const std::uint8_t* in) noexcept : in_(in) {}
  template <class E> [[gnu::always_inline]] void choice(const char*, const char*, E& v, int bits, E last) noexcept {
    const unsigned value = take(bits);
    ok_ = ok_ && value <= static_cast<unsigned>(last);
    v = static_cast<E>(value);
  }
  [[gnu::always_inline]] void flag(const char*, const char*, bool& v) noexcept { v = take(1) != 0; }
  template <class T> [[gnu::always_inline]] void number(const char*, const char*, T&) noexcept {}
  template <class T> [[gnu::always_inline]] void known(const char*, const char*, T&) noexcept {}
  [[gnu::always_inline]] void robot(const char*, const char*, RobotId&) noexcept {}
  [[gnu::always_inline]] void count(const char*, const char*, RobotCount&) noexcept {}
  template <class T> [[gnu::always_inline]] void scaled(const char*, const char*, T&, float) noexcept {}
  [[gnu::always_inline]] void coordinate(const char*, const char*, Coordinate&) noexcept {}
  [[gnu::always_inline]] void real(const char*, const char*, float&, float) noexcept {}
  // What is left of the last byte must be zero.
  [[nodiscard]] bool ok() const noexcept { return ok_ && (used_ == 0 || (*in_ >> used_) == 0); }
  [[nodiscard]] const std::uint8_t* end() const noexcept { return in_ + (used_ > 0 ? 1 : 0); }

 private:
  unsigned take(int bits) noexcept {
    unsigned v = 0;
    for (int k = 0; k < bits; ++k) {
      v |= (static_cast<unsigned>(*in_) >> used_ & 1U) << k;
      if (++used_ == 8) {
        used_ = 0;
        ++in_;
      }
    }
    return v;
  }
  const std::uint8_t* in_;
  int used_ = 0;
  bool ok_ = true;
};

// Second pass: whole bytes.
class ByteWriter {
 public:
  explicit ByteWriter(std::uint8_t* out) noexcept : out_(out) {}
  template <class E> [[gnu::always_inline]] void choice(const char*, const char*, const E&, int, E) noexcept {}
  [[gnu::always_inline]] void flag(const char*, const char*, bool) noexcept {}
  template <class T> [[gnu::always_inline]] void number(const char*, const char*, const T& v) noexcept { put(v); }
  template <class T> [[gnu::always_inline]] void known(const char*, const char*, const T& v) noexcept { put(v); }
  [[gnu::always_inline]] void robot(const char*, const char*, RobotId v) noexcept { put(v); }
  [[gnu::always_inline]] void count(const char*, const char*, RobotCount v) noexcept { put(v); }
  template <class T> [[gnu::always_inline]] void scaled(const char*, const char*, const T& v, float) noexcept {
    put(v);
  }
  [[gnu::always_inline]] void coordinate(const char*, const char*, Coordinate v) noexcept { put(v.bits); }
  [[gnu::always_inline]] void real(const char*, const char*, float v, float) noexcept {
    put(std::bit_cast<std::uint32_t>(v));
  }
  [[nodiscard]] std::uint8_t* end() const noexcept { return out_; }

 private:
  template <std::integral T> void put(T v) noexcept {
    const std::uint32_t u = static_cast<std::make_unsigned_t<T>>(v);
    for (std::size_t k = 0; k < sizeof(T); ++k) *out_++ = static_cast<std::uint8_t>(u >> (8 * k) & 0xFFU);
  }
  std::uint8_t* out_;
};

class ByteReader {
 public:
  explicit ByteReader(const std::uint8_t* in) noexcept : in_(in) {}
  template <class E> [[gnu::always_inline]] void choice(const char*, const char*, E&, int, E) noexcept {}
  [[gnu::always_inline]] void flag(const char*, const char*, bool&) noexcept {}
  template <class T> [[gnu::always_inline]] void number(const char*, const char*, T& v) noexcept { v = take<T>(); }
  template <class T> [[gnu::always_inline]] void known(const char*, const char*, T& v) noexcept { v = take<T>(); }
  [[gnu::always_inline]] void robot(const char*, const char*, RobotId& v) noexcept { v = take<RobotId>(); }
  [[gnu::always_inline]] void count(const char*, const char*, RobotCount& v) noexcept { v = take<RobotCount>(); }
  template <class T> [[gnu::always_inline]] void scaled(const char*, const char*, T& v, float) noexcept {
    v = take<T>();
  }
  [[gnu::always_inline]] void coordinate(const char*, const char*, Coordinate& v) noexcept {
    v.bits = take<std::int16_t>();
    ok_ = ok_ && v.is_possible();
  }
  [[gnu::always_inline]] void real(const char*, const char*, float& v, float limit) noexcept {
    v = std::bit_cast<float>(take<std::uint32_t>());
    ok_ = ok_ && std::fabs(v) <= limit;  // false for NaN too
  }
  [[nodiscard]] bool ok() const noexcept { return ok_; }

 private:
  template <std::integral T> T take() noexcept {
    std::uint32_t u = 0;
    for (std::size_t k = 0; k < sizeof(T); ++k) u |= static_cast<std::uint32_t>(*in_++) << (8 * k);
    return static_cast<T>(u);
  }
  const std::uint8_t* in_;
  bool ok_ = true;
};

// How many bytes all of it takes.
class Counter {
 public:
  template <class E> constexpr void choice(const char*, const char*, const E&, int bits, E) noexcept { bits_ += bits; }
  constexpr void flag(const char*, const char*, bool) noexcept { ++bits_; }
  template <class T> constexpr void number(const char*, const char*, const T&) noexcept { bytes_ += sizeof(T); }
  template <class T> constexpr void known(const char*, const char*, const T&) noexcept { bytes_ += sizeof(T); }
  constexpr void robot(const char*, const char*, RobotId) noexcept { bytes_ += sizeof(RobotId); }
  constexpr void count(const char*, const char*, RobotCount) noexcept { bytes_ += sizeof(RobotCount); }
  template <class T> constexpr void scaled(const char*, const char*, const T&, float) noexcept { bytes_ += sizeof(T); }
  constexpr void coordinate(const char*, const char*, Coordinate) noexcept { bytes_ += sizeof(Coordinate); }
  constexpr void real(const char*, const char*, float, float) noexcept { bytes_ += sizeof(float); }
  [[nodiscard]] constexpr std::size_t bytes() const noexcept {
    return 1 + static_cast<std::size_t>(bits_ + 7) / 8 + bytes_;
  }

 private:
  int bits_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace wire

// Bytes of a message of this type.
template <class Message> constexpr std::size_t wire_size() noexcept {
  wire::Counter counter;
  const Message message{};
  visit_fields(counter, message);
  return counter.bytes() + (further_blocks_of<Message>() != 0 ? 1 : 0);
}

// Its first byte.
template <class Message> constexpr std::uint8_t header_of() noexcept {
  return static_cast<std::uint8_t>(wire_version | Message::blocks |
                                   (further_blocks_of<Message>() != 0 ? block::further : 0));
}

// Writes wire_size<Message>() bytes, for which `out` must have room. Returns how many.
template <class Message> std::size_t encode_fields(const Message& message, std::span<std::uint8_t> out) noexcept {
  constexpr std::uint8_t further = further_blocks_of<Message>();
  out[0] = header_of<Message>();
  if constexpr (further != 0) out[1] = further;
  wire::BitWriter bits(out.data() + (further != 0 ? 2 : 1));
  visit_fields(bits, message);
  wire::ByteWriter bytes(bits.end());
  visit_fields(bytes, message);
  return static_cast<std::size_t>(bytes.end() - out.data());
}

// Nothing if the size, the version, the blocks, an enumerator, a reserved bit or a float is not one that
// encode_fields() writes; never reads outside `bytes`.
template <class Message> std::optional<Message> decode_fields(std::span<const std::uint8_t> bytes) noexcept {
  constexpr std::uint8_t further = further_blocks_of<Message>();
  if (bytes.size() != wire_size<Message>() || bytes[0] != header_of<Message>()) return std::nullopt;
  if constexpr (further != 0)
    if (bytes[1] != further) return std::nullopt;
  Message message;
  wire::BitReader bits(bytes.data() + (further != 0 ? 2 : 1));
  visit_fields(bits, message);
  wire::ByteReader rest(bits.end());
  visit_fields(rest, message);
  if (!bits.ok() || !rest.ok() || message.id == nobody) return std::nullopt;
  return message;
}

}  // namespace banyan
