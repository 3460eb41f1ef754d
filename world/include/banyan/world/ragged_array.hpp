// SPDX-License-Identifier: MIT
// Rows of varying length, one after the other in one array. Each has some room to grow, so that the
// array is laid out anew now and then, not for every new item. Behind each row the next `spare` items may be read, too,
// whatever they are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace banyan::world {

template <class T, std::size_t spare = 0> class RaggedArray {
 public:
  explicit RaggedArray(std::size_t rows) : begin_(rows + 1, 0), size_(rows, 0) {}

  [[nodiscard]] std::span<T> of(std::size_t row) noexcept { return {items_.data() + begin_[row], size_[row]}; }
  [[nodiscard]] std::span<const T> of(std::size_t row) const noexcept {
    return {items_.data() + begin_[row], size_[row]};
  }

  // Makes the row `size` long, whatever is in it then. False, and nothing has changed, if there is no room.
  [[nodiscard]] bool resize(std::size_t row, std::size_t size) noexcept {
    if (begin_[row] + size + spare > begin_[row + 1]) return false;
    size_[row] = static_cast<std::uint32_t>(size);
    return true;
  }

  void clear(std::size_t row) noexcept { size_[row] = 0; }
  // At the end. There must be room.
  void append(std::size_t row, T item) noexcept { items_[begin_[row] + size_[row]++] = item; }
  // Into an ascending row. False, and nothing has changed, if there is no room.
  [[nodiscard]] bool insert(std::size_t row, T item) noexcept {
    if (!resize(row, size_[row] + std::size_t{1})) return false;
    const auto end = of(row).end() - 1;
    const auto at = std::upper_bound(of(row).begin(), end, item);
    std::copy_backward(at, end, end + 1);
    *at = item;
    return true;
  }
  // From an ascending row that has it.
  void erase(std::size_t row, T item) noexcept {
    const auto at = std::lower_bound(of(row).begin(), of(row).end(), item);
    std::copy(at + 1, of(row).end(), at);
    --size_[row];
  }

  // Gives row r room for at least wanted(r) items, which is no less than its size. Keeps what is in the
  // rows. Takes from the heap only when all of them together are more than ever before.
  template <class Wanted> void lay_out(Wanted wanted) {
    const std::size_t rows = size_.size();
    std::size_t end = 0;
    for (std::size_t r = 0; r < rows; ++r) {  // all to the front, none behind where it was
      std::copy_n(items_.begin() + begin_[r], size_[r], items_.begin() + static_cast<std::ptrdiff_t>(end));
      end += size_[r];
    }
    begin_[0] = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      const std::size_t size = wanted(r);
      begin_[r + 1] = begin_[r] + static_cast<std::uint32_t>(size + size / 8 + 3 + spare);
    }
    if (begin_[rows] > items_.size()) {
      if (begin_[rows] > items_.capacity()) items_.reserve(begin_[rows] + begin_[rows] / 8);
      items_.resize(begin_[rows]);
    }
    for (std::size_t r = rows; r-- > 0;) {  // and apart again, the last one first
      end -= size_[r];
      const auto from = items_.begin() + static_cast<std::ptrdiff_t>(end);
      std::copy_backward(from, from + size_[r], items_.begin() + begin_[r] + size_[r]);
    }
  }

  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return items_.capacity() * sizeof(T) + (begin_.capacity() + size_.capacity()) * sizeof(std::uint32_t);
  }

 private:
  std::vector<T> items_;
  std::vector<std::uint32_t> begin_, size_;
};

}  // namespace banyan::world
