// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <cmath>

#include "banyan/record/output_formats.hpp"

namespace banyan::cli {

using config::number_text;
using config::Override;
namespace {

template <typename Number> CLI::Validator within(Number least, Number most, const std::string& limits) {
  return {[=](const std::string& text) {
            Number value{};
            const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return fits ? std::string() : "must be a " + limits + ", not \"" + text + "\"";
          },
          ""};
}

// For each format of output: to have one that is not the default, and not to have one that is.
void add_outputs(CLI::App& command, std::vector<Override>& overrides) {
  for (const auto& format : banyan::record::output_formats) {
    if (format.key.empty()) continue;
    const std::string key(format.key), text = std::string(format.file) + ", " + std::string(format.what);
    const std::string name = (format.by_default ? "--no-" : "--") + key;
    const std::string assignment = "output." + key + (format.by_default ? "=false" : "=true");
    command.add_flag_function(
        name,
        [&overrides, name, assignment](std::int64_t) {
          overrides.push_back({assignment, name});
        },
        (format.by_default ? "do not write " : "also write ") + text);
  }
}

}  // namespace

CLI::Validator a_name() {
  return {[](const std::string& text) { return text.empty() ? "must not be empty" : std::string(); }, ""};
}

CLI::Validator number_within(double least, double most) {
  return within(least, most, "number from " + number_text(least) + " to " + number_text(most));
}

CLI::Validator whole_within(std::int64_t least, std::int64_t most) {
  return within(least, most, "whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

CLI::Validator moment() {
  return {[](const std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0.0;
            return number ? std::string() : "must be a number of at least 0, not \"" + text + "\"";
          },
          ""};
}

void add_overrides(CLI::App& command, std::vector<Override>& overrides) {
  command
      .add_option_function<std::vector<std::string>>(
          "-s,--set",
          [&overrides](const std::vector<std::string>& list) {
            for (const auto& assignment : list) overrides.push_back({assignment, "--set " + assignment});
          },
          "change a key of the scenario, such as radio.loss=0.3; may be repeated")
      ->type_name("KEY=VALUE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->expected(1, 10000)
      ->take_all();
  command
      .add_option_function<std::vector<std::string>>(
          "-w,--with",
          [&overrides](const std::vector<std::string>& list) {
            for (const auto& file : list) overrides.push_back({"", "--with " + file, file});
          },
          "lay the keys of a file over the scenario, such as tuned parameters; may be repeated")
      ->type_name("FILE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->expected(1, 100)
      ->take_all();
}

void add_seed(CLI::App& command, std::vector<Override>& overrides) {
  command
      .add_option_function<std::string>(
          "--seed",
          [&overrides](const std::string& seed) {
            overrides.push_back({"seed=" + seed, "--seed " + seed});
          },
          "change the scenario's seed")
      ->type_name("N");
}

void add_results(CLI::App& command, RunOptions& options) {
  add_overrides(command, options.overrides);
  add_seed(command, options.overrides);
  command.add_option("-o,--out", options.out, "directory for the results, default out/<name>-<algorithm>-<seed>")
      ->type_name("DIR")
      ->check(a_name());
  command.add_flag("-f,--force", options.force, "replace results that are already there");
  command.add_flag("--json", options.json, "print the result as JSON on standard output, and nothing else there");
  command.add_flag("-q,--quiet", options.quiet, "no progress and no summary; warnings and errors only");
  add_outputs(command, options.overrides);
}

}  // namespace banyan::cli
