// SPDX-License-Identifier: MIT
// What docs/protocol.md and the pages beside it say of the controller in numbers and names is what the code
// has. Constants that a source file keeps to itself are read from its text. The tables of the message are
// compared with its list of fields in record/test/message_json_test.cpp, its length in documents_test.cpp.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <ostream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/convoy/shortcut.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/platform_parameters.hpp"
#include "banyan/controller/healing/healing.hpp"
#include "banyan/controller/inwards.hpp"
#include "banyan/controller/outwards.hpp"

namespace {

namespace fs = std::filesystem;
using Numbers = std::map<std::string, double, std::less<>>;

const fs::path source = BANYAN_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(source / file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

// From the line that begins with `begin` up to the next heading of its kind, or the end.
std::string section(const std::string& text, const std::string& begin) {
  const std::size_t at = text.find("\n" + begin);
  EXPECT_NE(at, std::string::npos) << begin;
  if (at == std::string::npos) return "";
  const std::string mark = "\n" + begin.substr(0, begin.find(' ') + 1);
  return text.substr(at, text.find(mark, at + 1) - at);
}

// All that `form` finds, by its first group.
std::vector<std::string> all(const std::string& text, const std::string& form) {
  const std::regex regex(form);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

template <class Params, class Rows> void collect(Numbers& numbers, const Params& params, const Rows& rows) {
  for (const auto& row : rows) numbers[std::string(row.key)] = static_cast<double>(params.*row.member);
}

Numbers defaults_of(const banyan::HealingParams& params) {
  Numbers numbers;
  collect(numbers, params, banyan::tree_parameters());
  collect(numbers, params, banyan::healing_parameters());
  collect(numbers, params, banyan::platform_parameters<banyan::HealingParams>);
  return numbers;
}

// ---- Constants ----

// Of a source file: the value of `constexpr <type> name = value`.
double constant_of(const fs::path& file, const std::string& name) {
  const auto found = all(text_of(file), "constexpr [\\w: ]+ " + name + " = ([0-9.e+-]+)F?;");
  EXPECT_EQ(found.size(), 1U) << file << ": " << name;
  return found.size() == 1 ? std::stod(found[0]) : -1.0;
}

struct Claim {
  std::string page;  // in docs/
  std::string form;  // with one group around the number
  std::string file;  // under controller/src/
  std::string constant;
  double factor = 1.0;  // from the code's unit to the page's
};
void PrintTo(const Claim& claim, std::ostream* out) { *out << claim.page << ' ' << claim.constant; }

// A page may say a number in several places; it must say it in one at least.
class Constants : public testing::TestWithParam<Claim> {};

TEST_P(Constants, AreWhatTheDocumentsSay) {
  const Claim& claim = GetParam();
  const auto found = all(text_of("docs/" + claim.page), claim.form);
  ASSERT_FALSE(found.empty()) << claim.page << " does not say \"" << claim.form << "\"";
  for (const std::string& number : found)
    EXPECT_NEAR(std::stod(number), constant_of("controller/src/" + claim.file, claim.constant) * claim.factor, 1e-6)
        << claim.page << ": \"" << claim.form << "\", " << claim.file << ": " << claim.constant;
}

INSTANTIATE_TEST_SUITE_P(
    Tree, Constants,
    testing::Values(
        Claim{"protocol.md", R"(has been done for (\d+) ticks)", "tree/epoch.cpp", "settle_ticks"},
        Claim{"protocol.md", R"(at least (\d+) ticks have passed)", "tree/epoch.cpp", "settle_ticks"},
        Claim{"protocol.md", R"((\d+) ticks after first hearing a labelled)", "tree/label.cpp", "wait_ticks"},
        Claim{"protocol.md", R"(\((\d+) while all of these are beyond)", "tree/label.cpp", "wait_far_ticks"},
        Claim{"protocol.md", R"(heard within the last (\d+) ticks has this epoch)", "tree/label.cpp",
              "echo_silence_ticks"},
        Claim{"protocol.md", R"(Without any candidate for more than (\d+) ticks)", "tree/parent_selection.cpp",
              "patience_flood_ticks"},
        Claim{"protocol.md", R"(After more than (\d+) ticks, a robot without)", "tree/parent_selection.cpp",
              "patience_relabel_ticks"},
        Claim{"protocol.md", R"(is within ([\d.]+) C, the last resort)", "../include/banyan/controller/tree/robot.hpp",
              "longest_link"},
        Claim{"protocol.md", R"(- more than (\d+): it stands still)", "tree/parent_selection.cpp",
              "orphan_still_ticks"},
        Claim{"protocol.md", R"(- more than (\d+), or more than)", "tree/parent_selection.cpp", "orphan_attach_ticks"},
        Claim{"protocol.md", R"(, or more than (\d+) if it has no parent)", "tree/parent_selection.cpp",
              "drafted_attach_ticks"},
        Claim{"protocol.md", R"(of its living neighbours, up to (\d+), then 255)", "tree/spare_management.cpp",
              "call_reach_hops"}));

INSTANTIATE_TEST_SUITE_P(
    Obstacles, Constants,
    testing::Values(
        Claim{"protocol.md", R"(along them they keep (\d+) cm off)", "obstacles/bypass.cpp", "keep_m", 100.0},
        Claim{"protocol.md", R"(\(d − body − (\d+) cm\))", "obstacles/bypass.cpp", "keep_m", 50.0},
        Claim{"protocol.md", R"(the goal is (\d+) cm nearer)", "obstacles/bypass.cpp", "progress_m", 100.0},
        Claim{"protocol.md", R"(the goal moves by more than ([\d.]+) m)", "obstacles/bypass.cpp", "goal_moved_m"},
        Claim{"protocol.md", R"(Farther than ([\d.]+) C from where the detour began)", "obstacles/bypass.cpp",
              "first_span"},
        Claim{"protocol.md", R"(nearer than (\d+) cm to an edge by its own motion)", "obstacles/corners.cpp",
              "sight_margin_m", 100.0},
        Claim{"protocol.md", R"(connectors move away from points nearer than (\d+) cm)", "obstacles/corners.cpp",
              "sight_width_m", 100.0},
        Claim{"protocol.md", R"(the nearest one within ([\d.]+) m \(`hinge`\))", "obstacles/corners.cpp",
              "hinge_width_m"},
        Claim{"protocol.md", R"(whose edge to the parent is longer than ([\d.]+) m)", "obstacles/corners.cpp",
              "pin_shortest_m"},
        Claim{"protocol.md", R"(passes a point at less than (\d+) cm)", "obstacles/corners.cpp", "pin_width_m", 100.0},
        Claim{"protocol.md", R"(tree hops have counted up beyond (\d+))", "convoy/towing.cpp", "lost_hops"},
        Claim{"protocol.md", R"(has not heard its parent for (\d+) ticks backs up)", "convoy/towing.cpp",
              "silent_ticks"}));

INSTANTIATE_TEST_SUITE_P(
    Healing, Constants,
    testing::Values(
        Claim{"protocol.md", R"(drives to within ([\d.]+) C of where the child was)", "healing/dangling_branch.cpp",
              "near_enough"},
        Claim{"protocol.md", R"(Its count starts (\d+) ahead)", "healing/takeover.cpp", "takeover_beats"},
        Claim{"protocol.md", R"(a count more than (\d+) behind)", "healing/takeover.cpp", "rival_beats"},
        Claim{"protocol.md", R"(passed on in the same way for (\d+) s)", "healing/takeover.cpp", "pass_on_ticks", 0.1},
        Claim{"protocol.md", R"(from elsewhere either for ([\d.]+) s beyond I)", "healing/doubt.cpp", "hesitate_s"},
        Claim{"protocol.md", R"(robot that heard it within ([\d.]+) C)", "healing/doubt.cpp", "well_in_range"},
        Claim{"protocol.md", R"(a random walk of q = (\d+) times)", "core/position_filter.cpp", "wander"},
        Claim{"protocol.md", R"(root mean square, less ([\d.]+) times)", "core/position_filter.cpp", "explained"},
        Claim{"protocol.md", R"(an edge asks for a spare (\d+) spreads sooner)", "convoy/convoy.cpp", "asks_sooner"},
        Claim{"protocol.md", R"(a child tows (\d+) spreads sooner)", "convoy/towing.cpp", "tows_sooner"},
        Claim{"protocol.md", R"(a connector is released (\d+) spreads later)", "convoy/shortcut.cpp", "releases_later"},
        Claim{"protocol.md", R"(found no parent for (\d+) ticks drives)", "healing/retreat.cpp", "lost_ticks"},
        Claim{"protocol.md", R"(drives to within ([\d.]+) C of where the root was)", "healing/retreat.cpp",
              "near_enough"},
        Claim{"protocol.md", R"(drives home for at most (\d+) s)", "healing/retreat.cpp", "regroup_for_s"}));

INSTANTIATE_TEST_SUITE_P(
    Convoy, Constants,
    testing::Values(
        Claim{"protocol.md", R"(Within (\d+) hops of an edge that waits in vain)", "convoy/towing.cpp",
              "slack_reach_hops"},
        Claim{"protocol.md", R"(than ([\d.]+) of the tolerance neither)", "convoy/towing.cpp", "as_good_as_there"},
        Claim{"convoy.md", R"(if it stands in the way itself, ([\d.]+) `clearance`)", "convoy/convoy.cpp", "tight"},
        Claim{"convoy.md", R"(with a robot within ([\d.]+) `clearance`)", "convoy/link_repair.cpp", "danger"},
        Claim{"convoy.md", R"(below ([\d.]+) `clearance`)", "convoy/link_repair.cpp", "urgency"},
        Claim{"convoy.md", R"(beyond ([\d.]+) C from a robot of the tree)", "convoy/towing.cpp", "follow_tree"},
        Claim{"convoy.md", R"(([\d.]+) C from a spare that leads)", "convoy/towing.cpp", "follow_spare"},
        Claim{"convoy.md", R"(from ([\d.]+) C and [\d.]+ C on)", "convoy/towing.cpp", "called_follow_tree"},
        Claim{"convoy.md", R"(from [\d.]+ C and ([\d.]+) C on)", "convoy/towing.cpp", "called_follow_spare"},
        Claim{"convoy.md", R"(at most every (\d+) s a robot)", "convoy/pruning.cpp", "merge_period_s"},
        Claim{"convoy.md", R"(every (\d+) s, for at most)", "convoy/plan.cpp", "plan_period_s"},
        Claim{"convoy.md", R"(, for at most (\d+) s, one more level)", "convoy/plan.cpp", "plan_limit_s"},
        Claim{"convoy.md", R"(made no progress for (\d+) s asks for a spare)", "convoy/plan.cpp",
              "held_back_after_s"}));

// Every number in the controller's rooms that is no parameter stands, with its reason, in docs/algorithms.md; and
// that page names no other.
TEST(ProtocolDocument, NumbersThatAreNoParametersAreGivenAReason) {
  std::set<std::string> in_code;
  for (const char* folder : {"controller/src", "controller/include"})
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      // The headers of the core hold sizes and limits of the seam, which nobody tunes.
      if (!entry.is_regular_file() ||
          entry.path().parent_path() == source / "controller/include/banyan/controller/core")
        continue;
      for (const std::string& name :
           all(text_of(entry.path()), R"(constexpr (?:float|int|std::uint(?:8|16)_t) (\w+) = (?:0\.|[1-9.]))"))
        in_code.insert(name);
    }
  std::set<std::string> in_document;
  for (const std::string& name :
       all(section(text_of("docs/algorithms.md"), "## Numbers that are no parameters"), R"(`(\w+)`)"))
    in_document.insert(name);
  EXPECT_EQ(in_document, in_code);
  EXPECT_GT(in_code.size(), 40U);
}

// Those that a header shows.
TEST(ProtocolDocument, SaysWhatHeadersSay) {
  const std::string protocol = text_of("docs/protocol.md");
  const std::string limits = text_of("docs/limits.md");
  const std::string convoy = text_of("docs/convoy.md");
  const auto expect = [](const std::string& text, const std::string& form, double value) {
    const auto found = all(text, form);
    EXPECT_FALSE(found.empty()) << form;
    for (const std::string& number : found) EXPECT_NEAR(std::stod(number), value, 1e-6) << form;
  };
  expect(protocol, R"(The table holds (\d+);)", banyan::neighbor_capacity);
  expect(limits, R"(A robot knows at most (\d+) neighbours)", banyan::neighbor_capacity);
  expect(protocol, R"(At most (\d+) targets are known)", banyan::task_capacity);
  expect(protocol, R"(heard in the last (\d+) s; old news)", 0.1 * banyan::outdated_ticks);
  expect(limits, R"(A robot remembers (\d+) targets)", banyan::task_capacity);
  expect(protocol, R"(remembers up to (\d+) points)", banyan::landmark_capacity);
  expect(limits, R"(in each step, and remembers (\d+))", banyan::landmark_capacity);
  expect(protocol, R"(Of obstacle points the first (\d+))", static_cast<double>(banyan::most_obstacles));
  expect(limits, R"(looks at the first (\d+) in each step)", static_cast<double>(banyan::most_obstacles));
  expect(protocol, R"(measured farther away than (\d+) C)", static_cast<double>(banyan::farthest_ranges));
  expect(protocol, R"(A target farther than (\d+) km)", static_cast<double>(banyan::farthest_target_m) / 1000.0);
  expect(protocol, R"(turns by more than (\d+) rad)", static_cast<double>(banyan::largest_turn_rad));
  expect(protocol, R"(all points within ([\d.]+) m of the body)", static_cast<double>(banyan::near_m));
  expect(protocol, R"(\*\*Message\*\*, version (\d+))", banyan::wire_version);
  expect(convoy, R"(rest for at most (\d+) ticks)", banyan::pending_limit_ticks);
}

// ---- Parameters ----

// `parameter` (3 s), `parameter` (2 cm): the paper's algorithms have that default.
TEST(ProtocolDocument, DefaultsInBracketsAreThoseOfOutwards) {
  const Numbers numbers = defaults_of(banyan::outwards_defaults());
  const std::string text = text_of("docs/protocol.md");
  const std::regex form(R"(`(\w+)` \((\d+(?:\.\d+)?) (s|cm|m)\b)");
  std::size_t found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), form), end; it != end; ++it, ++found) {
    const std::string key = (*it)[1];
    const auto known = numbers.find(key);
    ASSERT_NE(known, numbers.end()) << key;
    EXPECT_NEAR(std::stod((*it)[2]) * ((*it)[3] == "cm" ? 0.01 : 1.0), known->second, 1e-6) << key;
  }
  EXPECT_GE(found, 5U);
}

TEST(ProtocolDocument, SymbolsHaveTheirDefaults) {
  const Numbers outwards = defaults_of(banyan::outwards_defaults());
  const Numbers inwards = defaults_of(banyan::inwards_defaults());
  const std::string text = section(text_of("docs/algorithms.md"), "## Symbols");
  const std::regex form(R"(\| `(\w+)`[^|]*\|[^|]*\| ([\d.]+) \| ([\d.]+) \|)");
  std::size_t found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), form), end; it != end; ++it, ++found) {
    const std::string key = (*it)[1];
    ASSERT_TRUE(outwards.contains(key)) << key;
    EXPECT_NEAR(std::stod((*it)[2]), outwards.at(key), 1e-6) << key;
    EXPECT_NEAR(std::stod((*it)[3]), inwards.at(key), 1e-6) << key;
  }
  EXPECT_EQ(found, 11U);
}

// Lengths of convoy that its page gives in units of C.
TEST(ProtocolDocument, ConvoysLengthsAreThoseOfItsDefaults) {
  const banyan::ConvoyParams p = banyan::convoy_defaults();
  const std::string text = text_of("docs/convoy.md");
  const auto expect = [&](const std::string& form, float value) {
    const auto found = all(text, form);
    ASSERT_EQ(found.size(), 1U) << form;
    EXPECT_NEAR(std::stod(found[0]), static_cast<double>(value), 1e-6) << form;
  };
  expect(R"(No edge outgrows G = ([\d.]+) C)", p.ideal_distance_m / p.communication_range_m);
  expect(R"(the root and junctions only from ([\d.]+) C on)", p.safe_range_m / p.communication_range_m);
  expect(R"(Need: the edge to the parent is longer than ([\d.]+) C)",
         p.recruitment_distance_m / p.communication_range_m);
  expect(R"(Repulsion only nearer than ([\d.]+) C)", p.avoidance_range_m / p.communication_range_m);
  expect(R"(from spares ([\d.]+) C)", p.spare_avoidance_m / p.communication_range_m);
  expect(R"(`plan_after_s` \((\d+) s\))", p.plan_after_s);
}

// ---- Names ----

// docs/algorithms.md has a row for each choice in reading the paper, and none for others.
TEST(ProtocolDocument, EveryChoiceOfTheReadingHasItsRow) {
  const auto fields = all(text_of("controller/include/banyan/controller/tree/reading.hpp"), R"(\n  bool (\w+);)");
  const auto rows = all(section(text_of("docs/algorithms.md"), "## literal against corrected"), R"(\n\| `(\w+)` \|)");
  EXPECT_GE(fields.size(), 7U);
  EXPECT_EQ(std::multiset<std::string>(fields.begin(), fields.end()),
            std::multiset<std::string>(rows.begin(), rows.end()));
}

// What a function calls, by the text of its definition.
std::set<std::string> calls_in(const std::string& code, const std::string& function) {
  const std::size_t begin = code.find(" " + function + "(");
  EXPECT_NE(begin, std::string::npos) << function;
  const auto calls = all(code.substr(begin, code.find("\n}\n", begin) - begin), R"([^\w.](\w+)\()");
  return {calls.begin(), calls.end()};
}

// docs/algorithms.md has a row for each source of healing and obstacles that the corrected step calls and the literal
// one does not; for what begins and ends a tick, each that is called there.
TEST(ProtocolDocument, EverySourceThatOnlyTheCorrectedStepCallsHasItsRow) {
  const std::string steps = text_of("controller/src/paper.cpp");
  const fs::path frame = source / "controller/src/healing/tick.cpp";
  std::set<std::string> calls = calls_in(steps, "corrected_step");
  for (const char* function : {"begin_tick", "write_healing"}) calls.merge(calls_in(text_of(frame), function));
  for (const std::string& call : calls_in(steps, "literal_step")) calls.erase(call);
  std::set<std::string> called;
  for (const char* room : {"controller/src/healing", "controller/src/obstacles"})
    for (const auto& entry : fs::directory_iterator(source / room))
      for (const std::string& name : all(text_of(entry.path()), R"(\n\w[\w ]* (\w+)\([^;{]*\{)"))
        if (calls.contains(name) && entry.path() != frame)
          called.insert(entry.path().lexically_relative(source).generic_string());
  EXPECT_GE(called.size(), 12U);
  const auto rows =
      all(section(text_of("docs/algorithms.md"), "## literal against corrected"), R"(`(controller/src/[^`]*)`)");
  const std::set<std::string> listed(rows.begin(), rows.end());
  for (const std::string& file : called) EXPECT_TRUE(listed.contains(file)) << file << " has no row";
  for (const std::string& file : listed) EXPECT_TRUE(fs::exists(source / file)) << file;
}

// docs/architecture.md names the calls of convoy_step in their order.
TEST(ProtocolDocument, ATickIsWhatArchitectureSays) {
  const std::string code = text_of("controller/src/convoy/convoy.cpp");
  const std::size_t begin = code.find("Velocity tick(");
  ASSERT_NE(begin, std::string::npos);
  const std::string body = code.substr(begin, code.find("\n}\n", begin) - begin);
  const auto calls = all(body, R"(\n  (?:[\w.: ]+ = )?(\w+)\(robot[,)])");
  EXPECT_GE(calls.size(), 20U);
  const std::string page = section(text_of("docs/architecture.md"), "## One tick");
  std::size_t last = 0;
  for (const std::string& call : calls) {
    const std::size_t at = page.find("`" + call + "`");
    ASSERT_NE(at, std::string::npos) << call;
    EXPECT_GT(at, last) << call << " stands too early";
    last = at;
  }
}

// "protocol 5" in a comment or a table of parameters is a section that there is.
TEST(ProtocolDocument, SectionsThatTheCodeCitesExist) {
  const auto numbers = all(text_of("docs/protocol.md"), R"(\n## (\d+)\. )");
  const std::set<std::string> sections(numbers.begin(), numbers.end());
  const auto letters = all(section(text_of("docs/algorithms.md"), "## Departures"), R"(\n\| (\d+) \|)");
  const std::set<std::string> rows(letters.begin(), letters.end());
  std::size_t found = 0;
  for (const char* room : {"controller", "world", "algorithms"})
    for (const auto& entry : fs::recursive_directory_iterator(source / room)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      const std::string text = text_of(entry.path());
      for (const std::string& cited : all(text, R"(\bprotocol (\d+))")) {
        ++found;
        EXPECT_TRUE(sections.contains(cited)) << entry.path() << ": protocol " << cited;
      }
      for (const std::string& cited : all(text, R"(protocol 2, row (\d+))"))
        EXPECT_TRUE(rows.contains(cited)) << entry.path() << ": row " << cited;
    }
  EXPECT_GE(found, 30U);
}

// The last column of the glossary's tables: words of headers and sources.
TEST(ProtocolDocument, TheGlossaryNamesWhatThereIs) {
  std::set<std::string> words;
  for (const char* room : {"controller", "world", "record", "algorithms", "hosts"})
    for (const auto& entry : fs::recursive_directory_iterator(source / room)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      const auto found = all(text_of(entry.path()), R"((\w+))");
      words.insert(found.begin(), found.end());
    }
  std::size_t names = 0;
  for (const std::string& cell : all(text_of("docs/glossary.md"), R"(\n\| \*\*[^\n]*\| ([^|\n]*)\|)"))
    for (const std::string& name : all(cell, R"(`(?:\w+::)?(\w+)`)")) {
      ++names;
      EXPECT_TRUE(words.contains(name)) << name;
    }
  EXPECT_GE(names, 60U);
}

// "*Silent ties* (`": a rule of section 12 that has a name of its own is in the glossary, in the singular.
TEST(ProtocolDocument, TheGlossaryHasTheNamesOfTheRulesOfHealing) {
  std::string terms;
  for (const std::string& names : all(text_of("docs/glossary.md"), R"(\n\| \*\*([^*\n]+)\*\*)")) terms += ", " + names;
  terms += ",";
  const auto rules = all(section(text_of("docs/protocol.md"), "## 12."), R"(\n\*([A-Z][^*\n]*)\* \(`)");
  for (std::string rule : rules) {
    rule[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(rule[0])));
    if (rule.ends_with('s')) rule.pop_back();
    EXPECT_NE(terms.find(", " + rule + ","), std::string::npos) << rule;
  }
  EXPECT_GE(rules.size(), 5U);
}

}  // namespace
