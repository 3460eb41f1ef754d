// SPDX-License-Identifier: MIT
// What a first minute shows: `banyan demo`, `banyan doctor` and the map in characters.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "started_program.hpp"
#include "terminal_map.hpp"

namespace banyan::cli {
namespace {

using record::Frame;
using record::RobotFrame;

std::vector<std::string> rows_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

RobotFrame robot(record::Vec2 position, Role role, std::int32_t parent = -1) {
  RobotFrame one;
  one.position = position;
  one.role = role;
  one.parent = parent;
  return one;
}

// 11 by 11 characters for a view of 10 x 20 m: a metre across and two metres down are a character each.
constexpr record::Viewport view{{-5.0, -10.0}, {5.0, 10.0}};
const MapStyle plain{11, 11, false};

TEST(TerminalMap, PutsEachRobotWhereItIs) {
  Frame frame;
  frame.robots = {robot({0.0, 0.0}, Role::root), robot({4.0, 0.0}, Role::worker), robot({-4.0, 8.0}, Role::spare),
                  robot({0.0, -8.0}, Role::connector)};
  frame.robots.push_back(robot({3.0, 4.0}, Role::spare));
  frame.robots.back().alive = false;
  frame.targets = {{{-3.0, -4.0}, -1, true}};
  const auto lines = rows_of(terminal_map(frame, view, plain));
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_EQ(lines[5], "     R   W");
  EXPECT_EQ(lines[1], " .");
  EXPECT_EQ(lines[9], "     o");
  EXPECT_EQ(lines[3], "        x");
  EXPECT_EQ(lines[7], "  +");
}

TEST(TerminalMap, DrawsEdgesOfTheTreeAndOfNothingElse) {
  Frame frame;
  frame.robots = {robot({-4.0, 0.0}, Role::root), robot({4.0, 0.0}, Role::worker, 0),
                  robot({-4.0, 8.0}, Role::spare, 0)};
  const auto lines = rows_of(terminal_map(frame, view, plain));
  // Braille patterns of three bytes each, of a level line from R to W.
  ASSERT_EQ(lines[5].size(), 1U + 1U + 3U * 7U + 1U);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(lines[5].substr(2 + 3 * k, 3), lines[5].substr(2, 3));
  for (const std::size_t empty : {0U, 2U, 3U, 4U, 6U, 10U}) EXPECT_EQ(lines[empty], "");
}

TEST(TerminalMap, DamageAndEmptinessAreNoHarm) {
  Frame frame;
  EXPECT_EQ(rows_of(terminal_map(frame, view, plain)), std::vector<std::string>(11));
  frame.robots = {robot({1e300, std::nan("")}, Role::worker, 7), robot({0.0, 0.0}, Role::connector, 0)};
  EXPECT_EQ(rows_of(terminal_map(frame, view, plain))[5], "     o");
}

class FirstMinute : public StartedProgram {};

TEST_F(FirstMinute, TheDemoEndsWithAMapAndLeavesNothing) {
  const auto outcome = run({"demo", "--terminal"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "All targets are held after ")) << outcome.out;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), 'W'), 4) << "three workers and the legend\n"
                                                                        << outcome.out;
  EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos) << "no terminal, no sequences";
  EXPECT_FALSE(exists("out"));
}

TEST_F(FirstMinute, TheDoctorTellsWhatIsThereAndWhatIsNot) {
  const auto outcome = run({"doctor", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto findings = nlohmann::json::parse(outcome.out).at("findings");
  const auto of = [&](const char* name) {
    return *std::find_if(findings.begin(), findings.end(), [&](const auto& f) { return f.at("name") == name; });
  };
  EXPECT_EQ(of("this folder").at("place"), std::filesystem::canonical(home_).string());
  EXPECT_TRUE(std::filesystem::exists(std::string(of("scenarios").at("place")) + "/three-targets.toml"));
  EXPECT_TRUE(of("banyan-robot").at("found"));
  const auto without = run({"doctor"}, {.environment = {{"PATH", "/nowhere"}}});
  EXPECT_EQ(without.code, 0);
  EXPECT_TRUE(has(without.out, "missing  ffmpeg")) << without.out;
  EXPECT_TRUE(has(without.out, "-> Debian: ffmpeg")) << without.out;
}

}  // namespace
}  // namespace banyan::cli
