// SPDX-License-Identifier: MIT
// Numbers and strings as text: fixed decimals, no locale, no stream, no allocation once the buffer
// has grown. A frame of 94 robots is some 1,700 numbers, written at every tick.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace banyan::record {

class Text {
 public:
  void clear() noexcept { size_ = 0; }
  [[nodiscard]] std::string_view view() const noexcept { return {buffer_.data(), size_}; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  void put(char c) {
    *space(1) = c;
    ++size_;
  }
  void put(std::string_view text);
  void integer(std::int64_t value);
  // The same for numbers that mostly have one digit or are -1.
  void small_integer(std::int64_t value) {
    char* at = space(2);
    if (value >= 0 && value < 10) {
      at[0] = static_cast<char>('0' + value);
      size_ += 1;
    } else if (value == -1) {
      at[0] = '-';
      at[1] = '1';
      size_ += 2;
    } else {
      integer(value);
    }
  }
  void natural(std::uint64_t value);
  // `decimals` in [0, 9]; half away from zero, no "-0". `otherwise` for what is not finite.
  void fixed(double value, int decimals, std::string_view otherwise = "null");
  void shortest(double value);              // the fewest digits that read back as `value`; null if not finite
  void json_string(std::string_view text);  // quoted; invalid UTF-8 becomes U+FFFD
  void xml(std::string_view text);          // escaped for text and attributes
  void drop_last() noexcept { --size_; }    // a trailing comma
  // Room for n more bytes; advance() after writing them.
  char* space(std::size_t n) {
    if (buffer_.size() - size_ < n) grow(n);
    return buffer_.data() + size_;
  }
  void advance_to(const char* end) noexcept { size_ = static_cast<std::size_t>(end - buffer_.data()); }

 private:
  void grow(std::size_t n);

  std::string buffer_;
  std::size_t size_ = 0;
};

}  // namespace banyan::record
