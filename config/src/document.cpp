// SPDX-License-Identifier: MIT
#include "banyan/config/document.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "banyan/controller/core/printable.hpp"

namespace banyan::config {
namespace {

// The most robots, targets and headings that a scenario may list take 5 MB, with all their digits.
constexpr std::size_t largest_file = std::size_t{8} << 20;

std::shared_ptr<const std::string> shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

[[noreturn]] void fail(Place place, std::string text) { throw DocumentError({std::move(place), "", std::move(text)}); }

// ---------------------------------------------------------------------------------------- TOML --

Node from_toml(const toml::node& node, const std::shared_ptr<const std::string>& origin, bool from_file) {
  Node result;
  result.place = {origin, from_file ? static_cast<int>(node.source().begin.line) : 0};
  if (const auto* table = node.as_table()) {
    Node::Table members;
    for (const auto& [key, child] : *table) {
      members.push_back({std::string(key.str()), from_toml(child, origin, from_file)});
      // toml++ gives an inline or dotted table no line of its own; its key has one.
      if (from_file) members.back().value.place.line = static_cast<int>(key.source().begin.line);
    }
    // toml++ sorts its tables; a reader expects messages in the order of the file.
    std::stable_sort(members.begin(), members.end(),
                     [](const auto& a, const auto& b) { return a.value.place.line < b.value.place.line; });
    result.value = std::move(members);
  } else if (const auto* array = node.as_array()) {
    Node::Array items;
    for (const auto& child : *array) items.push_back(from_toml(child, origin, from_file));
    result.value = std::move(items);
  } else if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.value = integer->get();
  } else if (const auto* real = node.as_floating_point()) {
    result.value = real->get();
  } else if (const auto* truth = node.as_boolean()) {
    result.value = truth->get();
  }
  return result;
}

std::string lower_first(std::string text) {
  if (!text.empty() && text.size() > 1 && text[1] >= 'a' && text[1] <= 'z') {
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  }
  return text;
}

// The last character of the string of TOML that begins at `at`; of one that does not end, that of its line or text.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string whole(3, quote);
  const bool lines = text.substr(at).starts_with(whole);
  for (at += lines ? 3 : 1; at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"') ++at;
    else if (lines ? text.substr(at).starts_with(whole) : text[at] == quote) return at + (lines ? 2 : 0);
    else if (!lines && text[at] == '\n') break;
  }
  return std::min(at, text.size());
}

// toml++ 3.3 bounds nested brackets but not dotted keys: "a.a.a..." a million times over would
// exhaust the stack when its tables are destroyed.
bool has_endless_key(std::string_view text) {
  int dots = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
    } else if (c == '.') {
      if (++dots > 1000) return true;
    } else if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      dots = 0;
    } else if (c == ',' || c == '=' || c == '[' || c == ']' || c == '{' || c == '}' || c == '\n') {
      dots = 0;
    }
  }
  return false;
}

Node parse_toml(const std::shared_ptr<const std::string>& origin, std::string_view text) {
  if (has_endless_key(text)) fail({origin, 0}, "has a key of more than a thousand parts: this is no scenario");
  try {
    return from_toml(toml::parse(text), origin, true);
  } catch (const toml::parse_error& e) {
    fail({origin, static_cast<int>(e.source().begin.line)},
         "this is not TOML: " + lower_first(std::string(e.description())));
  }
}

// ---------------------------------------------------------------------------------------- JSON --

// Feeds the text to nlohmann's parser and remembers the line of the last character that was no
// white space: its events come without positions.
class LineCounter {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  struct Lines {
    int current = 1;
    int last_ink = 1;
  };

  LineCounter(const char* at, Lines* lines) : at_(at), lines_(lines) {}
  reference operator*() const { return *at_; }
  LineCounter& operator++() {
    if (*at_ == '\n') ++lines_->current;
    else if (*at_ != ' ' && *at_ != '\t' && *at_ != '\r') lines_->last_ink = lines_->current;
    ++at_;
    return *this;
  }
  LineCounter operator++(int) {
    auto before = *this;
    ++*this;
    return before;
  }
  bool operator==(const LineCounter& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  Lines* lines_;
};

class JsonBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonBuilder(std::shared_ptr<const std::string> origin, const LineCounter::Lines& lines)
      : origin_(std::move(origin)), lines_(lines) {}

  bool null() override { return add(Node::Other{}); }
  bool boolean(bool v) override { return add(v); }
  bool number_integer(number_integer_t v) override { return add(std::int64_t{v}); }
  bool number_unsigned(number_unsigned_t v) override {
    if (v > static_cast<number_unsigned_t>(std::numeric_limits<std::int64_t>::max())) {
      return add(static_cast<double>(v));
    }
    return add(static_cast<std::int64_t>(v));
  }
  bool number_float(number_float_t v, const string_t&) override { return add(v); }
  bool string(string_t& v) override { return add(std::move(v)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Node::Table{}); }
  bool start_array(std::size_t) override { return open(Node::Array{}); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& v) override {
    if (open_.back().find(v)) fail({origin_, lines_.last_ink}, "\"" + v + "\" is given twice");
    keys_.back() = {v, lines_.last_ink};
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) override {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while ..."
    std::string text = e.what();
    if (const auto at = text.find("] "); at != std::string::npos) text.erase(0, at + 2);
    if (const auto at = text.find(": "); text.starts_with("parse error at") && at != std::string::npos) {
      text.erase(0, at + 2);
    }
    fail({origin_, lines_.current}, "this is not JSON: " + text);
  }

  Node root;

 private:
  Place here() const {
    return {origin_, keys_.empty() || keys_.back().second == 0 ? lines_.last_ink : keys_.back().second};
  }
  void attach(Node node) {
    if (open_.empty()) {
      root = std::move(node);
      return;
    }
    if (auto* table = open_.back().table()) table->push_back({keys_.back().first, std::move(node)});
    else open_.back().array()->push_back(std::move(node));
  }
  template <class T> bool add(T v) {
    attach({std::move(v), here()});
    return true;
  }
  template <class T> bool open(T v) {
    if (open_.size() >= deepest_nesting) fail({origin_, lines_.last_ink}, "nested too deeply for a scenario");
    open_.push_back({std::move(v), here()});
    keys_.emplace_back("", 0);
    return true;
  }
  bool close() {
    Node done = std::move(open_.back());
    open_.pop_back();
    keys_.pop_back();
    attach(std::move(done));
    return true;
  }

  std::shared_ptr<const std::string> origin_;
  const LineCounter::Lines& lines_;
  std::vector<Node> open_;
  std::vector<std::pair<std::string, int>> keys_;  // per open object: the key being read and its line
};

Node parse_json(const std::shared_ptr<const std::string>& origin, std::string_view text) {
  LineCounter::Lines lines;
  JsonBuilder builder(origin, lines);
  nlohmann::json::sax_parse(LineCounter(text.data(), &lines), LineCounter(text.data() + text.size(), &lines), &builder);
  return std::move(builder.root);
}

}  // namespace

std::string Place::text() const {
  if (!origin) return "banyan";
  return line > 0 ? *origin + ":" + std::to_string(line) : *origin;
}

std::string to_string(const Problem& problem) {
  std::string text = problem.place.text() + (problem.warning ? ": warning: " : ": error: ");
  if (!problem.key.empty()) text += problem.key + ": ";
  return printable(text + problem.text);
}

const Node* Node::find(std::string_view name) const noexcept {
  if (const auto* members = table()) {
    for (const auto& [key, child] : *members) {
      if (key == name) return &child;
    }
  }
  return nullptr;
}

Node* Node::find(std::string_view name) noexcept { return const_cast<Node*>(std::as_const(*this).find(name)); }

std::string Node::describe() const {
  struct Describe {
    std::string operator()(Other) const { return "null, a date or a time"; }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return "the number " + std::to_string(v); }
    std::string operator()(double v) const { return "the number " + number_text(v); }
    std::string operator()(const std::string& v) const { return world::the_text(v); }
    std::string operator()(const Array& v) const {
      return "a list of " + std::to_string(v.size()) + (v.size() == 1 ? " value" : " values");
    }
    std::string operator()(const Table&) const { return "a table"; }
  };
  return std::visit(Describe{}, value);
}

std::string read_file(const std::string& path, std::size_t most) {
  const Place place{shared(path == "-" ? "standard input" : path), 0};
  const int fd = path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    if (errno == ENOENT) fail(place, "there is no such file");
    fail(place, std::string("cannot be opened: ") + std::strerror(errno));
  }
  struct Closer {
    int fd;
    ~Closer() { ::close(fd); }
  } closer{fd};
  struct stat status {};
  if (::fstat(fd, &status) == 0 && S_ISDIR(status.st_mode)) { fail(place, "is a directory; give the file in it"); }
  std::string text;
  std::array<char, 65536> buffer;
  while (true) {
    const auto got = ::read(fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(place, std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(got));
    if (text.size() > most)
      fail(place, "is larger than " + std::to_string(most >> 20) + " MiB" +
                      (most == largest_file ? ": this is no scenario" : ""));
  }
  return text;
}

std::string read_text_file(const std::string& path) {
  const Place place{shared(path == "-" ? "standard input" : path), 0};
  std::string text = read_file(path, largest_file);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // byte order mark
  if (text.find('\0') != std::string::npos) fail(place, "is a binary file; a scenario is text (TOML or JSON)");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    fail(place, "is empty; see scenarios/ and studies/ for examples");
  return text;
}

Node parse_document(const std::string& path, std::string_view text) {
  const auto origin = shared(path == "-" ? "standard input" : path);
  const auto ink = text.find_first_not_of(" \t\r\n");
  const bool json = path.ends_with(".json") || (ink != std::string_view::npos && text[ink] == '{');
  Node root = json ? parse_json(origin, text) : parse_toml(origin, text);
  if (!root.table()) fail(root.place, "a scenario is a table of keys, not " + root.describe());
  return root;
}

Node parse_value(std::string_view text, const std::shared_ptr<const std::string>& origin) {
  if (text.find_first_of("\r\n") == std::string_view::npos && !has_endless_key(text)) {
    try {
      const auto parsed = toml::parse("v = " + std::string(text));
      if (parsed.size() == 1) return from_toml(*parsed.get("v"), origin, false);
    } catch (const toml::parse_error&) {  // not TOML: bare text
    }
  }
  return {std::string(text), {origin, 0}};
}

std::string name_from(const std::string& path, std::string_view fallback) {
  std::string name = path == "-" ? "standard-input" : std::filesystem::path(path).stem().string();
  for (char& c : name) {
    if (!good_name(std::string("x") + c)) c = '-';
  }
  if (name.starts_with('.')) name[0] = '-';
  name.resize(std::min<std::size_t>(name.size(), 100));
  return name.empty() ? std::string(fallback) : name;
}

}  // namespace banyan::config
