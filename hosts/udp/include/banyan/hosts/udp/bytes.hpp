// SPDX-License-Identifier: MIT
// Little-endian numbers in a datagram: written one after the other, and read back with every length checked.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace banyan::udp {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

class DatagramWriter {
 public:
  explicit DatagramWriter(Bytes& out) noexcept : out_(out) {}
  template <std::integral T> void put(T value) {
    const auto bits = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<T>>(value));
    for (std::size_t k = 0; k < sizeof(T); ++k) out_.push_back(static_cast<std::uint8_t>(bits >> (8 * k) & 0xFFU));
  }
  void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }
  void put(ByteView bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }

 private:
  Bytes& out_;
};

// Beyond the end everything reads as zero and ok() is false.
class DatagramReader {
 public:
  explicit DatagramReader(ByteView in) noexcept : in_(in) {}
  template <std::integral T> [[nodiscard]] T take() noexcept {
    std::uint64_t bits = 0;
    const ByteView bytes = take(sizeof(T));
    for (std::size_t k = 0; k < bytes.size(); ++k) bits |= static_cast<std::uint64_t>(bytes[k]) << (8 * k);
    return static_cast<T>(bits);
  }
  [[nodiscard]] float take_float() noexcept { return std::bit_cast<float>(take<std::uint32_t>()); }
  [[nodiscard]] ByteView take(std::size_t count) noexcept {
    if (count > in_.size()) {
      ok_ = false;
      in_ = {};
      return {};
    }
    const ByteView taken = in_.first(count);
    in_ = in_.subspan(count);
    return taken;
  }
  [[nodiscard]] std::size_t left() const noexcept { return in_.size(); }
  [[nodiscard]] bool ok() const noexcept { return ok_; }
  [[nodiscard]] bool at_end() const noexcept { return ok_ && in_.empty(); }

 private:
  ByteView in_;
  bool ok_ = true;
};

}  // namespace banyan::udp
