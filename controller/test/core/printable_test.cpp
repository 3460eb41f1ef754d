// SPDX-License-Identifier: MIT
#include "banyan/controller/core/printable.hpp"

#include <gtest/gtest.h>

namespace banyan {
namespace {

TEST(Printable, ControlCharactersAndBrokenTextAreEscaped) {
  EXPECT_EQ(printable("\x1b]0;owned\a\x1b[2Jok"), "\\x1b]0;owned\\x07\\x1b[2Jok");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("a\nb\rc\td\x7f"), "a\\nb\\rc\\td\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"), "\\u009b") << "C1 as UTF-8: a terminal takes it for ESC [";
  EXPECT_EQ(printable("\x9b[2J"), "\\x9b[2J") << "C1 as one byte";
  EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut short";
  EXPECT_EQ(printable("\xc0\x9b\xed\xa0\x80"), "\\xc0\\x9b\\xed\\xa0\\x80") << "overlong, surrogate";
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b\xe2\x80\xa8"),
            "a\\u202eb\\u2028")
      << "right to left, a line's end";
}

TEST(Printable, AnyOtherTextStaysAsItIs) {
  for (const char* text : {"", "worlds/a.toml:12: error", "Zürich \\ \"Œuvre\" – 東京 🌳", "\\x1b[2J"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, LinesStayLines) {
  EXPECT_EQ(printable_lines("a\x1b\nb\r\n\n"), "a\\x1b\nb\\r\n\n");
  EXPECT_EQ(printable_lines("\x1b"), "\\x1b");
}

// Whatever comes in, what goes out is UTF-8 without a control character, and doing it again changes nothing.
TEST(Printable, EveryPairOfBytes) {
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) {
      const std::string text = printable(std::string{static_cast<char>(a), static_cast<char>(b)});
      ASSERT_TRUE(valid_utf8(text)) << a << " " << b;
      for (const char c : text) ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) << a << " " << b;
      ASSERT_EQ(printable(text), text);
    }
  }
}

}  // namespace
}  // namespace banyan
