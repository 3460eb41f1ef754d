// SPDX-License-Identifier: MIT
// Files become trees with places; what is no scenario text is refused with a reason.
#include "banyan/config/document.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace banyan::config {
namespace {

std::string failure_of(const std::string& path, const std::string& text) {
  try {
    (void)parse_document(path, text);
  } catch (const DocumentError& e) { return e.what(); }
  return "parsed";
}

TEST(Document, KeepsTheLineOfEveryTomlValue) {
  const Node root = parse_document("a.toml", "x = 1\n\n[s]\ny = [1.5,\n  true]\n[[t]]\nz = \"w\"\n");

  EXPECT_EQ(root.find("x")->place.line, 1);
  const Node* s = root.find("s");
  ASSERT_TRUE(s && s->table());
  EXPECT_EQ(s->find("y")->place.line, 4);
  EXPECT_EQ((*s->find("y")->array())[1].place.line, 5);
  EXPECT_EQ((*root.find("t")->array())[0].find("z")->place.line, 7);
  EXPECT_EQ(root.find("x")->place.text(), "a.toml:1");
}

TEST(Document, KeepsTheLineOfEveryJsonValue) {
  const Node root = parse_document("a.json", "{\"x\": 1\n,\n\"s\": {\n\"y\": [1.5,\n true], \"z\":\n\"w\"}}");

  EXPECT_EQ(root.find("x")->place.line, 1);
  EXPECT_EQ(root.find("s")->place.line, 3);
  EXPECT_EQ(root.find("s")->find("y")->place.line, 4);
  EXPECT_EQ((*root.find("s")->find("y")->array())[0].place.line, 4);
  EXPECT_EQ((*root.find("s")->find("y")->array())[1].place.line, 5);
  EXPECT_EQ(root.find("s")->find("z")->place.line, 5);  // where the key is
}

TEST(Document, TomlAndJsonOfTheSameTreeAreEqual) {
  const Node toml = parse_document("a.toml", "a = 1\nb = [0.5, \"t\"]\n[c]\nd = false\n");
  const Node json = parse_document("a.json", R"({"a": 1, "b": [0.5, "t"], "c": {"d": false}})");

  for (const Node* root : {&toml, &json}) {
    EXPECT_EQ(std::get<std::int64_t>(root->find("a")->value), 1);
    EXPECT_EQ(std::get<double>((*root->find("b")->array())[0].value), 0.5);
    EXPECT_EQ(*(*root->find("b")->array())[1].string(), "t");
    EXPECT_FALSE(std::get<bool>(root->find("c")->find("d")->value));
  }
}

TEST(Document, SyntaxErrorsNameTheLine) {
  EXPECT_NE(failure_of("a.toml", "x = 1\ny = = 2\n").find("a.toml:2: error: this is not TOML"), std::string::npos);
  EXPECT_NE(failure_of("a.json", "{\"x\": 1,\n\"y\" 2}").find("a.json:2: error: this is not JSON"), std::string::npos);
  EXPECT_NE(failure_of("a.json", "{\"x\": 1, \"x\": 2}").find("\"x\" is given twice"), std::string::npos);
  EXPECT_NE(failure_of("a.toml", "x = 1\nx = 2\n").find("a.toml:2"), std::string::npos);
  EXPECT_NE(failure_of("a.json", "[1, 2]").find("a scenario is a table"), std::string::npos);
  EXPECT_NE(failure_of("a.json", "{\"x\": 1e999}").find("a.json:1"), std::string::npos);
}

TEST(Document, EndlessNestingIsRefusedNotFollowed) {
  EXPECT_NE(failure_of("a.json", "{\"a\":" + std::string(1'000'000, '[')).find("nested too deeply"), std::string::npos);
  EXPECT_NE(failure_of("a.toml", "a = " + std::string(1'000'000, '[')), "parsed");
  std::string dotted = "a";
  for (int i = 0; i < 1'000'000; ++i) dotted += ".a";
  EXPECT_NE(failure_of("a.toml", dotted + " = 1"), "parsed");
}

TEST(Document, ReadsPipesAndRefusesWhatIsNoText) {
  const auto directory = std::filesystem::temp_directory_path() / ("banyan-document-" + std::to_string(::getpid()));
  std::filesystem::create_directories(directory);
  const auto path = [&](const char* name) { return (directory / name).string(); };
  std::ofstream(path("binary")) << std::string("a\0b", 3);
  std::ofstream(path("blank")) << " \n\t\n";
  std::ofstream(path("bom")) << "\xEF\xBB\xBFseed = 1\n";

  const auto reason = [](const std::string& file) {
    try {
      (void)read_text_file(file);
    } catch (const DocumentError& e) { return std::string(e.what()); }
    return std::string("read");
  };
  EXPECT_NE(reason(path("missing")).find("there is no such file"), std::string::npos);
  EXPECT_NE(reason(directory.string()).find("is a directory"), std::string::npos);
  EXPECT_NE(reason(path("binary")).find("is a binary file"), std::string::npos);
  EXPECT_NE(reason(path("blank")).find("is empty"), std::string::npos);
  EXPECT_NE(reason("/dev/zero").find("larger than 64 MiB"), std::string::npos);
  EXPECT_EQ(read_text_file(path("bom")), "seed = 1\n");
  std::filesystem::remove_all(directory);
}

TEST(Override, TakesTomlOrBareText) {
  Node root = parse_document("a.toml", "[radio]\nloss = 0.1\n[[events]]\ntime_s = 1\n");

  EXPECT_TRUE(apply_override(root, "radio.loss=0.3", "--set").empty());
  EXPECT_TRUE(apply_override(root, "mission.algorithm = inwards", "--set").empty());
  EXPECT_TRUE(apply_override(root, "name=\"x y\"", "--set").empty());
  EXPECT_TRUE(apply_override(root, "events[0].time_s=2", "--set").empty());
  EXPECT_TRUE(apply_override(root, "targets.positions_m=[[1, 2]]", "--set").empty());

  EXPECT_EQ(std::get<double>(root.find("radio")->find("loss")->value), 0.3);
  EXPECT_EQ(*root.find("mission")->find("algorithm")->string(), "inwards");
  EXPECT_EQ(*root.find("name")->string(), "x y");
  EXPECT_EQ(std::get<std::int64_t>((*root.find("events")->array())[0].find("time_s")->value), 2);
  EXPECT_EQ((*root.find("targets")->find("positions_m")->array()).size(), 1U);
}

TEST(Override, OneAssignmentSetsOneKey) {
  Node root = parse_document("a.toml", "seed = 1\n");

  EXPECT_TRUE(apply_override(root, "name=1\nseed = 2", "--set").empty());

  EXPECT_EQ(*root.find("name")->string(), "1\nseed = 2");  // bare text, for the reader to refuse
  EXPECT_EQ(std::get<std::int64_t>(root.find("seed")->value), 1);
}

TEST(Override, SaysWhatIsWrongWithIt) {
  for (const char* bad : {"", "radio", "=1", ".a=1", "a.=1", "a..b=1", "a[=1", "a[x]=1", "a[0]b=1", "events[7].x=1",
                          "seed[0]=1", "name=\xff"}) {
    Node root = parse_document("a.toml", "seed = 1\nevents = [{}]\n");
    EXPECT_EQ(apply_override(root, bad, "--set x").size(), 1U) << bad;
  }
}

TEST(Assign, MakesWhatIsMissingAndReachesIntoLists) {
  Node root = parse_document("a.toml", "x = 1\n[[events]]\ntime_s = 1\n[[events]]\ntime_s = 2\n");

  EXPECT_TRUE(assign(root, "a.b.c", {std::int64_t{5}, {}}).empty());
  EXPECT_TRUE(assign(root, "events[1].time_s", {3.5, {}}).empty());
  EXPECT_TRUE(assign(root, "x", {true, {}}).empty());
  EXPECT_TRUE(assign(root, "events[0]", {std::string("whole"), {}}).empty());

  EXPECT_EQ(std::get<std::int64_t>(root.find("a")->find("b")->find("c")->value), 5);
  const auto& events = *root.find("events")->array();
  EXPECT_EQ(std::get<double>(events[1].find("time_s")->value), 3.5);
  EXPECT_EQ(*events[0].string(), "whole");
  EXPECT_TRUE(std::get<bool>(root.find("x")->value));
}

TEST(Assign, FaultsAreAtThePlaceOfTheValue) {
  Node root = parse_document("a.toml", "x = 1\nevents = []\n");
  const Node value = parse_document("b.toml", "\n\nv = 1\n").table()->front().value;

  for (const char* key : {"", "a..b", "events[0]", "x[0]", ".a", "a[", "a[b]"}) {
    const auto problems = assign(root, key, value);
    ASSERT_EQ(problems.size(), 1U) << key;
    EXPECT_EQ(problems[0].place.text(), "b.toml:3") << key;
  }
}

TEST(AsOption, KeepsEveryPlaceInWordsButNotAsAFile) {
  const Node option = as_option(parse_document("a.toml", "[s]\ny = [1,\n 2]\n"));

  const Node* y = option.find("s")->find("y");
  EXPECT_EQ(y->place.text(), "a.toml:2");
  EXPECT_FALSE(y->place.from_file());
  EXPECT_EQ((*y->array())[1].place.text(), "a.toml:3");
  EXPECT_EQ(as_option(option).find("s")->find("y")->place.text(), "a.toml:2");  // again is no change
}

TEST(Overlay, MergesTablesAndReplacesTheRest) {
  Node root = parse_document("a.toml", "x = 1\nl = [1, 2]\n[s]\na = 1\nb = 2\n[t]\nq = 1\n");

  overlay(root, parse_document("b.toml", "l = [3]\nn = 4\nt = 5\n[s]\nb = 3\nc.d = 4\n[x]\ny = 1\n"));

  EXPECT_EQ(root.find("l")->array()->size(), 1U);
  EXPECT_EQ(std::get<std::int64_t>(root.find("n")->value), 4);
  EXPECT_EQ(std::get<std::int64_t>(root.find("t")->value), 5);
  EXPECT_EQ(std::get<std::int64_t>(root.find("s")->find("a")->value), 1);
  EXPECT_EQ(std::get<std::int64_t>(root.find("s")->find("b")->value), 3);
  EXPECT_EQ(std::get<std::int64_t>(root.find("s")->find("c")->find("d")->value), 4);
  EXPECT_EQ(std::get<std::int64_t>(root.find("x")->find("y")->value), 1);
  EXPECT_EQ(root.find("s")->find("b")->place.text(), "b.toml:5");
}

TEST(Nearest, FindsWhatWasMeant) {
  const std::vector<std::string_view> keys = {"range_m", "line_of_sight", "loss", "latency_ticks"};

  EXPECT_EQ(nearest("lost", keys), "loss");
  EXPECT_EQ(nearest("range", keys), "range_m");
  EXPECT_EQ(nearest("line_of_site", keys), "line_of_sight");
  EXPECT_EQ(nearest("zzzzzzzz", keys), "");
}

}  // namespace
}  // namespace banyan::config
