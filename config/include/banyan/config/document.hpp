// SPDX-License-Identifier: MIT
// A configuration file as a tree of plain values, each knowing where it was written. TOML and JSON
// and `--set key=value` (override.hpp) all become this one tree, so that everything after it (keys,
// ranges, messages) exists once. Knows nothing about scenarios.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "banyan/world/decimal.hpp"
#include "banyan/world/names.hpp"

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
// "worlds/a.toml:12: error: radio.loss: ...", in one line and printable, whatever names and values are in it.
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

// Of at most so many bytes; throws DocumentError that says what is wrong.
[[nodiscard]] std::string read_file(const std::string& path, std::size_t most);
// A regular file or a pipe ("-": standard input), at most 8 MiB; throws DocumentError that says
// what is wrong: missing, a directory, not permitted, empty, binary.
[[nodiscard]] std::string read_text_file(const std::string& path);

inline constexpr std::size_t deepest_nesting = 16;  // the scenario's tree needs five

// JSON if the name ends in .json or the text starts with '{', else TOML. The result is a table.
[[nodiscard]] Node parse_document(const std::string& path, std::string_view text);

// A value as TOML, or else the bare text, so that quotes may be left out on a command line.
[[nodiscard]] Node parse_value(std::string_view text, const std::shared_ptr<const std::string>& origin);

// For messages (world/decimal.hpp).
using world::number_text;
using world::widened;

// Names become parts of paths: of scenarios, studies, tunings (world/names.hpp).
using world::good_name;
using world::name_rule;
// The file's name without its ending, made good; `fallback` if nothing is left of it.
[[nodiscard]] std::string name_from(const std::string& path, std::string_view fallback);

// The candidate nearest to `word`, or nothing when none is near enough to be meant.
[[nodiscard]] inline std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  return world::nearest_name(word, candidates);
}

}  // namespace banyan::config
