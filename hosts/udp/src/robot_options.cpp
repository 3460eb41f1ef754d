// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/robot_options.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>

namespace banyan::udp {
namespace {

struct Option {
  const char* name;
  const char* form;  // "" for a flag
  const char* meaning;
  std::function<void(RobotOptions&, const std::string&)> read;
  std::function<std::vector<std::string>(const RobotOptions&)> write;  // the values to write; none: as by default
};

double number(const std::string& text, double least, double most) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most)) {
    std::ostringstream words;
    words << "must be a number from " << least << " to " << most << ", not \"" << text << "\"";
    throw OptionError(words.str());
  }
  return value;
}

std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}
std::string text_of(float value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

template <class Get> Option real(const char* name, const char* meaning, double least, double most, Get get) {
  return {name, "X", meaning,
          [=](RobotOptions& o, const std::string& text) {
            auto& value = get(o);
            value = static_cast<std::remove_reference_t<decltype(value)>>(number(text, least, most));
          },
          [=](const RobotOptions& o) {
            RobotOptions now = o, by_default;
            if (get(now) == get(by_default)) return std::vector<std::string>{};
            return std::vector{text_of(get(now))};
          }};
}

template <class Get> Option text(const char* name, const char* form, const char* meaning, Get get) {
  return {name, form, meaning, [=](RobotOptions& o, const std::string& value) { get(o) = value; },
          [=](const RobotOptions& o) {
            RobotOptions now = o, by_default;
            if (get(now) == get(by_default)) return std::vector<std::string>{};
            return std::vector{get(now)};
          }};
}

void set_parameter(RobotOptions& options, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) throw OptionError("must be KEY=VALUE, not \"" + assignment + "\"");
  options.setup.parameters.emplace_back(assignment.substr(0, equals), number(assignment.substr(equals + 1), -1e9, 1e9));
}

std::vector<std::string> parameters_of(const RobotOptions& options) {
  std::vector<std::string> list;
  for (const auto& [key, value] : options.setup.parameters) list.push_back(key + "=" + text_of(value));
  return list;
}

Option flag(const char* name, const char* meaning, std::function<bool(const RobotOptions&)> is, std::function<void(RobotOptions&)> set) {
  return {name, "", meaning, [set = std::move(set)](RobotOptions& o, const std::string&) { set(o); },
          [is = std::move(is)](const RobotOptions& o) { return is(o) ? std::vector<std::string>{""} : std::vector<std::string>{}; }};
}

const std::vector<Option>& options() {
  static const std::vector<Option> list = {
      {"--id", "N", "of this robot, from 0; required",
       [](RobotOptions& o, const std::string& value) {
         const double id = number(value, 0, nobody - 2);
         if (id != std::floor(id)) throw OptionError("must be a whole number, not \"" + value + "\"");
         o.id = static_cast<RobotId>(id);
       },
       [](const RobotOptions& o) { return std::vector{std::to_string(o.id)}; }},
      text("--hub", "ADDRESS:PORT", "where the hub is; this or --peers is required", [](RobotOptions& o) -> std::string& { return o.hub; }),
      text("--peers", "ADDRESSES", "without a hub: ADDRESS:PORT of each other robot with commas between, or of a broadcast; needs --base",
           [](RobotOptions& o) -> std::string& { return o.peers; }),
      text("--listen", "ADDRESS:PORT", "where its peers find it; required with --peers", [](RobotOptions& o) -> std::string& { return o.listen; }),
      flag("--root", "with --peers: it is the first root; exactly one is", [](const RobotOptions& o) { return o.root; },
           [](RobotOptions& o) { o.root = true; }),
      flag("--worker", "with --peers: it will be sent to a target", [](const RobotOptions& o) { return o.worker; },
           [](RobotOptions& o) { o.worker = true; }),
      text("--key", "FILE", "the fleet's keys; required", [](RobotOptions& o) -> std::string& { return o.key_file; }),
      text("--base", "BASE", "what it drives on: tcp:ADDRESS:PORT or a serial device; default the hub's simulated wheels",
           [](RobotOptions& o) -> std::string& { return o.base; }),
      text("--algorithm", "NAME", "default convoy", [](RobotOptions& o) -> std::string& { return o.algorithm; }),
      text("--reading", "NAME", "corrected, the default, or literal", [](RobotOptions& o) -> std::string& { return o.setup.reading; }),
      real("--scale", "on the lengths of the parameters, default 1", 1e-3, 1e3, [](RobotOptions& o) -> double& { return o.setup.scale; }),
      real("--range", "C, how far the radio reaches, m; default 2", 1e-3, 1e4,
           [](RobotOptions& o) -> float& { return o.setup.platform.communication_range_m; }),
      real("--tick", "control period, s; default 0.1", 1e-3, 10.0, [](RobotOptions& o) -> float& { return o.setup.platform.tick_s; }),
      real("--wheel-limit", "largest speed of a wheel, m/s; default 0.2", 1e-4, 100.0,
           [](RobotOptions& o) -> float& { return o.setup.platform.wheel_limit_m_s; }),
      real("--wheel-distance", "between the wheels, m; default 0.1054", 1e-4, 100.0,
           [](RobotOptions& o) -> float& { return o.setup.platform.wheel_distance_m; }),
      real("--arrival", "how near to a target is there, m; default 0.2", 1e-4, 1e3, [](RobotOptions& o) -> double& { return o.setup.arrival_distance_m; }),
      flag("--holonomic", "it can move sideways", [](const RobotOptions& o) { return o.setup.platform.drive == Drive::holonomic; },
           [](RobotOptions& o) { o.setup.platform.drive = Drive::holonomic; }),
      flag("--no-line-of-sight", "the radio goes through bodies", [](const RobotOptions& o) { return !o.setup.platform.line_of_sight; },
           [](RobotOptions& o) { o.setup.platform.line_of_sight = false; }),
      {"--set", "KEY=VALUE", "a parameter of the algorithm, such as safe_range_m=1.7; may be repeated", set_parameter, parameters_of},
      real("--stop-after", "it stands still without a word from the hub, or with --peers from its base, for so long, s; default 0.5", 0.05, 3600.0,
           [](RobotOptions& o) -> double& { return o.stop_after_s; }),
      real("--delay", "from a measurement of the tracker to its arrival, s; matters with --base; default 0", 0.0, 1.0,
           [](RobotOptions& o) -> double& { return o.delay_s; }),
      real("--speed", "of its clock, default 1; for tests", 1e-2, 1e3, [](RobotOptions& o) -> double& { return o.speed; }),
  };
  return list;
}

}  // namespace

std::string robot_usage() {
  std::string usage = "banyan-robot: one robot of a fleet (docs/robots.md)\n\n";
  for (const Option& option : options()) {
    std::string line = std::string("  ") + option.name + " " + option.form;
    line.resize(std::max<std::size_t>(line.size() + 1, 26), ' ');
    usage += line + option.meaning + "\n";
  }
  return usage;
}

namespace {

void check_who_guides(const RobotOptions& options) {
  if (options.hub.empty() && options.peers.empty()) throw OptionError("--hub or --peers is missing");
  if (!options.hub.empty() && !options.peers.empty()) throw OptionError("--hub and --peers exclude each other");
  if (options.peers.empty()) {
    if (!options.listen.empty() || options.root || options.worker) throw OptionError("--listen, --root and --worker need --peers: the hub says how robots begin");
    return;
  }
  if (options.base.empty()) throw OptionError("--peers needs --base, which measures where other robots are");
  if (options.listen.empty()) throw OptionError("--peers needs --listen");
}

}  // namespace

RobotOptions parse_robot_options(std::span<const std::string> arguments) {
  RobotOptions parsed;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const Option* chosen = nullptr;
    for (const Option& option : options())
      if (arguments[k] == option.name) chosen = &option;
    if (chosen == nullptr) throw OptionError("\"" + arguments[k] + "\" is unknown; see --help");
    const bool takes_value = *chosen->form != '\0';
    if (takes_value && k + 1 == arguments.size()) throw OptionError(arguments[k] + " needs a value");
    try {
      chosen->read(parsed, takes_value ? arguments[++k] : "");
    } catch (const OptionError& error) {
      throw OptionError(std::string(chosen->name) + " " + error.what());
    }
  }
  if (parsed.id == nobody) throw OptionError("--id is missing");
  check_who_guides(parsed);
  if (parsed.key_file.empty()) throw OptionError("--key is missing");
  return parsed;
}

std::vector<std::string> to_arguments(const RobotOptions& wanted) {
  std::vector<std::string> arguments;
  for (const Option& option : options()) {
    for (const std::string& value : option.write(wanted)) {
      arguments.emplace_back(option.name);
      if (*option.form != '\0') arguments.push_back(value);
    }
  }
  return arguments;
}

}  // namespace banyan::udp
