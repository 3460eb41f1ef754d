// SPDX-License-Identifier: MIT
#include "message_json.hpp"

#include <algorithm>

#include "banyan/record/frame.hpp"

namespace banyan::record {
namespace {

constexpr std::string_view elsewhere[] = {"role",   "phase",  "need",       "id",    "epoch",   "label",
                                          "depth",  "parent", "old_parent", "want",  "request",  // in the frame
                                          "root_x", "root_y", "task_x",     "task_y"};           // nowhere

// The name behind an enumerator's field; nothing for other fields.
std::string_view word(std::string_view field, double value) noexcept {
  if (field == "role") return name_of(static_cast<Role>(value));
  if (field == "phase") return name_of(static_cast<Phase>(value));
  if (field == "need") return name_of(static_cast<Need>(value));
  return {};
}

}  // namespace

void capture_messages(const Swarm& swarm, std::size_t robots, MessageNumbers& into) {
  into.fields = swarm.message_fields();
  into.numbers.resize(into.fields.size() * robots);
  const std::span<double> all(into.numbers);
  for (std::size_t i = 0; i < robots; ++i)
    swarm.message_numbers(i, all.subspan(i * into.fields.size(), into.fields.size()));
}

bool is_recorded(const FieldInfo& field) noexcept {
  return std::find(std::begin(elsewhere), std::end(elsewhere), field.name) == std::end(elsewhere);
}

void write_message(Text& out, const Swarm& swarm, std::size_t i) {
  const std::span<const FieldInfo> fields = swarm.message_fields();
  std::vector<double> numbers(fields.size());
  swarm.message_numbers(i, numbers);
  out.put('{');
  for (std::size_t f = 0; f < fields.size(); ++f) {
    out.json_string(fields[f].name);
    out.put(':');
    const std::string_view name = word(fields[f].name, numbers[f]);
    name.empty() ? out.shortest(numbers[f]) : out.json_string(name);
    out.put(',');
  }
  if (!fields.empty()) out.drop_last();
  out.put('}');
}

}  // namespace banyan::record
