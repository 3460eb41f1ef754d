// SPDX-License-Identifier: MIT
// Counters that wrap are compared by serial.hpp's functions alone: no `<`, `>`, std::max or std::min has one beside it.
// Which names they have is read from the controller's headers.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <string_view>

#include "sources.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path checkout = BANYAN_SOURCE_DIR;

std::string without_comments(const fs::path& path) {
  std::ifstream in(path);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

// The members of type Serial, as one expression: "epoch|seqno".
std::string serials() {
  static const std::regex member(R"(\n  Serial (\w+)(?: = 0)?;)");
  std::set<std::string> names;
  for (const fs::path& path : sources(checkout / "controller/include")) {
    const std::string text = without_comments(path);
    for (std::sregex_iterator it(text.begin(), text.end(), member), end; it != end; ++it) names.insert((*it)[1]);
  }
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : "|") + name;
  return all;
}

// Each place in `code` where such a counter is compared as a plain number.
std::string plain_comparisons(const std::string& code, const std::string& names) {
  const std::string value = R"((?:\w+(?:\(\))?(?:\.|->))*(?:)" + names + R"()\b)";
  const std::regex forms[] = {
      std::regex("(?:^|[^:\\w])(?:" + names + R"()\s*[<>]=?[^<>=])"),
      std::regex(R"([^-<>][<>]=?\s*)" + value),
      std::regex(R"(std::(?:max|min)(?:<[^<>]*>)?\((?:[^();]|\([^();]*\))*\b(?:)" + names + R"()\b)"),
  };
  std::string found;
  for (const std::regex& form : forms)
    for (std::sregex_iterator it(code.begin(), code.end(), form), end; it != end; ++it) found += it->str() + "\n";
  return found;
}

TEST(SerialNumbers, AreNotComparedAsPlainNumbers) {
  const std::string names = serials();
  for (const char* name : {"epoch", "seqno", "sequence", "heartbeat", "beat"})
    EXPECT_TRUE(std::regex_search(names, std::regex("\\b" + std::string(name) + "\\b"))) << name << " not in " << names;
  for (const char* room : {"controller/include", "controller/src", "measure/include", "measure/src"})
    for (const fs::path& path : sources(checkout / room))
      EXPECT_EQ(plain_comparisons(without_comments(path), names), "") << path;
}

// What the test would be worth nothing without.
TEST(SerialNumbers, EveryPlainComparisonIsSeen) {
  for (const char* code : {"if (a.epoch < b) return;", "a.epoch > 1", "return a->epoch >= b;", "x < robot.self.epoch",
                           "x <= h.message->epoch;", "std::max(a, b.epoch)",
                           "std::max<std::uint64_t>(run.epochs, root->epoch)", "std::min(f(a), b.epoch)"})
    EXPECT_NE(plain_comparisons(code, "epoch|beat"), "") << code;
}

TEST(SerialNumbers, WhatIsNoPlainComparisonIsNot) {
  for (const char* code : {"a->epoch == b.epoch", "out << a.epoch << b.epoch", "f<int, &Token::epoch>(a, b)",
                           "a.epochs < b.epochs", "ahead_by(a.beat, b.beat) < 5", "std::max(0, age) + a.epoch",
                           "a > b ? c.epoch : d->epoch", "f<Serial>(a.epoch)"})
    EXPECT_EQ(plain_comparisons(code, "epoch|beat"), "") << code;
}

}  // namespace
