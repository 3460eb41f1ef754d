// SPDX-License-Identifier: MIT
// Every key of a scenario file, once: where it goes, what it may be, what it means. Reading,
// messages, `--set`, completion, the dump into outputs and docs/scenario-keys.md all follow from
// these tables. Keys of [mission.parameters] come from the controller's own parameter_table().
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "banyan/record/output_formats.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::config {

// What a file and the command line together stand for.
struct Configuration {
  world::Scenario scenario;
  record::Output output;
};

// A scenario in the terms of its file, where a variant is a selector key ("layout", "kind") and
// keys that have a meaning for some of its values only. Angles are in rad as in the scenario.
struct ObstacleForm {
  std::size_t kind = 0;  // disc, box, wall
  world::Vec2 center{}, size{}, from{}, to{};
  double radius_m = 0.0;
  double angle_rad = 0.0;
};
struct EventForm {
  std::size_t kind = 0;  // as Event::Kind
  double time_s = 0.0;
  std::size_t robot = 0;
  std::size_t target = 0;
  double loss = 0.0;
  double duration_s = 0.0;
  double speed_m_s = 0.0;
  bool line_of_sight = false;
  std::size_t obstacle = 0;
  world::Vec2 position{};
  std::size_t when = 0;  // as Event::When
  std::size_t of = 0;    // as Event::Of
  std::optional<double> share;
  std::optional<std::size_t> count;
  double every_s = 0.0;
};
struct Form {
  Configuration configuration;     // targets, obstacles and events are below instead
  std::size_t targets_layout = 1;  // list, ring, random
  std::vector<world::Vec2> target_positions;
  std::size_t target_count = 3;
  double target_radius_m = 3.0;
  double target_phase_rad = 0.0;
  world::Vec2 target_center{};
  std::vector<ObstacleForm> obstacles;
  std::vector<EventForm> events;
};
[[nodiscard]] Form to_form(const Configuration& configuration);
[[nodiscard]] Configuration to_configuration(const Form& form);

// A key whose value is one of a few names.
template <class Owner> struct ChoiceAccess {
  std::span<const std::string_view> (*names)();
  std::size_t (*get)(const Owner&);
  void (*set)(Owner&, std::size_t);
};

// A key with more bits than std::size_t has everywhere.
template <class Owner> struct SeedAccess {
  std::uint64_t& (*member)(Owner&);
};

// How to reach the member behind a key; the alternative is the key's type.
template <class Owner>
using Access =
    std::variant<bool& (*)(Owner&), double& (*)(Owner&), int& (*)(Owner&), std::uint32_t& (*)(Owner&),
                 std::size_t& (*)(Owner&), std::optional<std::size_t>& (*)(Owner&), std::optional<double>& (*)(Owner&),
                 std::string& (*)(Owner&), world::Vec2& (*)(Owner&), std::vector<world::Vec2>& (*)(Owner&),
                 std::vector<double>& (*)(Owner&), ChoiceAccess<Owner>, SeedAccess<Owner>>;

struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool above = false;  // the minimum itself is not allowed
};

template <class Owner> struct Key {
  std::string_view section;  // "radio"; "" at the top
  std::string_view name;     // "loss"
  std::string_view unit;     // "m", "deg": angles are in degrees in files
  Range range;               // in the file's unit
  std::string_view meaning;  // a phrase
  Access<Owner> access;
  std::string_view when = "";      // values of the section's selector with which it has a meaning; "": all
  bool required = false;           // where it has a meaning
  std::string_view fallback = "";  // what holds without the key, where that is not the member's default
};

[[nodiscard]] std::span<const Key<Form>> scenario_keys() noexcept;
[[nodiscard]] std::span<const Key<ObstacleForm>> obstacle_keys() noexcept;
[[nodiscard]] std::span<const Key<EventForm>> event_keys() noexcept;

struct Section {
  std::string_view path;  // "swarm.start"
  std::string_view meaning;
  std::string_view selector = "";  // the key its other keys' `when` is about
};
[[nodiscard]] std::span<const Section> sections() noexcept;  // in the order of a file, arrays of tables included

// Parameters of the controller that other keys of a scenario decide; "" if it is none of them.
[[nodiscard]] std::string_view platform_key(std::string_view parameter) noexcept;

// Whether `name` is a word of `when`.
[[nodiscard]] bool applies(std::string_view when, std::string_view name) noexcept;

// "0 to 1", "above 0", "at least 1": what a range allows.
[[nodiscard]] std::string range_text(const Range& range, std::string_view unit);

// One row of the reference of keys, for completion and documents.
struct KeyRow {
  std::string path, type, allowed, fallback, meaning, when;
  std::vector<std::string> choices;
};
[[nodiscard]] std::vector<KeyRow> key_rows();
[[nodiscard]] std::string key_reference_markdown();

}  // namespace banyan::config
