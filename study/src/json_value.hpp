// SPDX-License-Identifier: MIT
// Values of JSON files: any program may have written them, and they may hold anything.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

namespace banyan::study {

// The value of that key if it is there and is a T: std::string, double (any number) or std::uint64_t.
template <class T, class Json> [[nodiscard]] std::optional<T> value_in(const Json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end()) return std::nullopt;
  bool fits = false;
  if constexpr (std::is_same_v<T, std::string>) fits = at->is_string();
  else if constexpr (std::is_same_v<T, double>) fits = at->is_number();
  else fits = at->is_number_unsigned();
  return fits ? std::optional<T>(at->template get<T>()) : std::nullopt;
}

}  // namespace banyan::study
