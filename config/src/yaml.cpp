// SPDX-License-Identifier: MIT
#include "yaml.hpp"

#include <yaml.h>
#include <cctype>
#include <optional>

namespace banyan::config {
namespace {

struct Parser {
  Parser() {
    if (yaml_parser_initialize(&parser) == 0) throw std::bad_alloc();
  }
  ~Parser() { yaml_parser_delete(&parser); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
  yaml_parser_t parser{};
};
struct Document {
  explicit Document(yaml_parser_t& parser) : loaded{yaml_parser_load(&parser, &document) != 0} {}
  ~Document() {
    if (loaded) yaml_document_delete(&document);
  }
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;
  yaml_document_t document{};
  bool loaded;
};

// Of YAML's core schema: "0.05", "-.5", "1.", "5e-2". Nothing if it is no number.
std::optional<double> number_in(std::string text) {
  std::size_t at = 0, digits = 0;
  const auto skip_digits = [&] {
    for (; at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0; ++at) ++digits;
  };
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  const std::size_t first = at;
  skip_digits();
  if (at < text.size() && text[at] == '.') {
    if (at == first) text.insert(at++, "0");
    ++at;
    if (at == text.size() || std::isdigit(static_cast<unsigned char>(text[at])) == 0) text.insert(at++, "0");
    skip_digits();
  }
  if (digits == 0) return std::nullopt;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    digits = 0;
    skip_digits();
    if (digits == 0) return std::nullopt;
  }
  if (at != text.size()) return std::nullopt;
  return world::read_decimal(text.c_str() + (text[0] == '+' ? 1 : 0));
}

// The library's nodes are unions, with their type beside them. NOLINTBEGIN(cppcoreguidelines-pro-type-union-access)
Node scalar(const yaml_node_t& node, Place place) {
  std::string text(reinterpret_cast<const char*>(node.data.scalar.value), node.data.scalar.length);
  if (node.data.scalar.style == YAML_PLAIN_SCALAR_STYLE) {
    if (text == "true" || text == "True" || text == "TRUE") return {true, std::move(place)};
    if (text == "false" || text == "False" || text == "FALSE") return {false, std::move(place)};
    if (const auto number = number_in(text)) return {*number, std::move(place)};
  }
  return {std::move(text), std::move(place)};
}

// `left`: how many nodes there may still be. Aliases make a small text a huge tree.
Node to_node(yaml_document_t& document, int index, const std::shared_ptr<const std::string>& origin, std::size_t depth,
             std::size_t& left) {
  const yaml_node_t* node = yaml_document_get_node(&document, index);
  const Place place{origin, static_cast<int>(node->start_mark.line) + 1};
  if (left-- == 0) throw DocumentError({place, "", "has more than ten thousand values: no map"});
  if (depth > deepest_nesting) throw DocumentError({place, "", "nested too deeply, or with an anchor in itself"});
  if (node->type == YAML_SCALAR_NODE) return scalar(*node, place);
  if (node->type == YAML_SEQUENCE_NODE) {
    Node::Array items;
    for (auto* item = node->data.sequence.items.start; item != node->data.sequence.items.top; ++item)
      items.push_back(to_node(document, *item, origin, depth + 1, left));
    return {std::move(items), place};
  }
  if (node->type != YAML_MAPPING_NODE) return {Node::Other{}, place};
  Node::Table members;
  for (auto* pair = node->data.mapping.pairs.start; pair != node->data.mapping.pairs.top; ++pair) {
    const yaml_node_t* key = yaml_document_get_node(&document, pair->key);
    const Place here{origin, static_cast<int>(key->start_mark.line) + 1};
    if (key->type != YAML_SCALAR_NODE) throw DocumentError({here, "", "has a key that is no text"});
    std::string name(reinterpret_cast<const char*>(key->data.scalar.value), key->data.scalar.length);
    for (const auto& member : members)
      if (member.name == name) throw DocumentError({here, name, "is given twice"});
    members.push_back({std::move(name), to_node(document, pair->value, origin, depth + 1, left)});
    members.back().value.place = here;
  }
  return {std::move(members), place};
}
// NOLINTEND(cppcoreguidelines-pro-type-union-access)

}  // namespace

Node parse_yaml(const std::string& path, std::string_view text) {
  const auto origin = std::make_shared<const std::string>(path);
  if (text.size() > (std::size_t{1} << 16)) throw DocumentError({{origin, 0}, "", "is larger than 64 KiB: no map"});
  Parser source;
  yaml_parser_set_input_string(&source.parser, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  Document loaded(source.parser);
  if (!loaded.loaded) {
    const auto line = static_cast<int>(source.parser.problem_mark.line) + 1;
    const char* problem = source.parser.problem;
    throw DocumentError({{origin, line}, "", std::string("this is not YAML: ") + (problem ? problem : "damaged")});
  }
  if (yaml_document_get_root_node(&loaded.document) == nullptr) throw DocumentError({{origin, 0}, "", "is empty"});
  std::size_t left = 10'000;
  return to_node(loaded.document, 1, origin, 0, left);
}

}  // namespace banyan::config
