// SPDX-License-Identifier: MIT
// A set of entries of the neighbour table. Rooms that are about a few of them visit those, in ascending order, instead
// of asking every entry whether it is one.
#pragma once

#include <array>
#include <bit>
#include <cstddef>

namespace banyan {

inline constexpr int neighbor_capacity = 96;

class Rows {
 public:
  template <class Visit> void for_each(Visit visit) const noexcept {
    for (int n = 0; n < words; ++n)
      for (Word left = words_[static_cast<std::size_t>(n)]; left != 0; left &= left - 1)
        visit(n * bits + std::countr_zero(left));
  }
  [[nodiscard]] bool has(int k) const noexcept {
    return k >= 0 && (words_[static_cast<std::size_t>(k / bits)] & bit(k)) != 0;
  }
  void set(int k, bool belongs) noexcept {
    Word& word = words_[static_cast<std::size_t>(k / bits)];
    word = (word & ~bit(k)) | (Word{belongs} << (k % bits));
  }
  // Entry k leaves the table, and those behind it move up by one.
  void close_gap(int k) noexcept;

 private:
  using Word = std::size_t;  // what the processor computes with
  static constexpr int bits = 8 * static_cast<int>(sizeof(Word));
  static constexpr int words = (neighbor_capacity + bits - 1) / bits;
  static Word bit(int k) noexcept { return Word{1} << (k % bits); }

  std::array<Word, words> words_{};
};

}  // namespace banyan
