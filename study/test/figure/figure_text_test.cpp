// SPDX-License-Identifier: MIT
// Texts of figures: what they are made of, how wide they are, where they break.
#include "../../src/figure/figure_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace banyan::study {
namespace {

using namespace std::string_literals;
using Lines = std::vector<std::string>;

TEST(FigureText, KeepsWhatIsValid) {
  const std::string text = "λ₂ ≥ 0.5 – Größe 樹 \U0001F333 {a}_b^c \\ \"q\" 'r' $x @y `z`\nnext";
  EXPECT_EQ(clean(text), text);
}

TEST(FigureText, ReplacesWhatXmlForbids) {
  const std::string r = "\xEF\xBF\xBD";
  EXPECT_EQ(clean("a\tb\rc"), "a b c");
  EXPECT_EQ(clean("a\0b\x1b\x7f"s), "a" + r + "b" + r + r);
  EXPECT_EQ(clean("\xff"), r);
  EXPECT_EQ(clean("x\xc3"), "x" + r) << "cut";
  EXPECT_EQ(clean("\xc0\xaf"), r + r) << "overlong";
  EXPECT_EQ(clean("\xed\xa0\x80"), r + r + r) << "surrogate";
  EXPECT_EQ(clean("\xef\xbf\xbf"), r + r + r) << "U+FFFF";
  EXPECT_EQ(clean("\xf4\x90\x80\x80"), r + r + r + r) << "beyond U+10FFFF";
}

TEST(FigureText, IsAsWideAsItsCharacters) {
  // Advances in the font's own table, per 2048: T 1251, blank 651, = 1716, 2 1303.
  const double oracle = 12.0 * (1251 + 651 + 1716 + 651 + 1303) / 2048.0;
  EXPECT_GE(text_width("T = 2", 12.0), oracle);
  EXPECT_LE(text_width("T = 2", 12.0), oracle * 1.02);
  EXPECT_EQ(text_width("é", 10.0), text_width("樹", 10.0)) << "characters, not bytes";
}

TEST(FigureText, BreaksAtSpacesAndNewlines) {
  const double wide = text_width("two words", 12.0);
  EXPECT_EQ(wrapped("two words", wide, 12.0), (Lines{"two words"}));
  EXPECT_EQ(wrapped("two words", wide - 1.0, 12.0), (Lines{"two", "words"}));
  EXPECT_EQ(wrapped("a\n\nb", 500.0, 12.0), (Lines{"a", "", "b"}));
  EXPECT_EQ(wrapped("", 500.0, 12.0), Lines{});
  EXPECT_EQ(wrapped("incomprehensibilities", 10.0, 12.0), (Lines{"incomprehensibilities"}));
}

TEST(FigureText, FitsInAnyCase) {
  for (const char* text :
       {"a few short words and an incomprehensibility", "ééééééééééééééééééé", "x", "樹樹樹樹樹樹樹樹"}) {
    for (double width = 30.0; width < 200.0; width += 7.0) {
      for (const std::string& line : fitted(text, width, 12.0)) {
        EXPECT_LE(text_width(line, 12.0), width) << line;
        EXPECT_EQ(clean(line), line) << "cut within a character";
      }
    }
  }
  EXPECT_EQ(shortened("incomprehensible", 60.0, 12.0).substr(0, 3), "inc");
}

TEST(FigureText, NothingInQuotesIsACommand) {
  EXPECT_EQ(in_quotes("it's {a}_b # $x é"), "\"it's {a}_b # $x é\"");
  EXPECT_EQ(in_quotes("\"\\`@1\n"), R"("\042\134\140\100\061\012")");
  EXPECT_EQ(in_quotes("1\"23x4"), R"("1\042\062\063x4")");
}

TEST(FigureText, NumbersReadBack) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(-3.0), "-3");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "NaN");
  EXPECT_EQ(std::stod(number(0.1 + 0.2)), 0.1 + 0.2);
  EXPECT_EQ(fixed(0.5, 4), "0.5000");
}

}  // namespace
}  // namespace banyan::study
