// SPDX-License-Identifier: MIT
#include "banyan/controller/core/rows.hpp"

namespace banyan {

void Rows::close_gap(int k) noexcept {
  Word carry = 0;
  for (int n = words - 1; n >= k / bits; --n) {
    Word& word = words_[static_cast<std::size_t>(n)];
    const Word kept = n == k / bits ? bit(k) - 1 : 0;
    const Word moved = word >> 1 | carry << (bits - 1);
    carry = word & 1;
    word = (word & kept) | (moved & ~kept);
  }
}

}  // namespace banyan
