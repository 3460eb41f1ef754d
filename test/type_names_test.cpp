// SPDX-License-Identifier: MIT
// One name, one thing: no two types of the house have the same name. Reads every source file that is no test and names
// each type that is defined twice. A member belongs to its class (Radio::Row), and two aliases for the same type are
// one. Each algorithm of other authors speaks their language, in a namespace of its own that no other includes: their
// names are compared with those of the rooms, not with one another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sources.hpp"

namespace {

namespace fs = std::filesystem;

constexpr std::string_view rooms[] = {"controller", "baselines", "algorithms", "world", "measure", "record",
                                      "config",     "study",     "hosts",      "cli",   "viewer",  "test/soak"};

// Vec2 is single on the robot and double around it. Heard is what an algorithm hears, beside its Params, State,
// Message.
const std::set<std::string> allowed = {"Vec2", "Heard"};

// Without comments, and with nothing between quotes. An apostrophe within a number is no quote.
std::string code_of(std::string_view text) {
  std::string code;
  const auto end_of = [&](std::string_view end, std::size_t from) {
    const std::size_t at = text.find(end, from);
    return at == std::string_view::npos ? text.size() : at + end.size();
  };
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    const bool after_word = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0);
    if (rest.starts_with("//")) {
      i = std::min(text.find('\n', i), text.size());
    } else if (rest.starts_with("/*")) {
      i = end_of("*/", i);
    } else if (rest.starts_with("R\"")) {
      i = end_of(")" + std::string(rest.substr(2, rest.find('(') - 2)) + "\"", i);
    } else if (rest.front() == '"' || (rest.front() == '\'' && !after_word)) {
      const char quote = text[i++];
      while (i < text.size() && text[i] != quote) i += text[i] == '\\' ? 2 : 1;
      ++i;
    } else {
      code += text[i++];
    }
  }
  return code;
}

struct Definition {
  std::string name;
  std::string alias;  // what it stands for; "" if it is a type of its own
  std::string file;
};

// The types that `text` defines outside of classes and functions. Braces that do not match are a definition of "}".
std::vector<Definition> definitions(const std::string& text, const std::string& file) {
  static const std::regex type(
      R"(\b(?:struct|class|union|enum)\s+(?:(?:class|struct)\s+)?(?:alignas\((?:[^()]|\([^()]*\))*\)\s*)?(\w+))"
      R"((?:\s+final)?\s*(?::(?!:)[^]*)?$)");
  static const std::regex alias(R"(\busing\s+(\w+)\s*=([^]*)$)");
  const std::string code = code_of(text);
  std::vector<Definition> found;
  std::vector<bool> is_namespace;  // the braces that are open
  std::size_t begin = 0;
  for (std::size_t at = 0; (at = code.find_first_of("{};", at)) != std::string::npos; begin = ++at) {
    const std::string before = code.substr(begin, at - begin);
    const bool inside = std::find(is_namespace.begin(), is_namespace.end(), false) != is_namespace.end();
    const auto says = [&](const char* word) { return before.find(word) != std::string::npos; };
    std::smatch m;
    if (code[at] == ';' && !inside && says("using") && std::regex_search(before, m, alias)) {
      std::string meant = m[2];
      std::erase_if(meant, [](unsigned char c) { return std::isspace(c) != 0; });
      found.push_back({m[1], meant, file});
    } else if (code[at] == '{') {
      if (!inside && (says("struct") || says("class") || says("union") || says("enum")) &&
          std::regex_search(before, m, type))
        found.push_back({m[1], "", file});
      is_namespace.push_back(says("namespace"));
    } else if (code[at] == '}') {
      if (is_namespace.empty()) found.push_back({"}", "", file});
      else is_namespace.pop_back();
    }
  }
  if (!is_namespace.empty()) found.push_back({"}", "", file});
  return found;
}

// The baseline whose folder holds the file; "" if it is in none.
std::string baseline_of(const std::string& file) {
  std::smatch m;
  static const std::regex in_baselines(R"(^baselines/(\w+)/.*)");
  return std::regex_match(file, m, in_baselines) && m[1] != "common" ? m[1].str() : "";
}

// The paper's algorithms and caravan share nothing with others but core/: their names are theirs. "" for the rest.
std::string room_of_its_own(const std::string& file) {
  std::smatch m;
  static const std::regex own(R"(^controller/(?:include/banyan/controller|src)/(paper|caravan)/.*)");
  return std::regex_match(file, m, own) ? m[1].str() : "";
}
bool is_in_core(const std::string& file) {
  static const std::regex in_core(R"(^controller/(include/banyan/controller|src)/core/.*)");
  return std::regex_match(file, in_core);
}
bool is_of_an_algorithm(const std::string& file) {
  return (file.starts_with("baselines/") || file.starts_with("controller/")) && !is_in_core(file);
}

bool are_one(const Definition& a, const Definition& b) {
  const auto differ = [&](std::string (*place)(const std::string&)) { return place(a.file) != place(b.file); };
  const bool of_two_baselines = !baseline_of(a.file).empty() && !baseline_of(b.file).empty() && differ(baseline_of);
  const bool of_two_rooms = is_of_an_algorithm(a.file) && is_of_an_algorithm(b.file) && differ(room_of_its_own);
  return of_two_baselines || of_two_rooms || (!a.alias.empty() && a.alias == b.alias);
}

std::string twice(const std::map<std::string, std::string>& files) {
  std::map<std::string, std::vector<Definition>> known;
  std::string faults;
  for (const auto& [file, text] : files)
    for (const Definition& d : definitions(text, file)) {
      if (d.name == "}") faults += file + ": braces do not match\n";
      for (const Definition& other : known[d.name])
        if (!are_one(d, other) && !allowed.contains(d.name) && d.name != "}")
          faults += d.name + ": " + other.file + " and " + file + "\n";
      known[d.name].push_back(d);
    }
  return faults;
}

TEST(TypeNames, EachMeansOneThing) {
  const fs::path house = BANYAN_SOURCE_DIR;
  std::map<std::string, std::string> files;
  for (const std::string_view room : rooms)
    for (const fs::path& path : sources(house / room)) {
      const fs::path file = path.lexically_relative(house);
      const auto is_in = [&](std::string_view folder) {
        return std::find(file.begin(), file.end(), folder) != file.end();
      };
      if (is_in("test") || is_in("fuzz")) continue;
      std::ifstream in(path);
      files[file.string()] = {std::istreambuf_iterator<char>(in), {}};
    }
  ASSERT_GT(files.size(), 300U);
  EXPECT_EQ(twice(files), "");
}

// What the test would be worth nothing without.
TEST(TypeNames, EveryWayToDefineATypeIsSeen) {
  const std::string first = "namespace a::b {\nstruct X {};\n}";
  for (const char* second :
       {"class X final : public Y<int> {\n int y;\n};", "enum class X : unsigned char { one };",
        "#include <a>\nusing X = int;", "namespace { union alignas(8) X { int y; }; }",
        "template <class T> struct alignas(2 * sizeof(T)) X { T y; };", "using X = int;", "enum X { two };",
        "void f() { if (1) { } }\n// }\nconst char* s = \"{\"; char c = '{'; int n = 1'000;\nclass X\n{ };"})
    EXPECT_EQ(twice({{"world/a.hpp", first}, {"world/b.cpp", second}}), "X: world/a.hpp and world/b.cpp\n") << second;
}

TEST(TypeNames, WhatIsNoSecondTypeIsNot) {
  const std::string first = "namespace a {\nstruct X {};\n}";
  for (const char* second :
       {"struct X;", "class Y { struct X {}; };", "void f() { struct X {}; }", "// struct X {};",
        "template <class X> void f(X x) {}", "template <> struct X<int> {};", "void f(struct X& x) {}"})
    EXPECT_EQ(twice({{"world/a.hpp", first}, {"world/b.cpp", second}}), "") << second;
  EXPECT_EQ(twice({{"cli/a.cpp", "using J = json;"}, {"cli/b.cpp", "using J =\n  json;"}}), "");
  EXPECT_NE(twice({{"cli/a.cpp", "using J = json;"}, {"cli/b.cpp", "using J = text;"}}), "");
}

TEST(TypeNames, BaselinesAreComparedWithTheRoomsAlone) {
  const std::string x = "struct X {};";
  EXPECT_EQ(twice({{"baselines/one/src/a.cpp", x}, {"baselines/two/src/a.cpp", x}}), "");
  EXPECT_NE(twice({{"baselines/one/src/a.cpp", x}, {"baselines/one/src/b.cpp", x}}), "");
  EXPECT_EQ(twice({{"controller/src/paper/a.cpp", x}, {"controller/src/tree/a.cpp", x}}), "");
  EXPECT_EQ(twice({{"controller/src/paper/a.cpp", x}, {"controller/src/caravan/a.cpp", x}}), "");
  EXPECT_NE(twice({{"controller/src/caravan/a.cpp", x}, {"controller/src/caravan/b.cpp", x}}), "");
  EXPECT_EQ(twice({{"controller/src/paper/a.cpp", x}, {"baselines/two/src/a.cpp", x}}), "");
  EXPECT_NE(twice({{"controller/src/paper/a.cpp", x}, {"controller/src/core/a.cpp", x}}), "");
  EXPECT_NE(twice({{"controller/src/paper/a.cpp", x}, {"record/src/a.cpp", x}}), "");
  EXPECT_NE(twice({{"baselines/common/src/a.cpp", x}, {"baselines/two/src/a.cpp", x}}), "");
  EXPECT_NE(twice({{"record/src/a.cpp", x}, {"baselines/two/src/a.cpp", x}}), "");
}

TEST(TypeNames, ATextThatIsNotUnderstoodIsAFault) {
  EXPECT_NE(twice({{"cli/a.cpp", "#if A\nvoid f() {\n#else\nvoid g() {\n#endif\n}"}}), "");
  EXPECT_NE(twice({{"cli/a.cpp", "}"}}), "");
}

}  // namespace
