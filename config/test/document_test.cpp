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
  EXPECT_NE(reason("/dev/zero").find("larger than 8 MiB"), std::string::npos);
  EXPECT_EQ(read_text_file(path("bom")), "seed = 1\n");
  std::filesystem::remove_all(directory);
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
