// SPDX-License-Identifier: MIT
// CLI11 as the programs of robots use it: what is wrong is said in one form, and what was read can be written again.
// For the one source of a program that has its options: it takes long to compile.
#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "banyan/hosts/udp/option_error.hpp"

namespace banyan::udp {

// What is wrong with a number, or nothing.
[[nodiscard]] inline std::string number_fault(const std::string& text, double least, double most, bool whole = false) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most)) {
    std::ostringstream words;
    words << "must be a number from " << least << " to " << most << ", not \"" << text << "\"";
    return words.str();
  }
  return whole && value != std::floor(value) ? "must be a whole number, not \"" + text + "\"" : "";
}

// The shortest text that is read as this number.
template <class Number> [[nodiscard]] std::string number_text(Number value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

template <class Number>
CLI::Option* add_number(CLI::App& app, const char* name, Number& value, double least, double most, const char* meaning,
                        bool whole = false) {
  return app
      .add_option_function<std::string>(
          name, [&value](const std::string& text) { value = static_cast<Number>(std::strtod(text.c_str(), nullptr)); },
          meaning)
      ->type_name(whole ? "N" : "X")
      ->check({[=](const std::string& text) { return number_fault(text, least, most, whole); }, ""})
      ->default_function([&value] { return number_text(value); });
}

inline CLI::Option* add_text(CLI::App& app, const char* name, const char* form, std::string& value,
                             const char* meaning) {
  return app.add_option(name, value, meaning)->type_name(form);
}

// Sets `value` to `given`. A flag that is repeated says nothing new.
template <class Value> void add_flag(CLI::App& app, const char* name, Value& value, Value given, const char* meaning) {
  app.add_flag_function(
         name, [&value, given](std::int64_t) { value = given; }, meaning)
      ->disable_flag_override()
      ->default_function([&value, given] { return std::string(value == given ? "given" : ""); });
}

// Throws OptionError, also for values that are out of range or missing, and for options that are given twice: the first
// or the last of them would be dropped in silence.
inline void read_arguments(CLI::App& app, std::span<const std::string> arguments) {
  app.set_help_flag();  // the program has looked for it
  app.allow_extras();
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    const std::string text = error.what();
    const std::size_t colon = text.find(": "), twice = text.find(": At Most 1 required but received ");
    if (twice != std::string::npos) throw OptionError(text.substr(0, twice) + " is given twice; give it once");
    if (text.ends_with(" was given a disallowed flag override"))
      throw OptionError("--" + text.substr(0, text.find(' ')) + " takes no value");
    if (text.ends_with(" missing")) throw OptionError(text.substr(0, colon) + " needs a value");
    throw OptionError(colon == std::string::npos ? text : text.substr(0, colon) + text.substr(colon + 1));
  }
  if (const auto unknown = app.remaining(); !unknown.empty())
    throw OptionError("\"" + unknown.front() + "\" is unknown; see --help");
}

// The arguments that stand for what `now` would set, but for what is as in `usual`, an app of the same options. Of an
// option that repeats, each line of its default is a value.
inline std::vector<std::string> written_arguments(CLI::App& now, CLI::App& usual) {
  std::vector<std::string> arguments;
  const auto all = now.get_options(), others = usual.get_options();
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k]->capture_default_str();
    others[k]->capture_default_str();
    if (all[k]->get_default_str() == others[k]->get_default_str()) continue;
    std::istringstream values(all[k]->get_default_str());
    for (std::string value; std::getline(values, value);) {
      arguments.push_back(all[k]->get_name());
      if (all[k]->get_items_expected_max() > 0) arguments.push_back(value);
    }
  }
  return arguments;
}

}  // namespace banyan::udp
