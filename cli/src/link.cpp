// SPDX-License-Identifier: MIT
#include "link.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "banyan/algorithms/algorithms.hpp"
#include "shipped.hpp"

namespace banyan::cli {

using namespace config;
namespace {

namespace fs = std::filesystem;

// What acts at the beginning of the step after `tick`; run 0: in all runs side by side.
struct Act {
  std::uint64_t tick = 0;
  std::uint64_t run = 0;
  std::string json;
};

struct LinkParts {
  std::string scenario, name, text;
  std::vector<std::string> sets, algorithms, seeds;
  std::vector<Act> acts;
};

std::optional<int> digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

// %20 and the like; a % that encodes nothing stays.
std::string decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto high = i + 2 < text.size() && text[i] == '%' ? digit_of(text[i + 1]) : std::nullopt;
    const auto low = high ? digit_of(text[i + 2]) : std::nullopt;
    out += low ? static_cast<char>(16 * *high + *low) : text[i];
    if (low) i += 2;
  }
  return out;
}

// base64url without padding (RFC 4648, section 5); nothing if it is none.
std::optional<std::string> from_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const auto value = digits.find(c);
    if (value == std::string_view::npos) return std::nullopt;
    bits = bits << 6U | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
  }
  return out;
}

bool read_number(std::string_view text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

// "50:{...}" or, of the second of the runs side by side alone, "50@2:{...}".
std::optional<Act> act_of(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  std::string_view when = std::string_view(text).substr(0, colon);
  Act act{0, 0, text.substr(colon + 1)};
  if (const auto at = when.find('@'); at != std::string_view::npos) {
    if (!read_number(when.substr(at + 1), act.run) || act.run == 0) return std::nullopt;
    when = when.substr(0, at);
  }
  if (!read_number(when, act.tick)) return std::nullopt;
  return act;
}

class LinkReader {
 public:
  explicit LinkReader(const std::string& link) : origin_(std::make_shared<const std::string>("link")) {
    std::string_view rest = std::string_view(link).substr(link.find('#') + 1);
    if (rest.find_first_of("=&") == std::string_view::npos) {
      parts.scenario = decoded(rest);
      return;
    }
    while (!rest.empty()) {
      const auto end = std::min(rest.find('&'), rest.size());
      take(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

  void wrong(const std::string& key, const std::string& text) { problems.push_back({{origin_, 0}, key, text, false}); }

  LinkParts parts;
  std::size_t beside = 0;  // further runs, with scenarios of their own
  std::vector<Problem> problems;

 private:
  void take(std::string_view part) {
    const auto equals = std::min(part.find('='), part.size());
    const std::string key(part.substr(0, equals));
    const std::string value = decoded(part.substr(std::min(equals + 1, part.size())));
    if (key == "scenario") parts.scenario = value;
    else if (key == "name") parts.name = value;
    else if (key == "text") take_text(value);
    else if (key == "set") parts.sets.push_back(value);
    else if (key == "algorithm") parts.algorithms.push_back(value);
    else if (key == "seed") parts.seeds.push_back(value);
    else if (key == "do") take_act(value);
    else if (key == "beside") ++beside;
    else if (key == "recording") wrong(key, "the link shows a recording, which cannot be computed or fetched");
    else if (!std::ranges::count(views, std::string_view(key))) wrong(key, "is unknown; allowed: " + known(key));
  }
  void take_text(const std::string& value) {
    const auto text = from_base64(value);
    if (!text) wrong("text", "is not base64url");
    else parts.text = *text;
  }
  void take_act(const std::string& value) {
    if (const auto act = act_of(value)) parts.acts.push_back(*act);
    else wrong("do", "is \"" + value + "\"; it is a tick, a colon and an event as JSON");
  }
  static std::string known(const std::string& key) {
    const std::vector<std::string_view> all{"scenario", "name", "text", "set",   "algorithm", "seed",
                                            "do",       "t",    "view", "robot", "target",    "beside"};
    const auto near = nearest(key, all);
    std::string text;
    for (const std::string_view one : all) text += (text.empty() ? "" : ", ") + std::string(one);
    return near.empty() ? text : text + "; did you mean " + std::string(near) + "?";
  }

  // What the page looks at: of no matter for what is computed.
  static constexpr std::array<std::string_view, 4> views{"t", "view", "robot", "target"};
  std::shared_ptr<const std::string> origin_;
};

// The text of the scenario that is meant; "" if there is none, with a problem.
std::string scenario_text(LinkReader& reader) {
  const LinkParts& parts = reader.parts;
  if (!parts.text.empty()) return parts.text;
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(shipped_scenarios(), ignored))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  if (std::ranges::count(names, parts.scenario))
    return read_text_file(shipped_scenarios() + "/" + parts.scenario + ".toml");
  std::vector<std::string_view> views(names.begin(), names.end());
  std::string text =
      parts.scenario.empty() ? "the link names no scenario" : "there is no scenario \"" + parts.scenario + "\"";
  if (const auto near = nearest(parts.scenario, views); !near.empty())
    text += "; did you mean " + std::string(near) + "?";
  reader.wrong("scenario", text);
  return "";
}

std::vector<Override> overrides_of(const LinkParts& parts, const std::vector<Override>& more) {
  std::vector<Override> all;
  const auto add = [&](const std::string& assignment) {
    all.push_back({assignment, "set=" + assignment + " of the link", {}});
  };
  for (const std::string& set : parts.sets) add(set);
  if (!parts.seeds.empty()) add("seed=" + parts.seeds.front());
  if (!parts.algorithms.empty() && !parts.algorithms.front().empty())
    add("mission.algorithm=" + parts.algorithms.front());
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// The configuration with what was done as its events, as the page saves it.
Loaded with_acts(const Loaded& loaded, const std::vector<Act>& acts, const std::string& path) {
  const Configuration& configuration = loaded.configuration;
  Node root = parse_document("link", config_json(configuration));
  if (root.find("events") == nullptr) root.table()->push_back({"events", Node{Node::Array{}, root.place}});
  for (const Act& act : acts) {
    if (act.run > 1) continue;
    Node event = parse_document("link.json", act.json);
    const Node::Table* given = event.table();
    if (given == nullptr) throw DocumentError({event.place, "do", "an event is a table"});
    event.table()->push_back(
        {"time_s", Node{static_cast<double>(act.tick) * configuration.scenario.tick_s, event.place}});
    root.find("events")->array()->push_back(std::move(event));
  }
  return configure(std::move(root), path, algorithms(), loaded.problems);
}

}  // namespace

bool is_link(std::string_view text) {
  const auto hash = text.find('#');
  if (hash == std::string_view::npos) return false;
  const std::string_view before = text.substr(0, hash);
  return before.empty() || before.starts_with("http://") || before.starts_with("https://") ||
         before.starts_with("file://");
}

LoadedLink load_link(const std::string& link, const std::vector<Override>& more) {
  LoadedLink result;
  result.fragment = link.substr(link.find('#'));
  LinkReader reader(link);
  const auto odd = [](char c) { return c <= ' ' || c > '~'; };
  if (std::ranges::any_of(link, odd))
    reader.wrong("", "has characters that no address has; copy it as a whole, in quotes");
  try {
    const std::string text = scenario_text(reader);
    if (!reader.problems.empty()) {
      result.loaded.problems = reader.problems;
      return result;
    }
    const LinkParts& parts = reader.parts;
    result.runs = std::max<std::size_t>(1, parts.algorithms.size()) * std::max<std::size_t>(1, parts.seeds.size()) +
                  reader.beside;
    const std::string path = parts.text.empty()   ? parts.scenario + ".toml"
                             : parts.name.empty() ? "link.toml"
                                                  : parts.name;
    result.loaded = parse_configuration(path, text, algorithms(), overrides_of(parts, more));
    if (result.loaded.ok() && !parts.acts.empty()) result.loaded = with_acts(result.loaded, parts.acts, path);
  } catch (const DocumentError& error) { result.loaded.problems.push_back(error.problem); }
  return result;
}

}  // namespace banyan::cli
