// SPDX-License-Identifier: MIT
// Command lines of programs that depend on nothing: a row per option says how it is read, written and explained.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace banyan::udp {

class OptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class Options> struct OptionRow {
  const char* name;
  const char* form;  // "" for a flag
  const char* meaning;
  std::function<void(Options&, const std::string&)> read;
  std::function<std::vector<std::string>(const Options&)> write;  // the values to write; none: as by default
  bool repeats = false;                                           // may be given more than once
};

[[nodiscard]] inline double option_number(const std::string& text, double least, double most) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most)) {
    std::ostringstream words;
    words << "must be a number from " << least << " to " << most << ", not \"" << text << "\"";
    throw OptionError(words.str());
  }
  return value;
}
[[nodiscard]] inline double option_whole_number(const std::string& text, double least, double most) {
  const double value = option_number(text, least, most);
  if (value != std::floor(value)) throw OptionError("must be a whole number, not \"" + text + "\"");
  return value;
}

template <class Number> [[nodiscard]] std::string option_text(Number value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

// `get` yields a reference to the member that the option sets.
template <class Options, class Get>
OptionRow<Options> real_option(const char* name, const char* meaning, double least, double most, Get get) {
  return {name, "X", meaning,
          [=](Options& o, const std::string& text) {
            auto& value = get(o);
            value = static_cast<std::remove_reference_t<decltype(value)>>(option_number(text, least, most));
          },
          [=](const Options& o) {
            Options now = o, by_default;
            if (get(now) == get(by_default)) return std::vector<std::string>{};
            return std::vector{option_text(get(now))};
          }};
}

template <class Options, class Get>
OptionRow<Options> text_option(const char* name, const char* form, const char* meaning, Get get) {
  return {name, form, meaning, [=](Options& o, const std::string& value) { get(o) = value; },
          [=](const Options& o) {
            Options now = o, by_default;
            if (get(now) == get(by_default)) return std::vector<std::string>{};
            return std::vector{get(now)};
          }};
}

template <class Options>
OptionRow<Options> flag_option(const char* name, const char* meaning, std::function<bool(const Options&)> is,
                               std::function<void(Options&)> set) {
  return {name, "", meaning, [set = std::move(set)](Options& o, const std::string&) { set(o); },
          [is = std::move(is)](const Options& o) {
            return is(o) ? std::vector<std::string>{""} : std::vector<std::string>{};
          }};
}

template <class Options> std::string option_usage(std::span<const OptionRow<Options>> rows) {
  std::string usage;
  for (const auto& row : rows) {
    std::string line = std::string("  ") + row.name + " " + row.form;
    line.resize(std::max<std::size_t>(line.size() + 1, 26), ' ');
    usage += line + row.meaning + "\n";
  }
  return usage;
}

// Throws OptionError, also for values that are out of range or missing, and for options that are given twice: the first
// or the last of them would be dropped in silence. A flag that is repeated says nothing new.
template <class Options>
Options read_options(std::span<const OptionRow<Options>> rows, std::span<const std::string> arguments,
                     Options parsed = {}) {
  std::vector<const OptionRow<Options>*> given;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const OptionRow<Options>* chosen = nullptr;
    for (const auto& row : rows)
      if (arguments[k] == row.name) chosen = &row;
    if (chosen == nullptr) throw OptionError("\"" + arguments[k] + "\" is unknown; see --help");
    const bool takes_value = *chosen->form != '\0';
    if (takes_value && k + 1 == arguments.size()) throw OptionError(arguments[k] + " needs a value");
    if (takes_value && !chosen->repeats && std::find(given.begin(), given.end(), chosen) != given.end())
      throw OptionError(arguments[k] + " is given twice; give it once");
    given.push_back(chosen);
    try {
      chosen->read(parsed, takes_value ? arguments[++k] : "");
    } catch (const OptionError& error) { throw OptionError(std::string(chosen->name) + " " + error.what()); }
  }
  return parsed;
}

// The arguments that stand for these options; what is as by default is left out.
template <class Options>
std::vector<std::string> written_options(std::span<const OptionRow<Options>> rows, const Options& wanted) {
  std::vector<std::string> arguments;
  for (const auto& row : rows) {
    for (const std::string& value : row.write(wanted)) {
      arguments.emplace_back(row.name);
      if (*row.form != '\0') arguments.push_back(value);
    }
  }
  return arguments;
}

}  // namespace banyan::udp
