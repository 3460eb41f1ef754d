// SPDX-License-Identifier: MIT
#include "base.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace banyan::study {
namespace {

using config::Node;

void drop(Node& table, std::string_view name) {
  std::erase_if(*table.table(), [&](const Node::Member& member) { return member.name == name; });
}

void lay_over(Node& below, Node above) {
  if (!below.table() || !above.table()) {
    below = std::move(above);
    return;
  }
  below.place = above.place;
  for (auto& [name, value] : *above.table()) {
    if (Node* known = below.find(name)) lay_over(*known, std::move(value));
    else below.table()->push_back({name, std::move(value)});
  }
}

// `upon`: how many files it lies below, one upon another.
Node with_bases(Node file, const std::string& path, std::vector<config::Problem>& problems, int upon) {
  constexpr int most = 8;
  const Node* base = file.find("base");
  if (!base) return file;
  const auto refuse = [&](const std::string& text) { problems.push_back({base->place, "base", text}); };
  const auto without_base = [](Node node) {
    drop(node, "base");
    return node;
  };
  if (!base->string() || base->string()->empty()) {
    refuse("must be the name of a file, not " + base->describe());
    return without_base(std::move(file));
  }
  if (upon == most) {
    refuse("is one too many: at most " + std::to_string(most) + ", one upon another. Is a file its own base?");
    return without_base(std::move(file));
  }
  const std::string where = beside(base->place, path, *base->string());
  try {
    Node below = config::parse_document(where, config::read_text_file(where));
    below = with_bases(std::move(below), where, problems, upon + 1);
    drop(below, "name");
    lay_over(below, std::move(file));
    return without_base(std::move(below));
  } catch (const config::DocumentError& e) {
    refuse(e.problem.place.text() + ": " + e.problem.text);
    return without_base(std::move(file));
  }
}

}  // namespace

Node with_base(Node file, const std::string& path, std::vector<config::Problem>& problems) {
  return with_bases(std::move(file), path, problems, 0);
}

std::string beside(const config::Place& written, const std::string& path, const std::string& reference) {
  const std::filesystem::path named(reference);
  if (named.is_absolute() || path == "-") return reference;
  const std::filesystem::path file(written.from_file() ? *written.origin : path);
  return (file.parent_path() / named).lexically_normal().string();
}

}  // namespace banyan::study
