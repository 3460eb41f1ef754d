// SPDX-License-Identifier: MIT
// Wire format, version 3: the fields in the order of the writer below, little-endian, no padding.
// Encoder and decoder share one list of fields, so they cannot drift apart.
#include "banyan/controller/message.hpp"

#include <bit>
#include <cmath>

namespace banyan {
namespace {

// Bits of the two packed bytes.
enum : std::uint8_t { flag_flood_done = 1, flag_committed = 2, flag_parent_silent = 4, flag_root_told = 8, flag_pinned = 16 };

std::uint8_t packed_states(const Message& m) noexcept {
  return static_cast<std::uint8_t>(static_cast<int>(m.role) | static_cast<int>(m.phase) << 2 | static_cast<int>(m.need) << 5);
}

std::uint8_t packed_flags(const Message& m) noexcept {
  return static_cast<std::uint8_t>((m.flood_done ? flag_flood_done : 0) | (m.committed ? flag_committed : 0) |
                                   (m.parent_silent ? flag_parent_silent : 0) | (m.root_told ? flag_root_told : 0) |
                                   (m.pinned ? flag_pinned : 0));
}

class Writer {
 public:
  explicit Writer(Wire& wire) noexcept : out_(wire.data()) {}
  void operator()(std::uint8_t v) noexcept { *out_++ = v; }
  void operator()(std::uint16_t v) noexcept {
    (*this)(static_cast<std::uint8_t>(v & 0xFF));
    (*this)(static_cast<std::uint8_t>(v >> 8));
  }
  void operator()(std::int16_t v) noexcept { (*this)(static_cast<std::uint16_t>(v)); }
  void operator()(float v) noexcept {
    const auto u = std::bit_cast<std::uint32_t>(v);
    (*this)(static_cast<std::uint16_t>(u & 0xFFFF));
    (*this)(static_cast<std::uint16_t>(u >> 16));
  }

 private:
  std::uint8_t* out_;
};

class Reader {
 public:
  explicit Reader(const std::uint8_t* bytes) noexcept : in_(bytes) {}
  void operator()(std::uint8_t& v) noexcept { v = *in_++; }
  void operator()(std::uint16_t& v) noexcept {
    v = static_cast<std::uint16_t>(in_[0] | in_[1] << 8);
    in_ += 2;
  }
  void operator()(std::int16_t& v) noexcept {
    std::uint16_t u = 0;
    (*this)(u);
    v = static_cast<std::int16_t>(u);
  }
  void operator()(float& v) noexcept {
    std::uint16_t low = 0;
    std::uint16_t high = 0;
    (*this)(low);
    (*this)(high);
    v = std::bit_cast<float>(static_cast<std::uint32_t>(low) | static_cast<std::uint32_t>(high) << 16);
  }

 private:
  const std::uint8_t* in_;
};

// Everything after the version and the two packed bytes, in wire order.
template <class Visitor, class M>
void visit_fields(Visitor& visit, M& m) noexcept {
  visit(m.id);
  visit(m.epoch);
  visit(m.root.sequence);
  visit(m.root.id);
  visit(m.root_size);
  visit(m.label_cm);
  visit(m.pulse);
  visit(m.depth);
  visit(m.tree_hops);
  visit(m.call_hops);
  visit(m.parent);
  visit(m.old_parent);
  visit(m.flood_parent);
  visit(m.flood_robots);
  visit(m.flood_workers);
  visit(m.subtree);
  visit(m.subtree_workers);
  visit(m.count);
  visit(m.want_cm);
  visit(m.q.x);
  visit(m.q.y);
  visit(m.pull_x);
  visit(m.pull_y);
  visit(m.grant);
  visit(m.request);
  visit(m.inserted_child);
  visit(m.warned);
  visit(m.new_root);
  visit(m.centroid_x_cm);
  visit(m.centroid_y_cm);
  visit(m.hinge_x_cm);
  visit(m.hinge_y_cm);
  visit(m.heartbeat);
  visit(m.serves);
  visit(m.told);
  visit(m.root_x_cm);
  visit(m.root_y_cm);
  visit(m.task_serves);
  visit(m.task_holder);
  visit(m.task_host);
  visit(m.task_beat);
  visit(m.task_x_cm);
  visit(m.task_y_cm);
  visit(m.child_count);
  visit(m.above);
  visit(m.below);
}

bool bounded(float q) noexcept { return std::fabs(q) <= q_limit_m; }  // false for NaN too

}  // namespace

Wire encode(const Message& message) noexcept {
  Wire wire{};
  Writer write(wire);
  write(wire_version);
  write(packed_states(message));
  write(packed_flags(message));
  visit_fields(write, message);
  return wire;
}

std::optional<Message> decode(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() != wire_size || bytes[0] != wire_version) return std::nullopt;
  const int states = bytes[1];
  const int flags = bytes[2];
  const int phase = states >> 2 & 7;
  const int need = states >> 5 & 3;
  if (states >> 7 != 0 || phase > static_cast<int>(Phase::select_root) || need > static_cast<int>(Need::await)) return std::nullopt;
  if (flags >> 5 != 0) return std::nullopt;
  Message m;
  m.role = static_cast<Role>(states & 3);
  m.phase = static_cast<Phase>(phase);
  m.need = static_cast<Need>(need);
  m.flood_done = (flags & flag_flood_done) != 0;
  m.committed = (flags & flag_committed) != 0;
  m.parent_silent = (flags & flag_parent_silent) != 0;
  m.root_told = (flags & flag_root_told) != 0;
  m.pinned = (flags & flag_pinned) != 0;
  Reader read(bytes.data() + 3);
  visit_fields(read, m);
  if (m.id == nobody || !bounded(m.q.x) || !bounded(m.q.y)) return std::nullopt;
  return m;
}

}  // namespace banyan
