// SPDX-License-Identifier: MIT
// A configuration file as a tree of plain values, each knowing where it was written. TOML and JSON
// and `--set key=value` all become this one tree, so that everything after it (keys, ranges,
// messages) exists once. Knows nothing about scenarios.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace banyan::config {

// Where something was written: a file and a line, or a command line option (line 0).
struct Place {
  std::shared_ptr<const std::string> origin;
  int line = 0;
  [[nodiscard]] std::string text() const;  // "worlds/a.toml:12", "--set radio.loss=2"
  [[nodiscard]] bool from_file() const noexcept { return line > 0; }
};

// Something wrong or doubtful in a user's input. `key` may be empty.
struct Problem {
  Place place;
  std::string key;
  std::string text;
  bool warning = false;
};
// "worlds/a.toml:12: error: radio.loss: ..."
[[nodiscard]] std::string to_string(const Problem& problem);

struct Node {
  struct Other {};  // a TOML date or time: no key takes one
  struct Member;    // a key and its value
  using Array = std::vector<Node>;
  using Table = std::vector<Member>;  // in file order
  std::variant<Other, bool, std::int64_t, double, std::string, Array, Table> value;
  Place place;

  [[nodiscard]] const Table* table() const noexcept { return std::get_if<Table>(&value); }
  [[nodiscard]] Table* table() noexcept { return std::get_if<Table>(&value); }
  [[nodiscard]] const Array* array() const noexcept { return std::get_if<Array>(&value); }
  [[nodiscard]] Array* array() noexcept { return std::get_if<Array>(&value); }
  [[nodiscard]] const std::string* string() const noexcept { return std::get_if<std::string>(&value); }
  // The member of a table; null if there is none or this is no table.
  [[nodiscard]] const Node* find(std::string_view name) const noexcept;
  [[nodiscard]] Node* find(std::string_view name) noexcept;
  // "the text \"fast\"", "the number 3", "a table": for messages.
  [[nodiscard]] std::string describe() const;
};
struct Node::Member {
  std::string name;
  Node value;
};

// The file cannot be read at all, or its syntax is broken.
class DocumentError : public std::runtime_error {
 public:
  explicit DocumentError(Problem p) : std::runtime_error(to_string(p)), problem(std::move(p)) {}
  Problem problem;
};

// A regular file or a pipe ("-": standard input), at most 64 MiB; throws DocumentError that says
// what is wrong: missing, a directory, not permitted, empty, binary.
[[nodiscard]] std::string read_text_file(const std::string& path);

// JSON if the name ends in .json or the text starts with '{', else TOML. The result is a table.
[[nodiscard]] Node parse_document(const std::string& path, std::string_view text);

// Puts `value` where `key`, a dotted path, says: "radio.loss", "events[0].time_s". Sections that are
// missing are made. Returns what is wrong with the key, if anything.
[[nodiscard]] std::vector<Problem> assign(Node& root, std::string_view key, Node value);

// The same tree as if it came from an option: where a file's keys contradict it, it wins silently.
// Its places still name the file and line.
[[nodiscard]] Node as_option(Node node);

// Lays `changes` over `root`: tables are merged key by key, anything else is replaced.
void overlay(Node& root, Node changes);

// assign() of "key=value": the value as in TOML, or else taken as bare text. `origin` is how
// messages name it.
[[nodiscard]] std::vector<Problem> apply_override(Node& root, std::string_view assignment, const std::string& origin);

// For messages: the shortest decimal text of a number; "1" rather than "1.0", "10000000" for 1e7.
[[nodiscard]] std::string number_text(double value);
// 1.9F as the double 1.9.
[[nodiscard]] double widened(float value);

// Names become parts of paths: of scenarios, studies, tunings.
inline constexpr std::string_view name_rule = "1 to 100 letters, digits, '-', '_' and '.', no '.' at the start";
[[nodiscard]] bool good_name(std::string_view name);
// The file's name without its ending, made good; `fallback` if nothing is left of it.
[[nodiscard]] std::string name_from(const std::string& path, std::string_view fallback);

// The candidate nearest to `word`, or nothing when none is near enough to be meant.
[[nodiscard]] std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace banyan::config
