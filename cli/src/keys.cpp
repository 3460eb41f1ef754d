// SPDX-License-Identifier: MIT
// `banyan keys` and the hidden `banyan complete-keys`.
#include <nlohmann/json.hpp>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/table.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

struct KeysOptions {
  std::string prefix;
  bool json = false;
  bool markdown = false;
  bool columns = false;
};

nlohmann::ordered_json json_of(const std::vector<KeyRow>& rows) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& row : rows) {
    list.push_back({{"key", row.path},
                    {"type", row.type},
                    {"allowed", row.allowed},
                    {"default", row.fallback},
                    {"only_with", row.when},
                    {"meaning", row.meaning}});
  }
  return list;
}

int keys_command(const KeysOptions& options) {
  if (options.columns) {
    print(record::columns_markdown());
    return exit_done;
  }
  if (options.markdown) {
    print(key_reference_markdown(algorithms()));
    return exit_done;
  }
  std::vector<KeyRow> rows;
  std::vector<std::string_view> known;
  const auto all = key_rows(algorithms());
  for (const auto& row : all) {
    if (row.path.starts_with(options.prefix)) rows.push_back(row);
    known.push_back(row.path);
  }
  if (rows.empty()) {
    const auto near = nearest(options.prefix, known);
    throw CommandError(exit_usage, "no key begins with \"" + options.prefix + "\"" +
                                       (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
  }
  if (options.json) {
    print(json_of(rows).dump(2) + "\n");
    return exit_done;
  }
  std::string text;
  for (const auto& row : rows) {
    text += row.path + " = " + row.type + (row.allowed.empty() ? "" : " (" + row.allowed + ")") +
            (row.fallback.empty()         ? ""
             : row.fallback == "required" ? ", required"
                                          : ", default " + row.fallback) +
            "\n    " + row.meaning + (row.when.empty() ? "" : "; only with " + row.when) + "\n";
  }
  print(text);
  return exit_done;
}

// What may follow `word` after --set, one candidate per line.
int complete_keys_command(const std::string& word) {
  std::string text;
  const auto equals = word.find('=');
  for (const auto& row : key_rows(algorithms())) {
    if (row.path.starts_with("obstacles.") || row.path.starts_with("events.")) continue;  // need an index
    if (equals == std::string::npos) {
      if (row.path.starts_with(word)) text += row.path + "=\n";
    } else if (row.path == word.substr(0, equals)) {
      for (const auto& choice : row.choices) {
        if (choice.starts_with(word.substr(equals + 1))) text += row.path + "=" + choice + "\n";
      }
    }
  }
  print(text);
  return exit_done;
}

}  // namespace

void add_keys(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<KeysOptions>();
  command.footer(
      "Examples:\n  banyan keys\n  banyan keys radio.\n  banyan keys --markdown > docs/scenario-keys.md\n"
      "  banyan keys --columns > docs/columns.md");
  command.add_option("prefix", options->prefix, "only keys that begin with this")->type_name("PREFIX");
  command.add_flag("--json", options->json, "as JSON");
  command.add_flag("--markdown", options->markdown, "as the page docs/scenario-keys.md");
  command.add_flag("--columns", options->columns, "the columns of results instead, as the page docs/columns.md");
  command.callback([options, &action] { action = [options] { return keys_command(*options); }; });
}

void add_complete_keys(CLI::App& command, CommandAction& action) {
  auto word = std::make_shared<std::string>();
  command.add_option("word", *word);
  command.callback([word, &action] { action = [word] { return complete_keys_command(*word); }; });
}

}  // namespace banyan::cli
