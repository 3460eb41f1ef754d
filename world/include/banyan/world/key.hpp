// SPDX-License-Identifier: MIT
// What a key of a configuration is: a name, a value of some struct behind it, and what the value may
// be and means. schema.hpp has the keys of a scenario. Knows no file format.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "banyan/controller/core/vec2.hpp"

namespace banyan::world {

using Names = std::span<const std::string_view>;
using NamePairs = std::vector<std::pair<std::string, std::string>>;

// The value of a key as users write it: names as text, angles in degrees. The first: there is none.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, BasicVec2<double>,
                           std::vector<BasicVec2<double>>, std::vector<double>, NamePairs>;
enum class Type : std::uint8_t { truth, whole, number, name, text, point, points, numbers, pairs };

struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool above = false;  // the minimum itself is not allowed
  // False for NaN and infinity.
  [[nodiscard]] bool holds(double x) const noexcept;
};
// "0 to 1", "above 0 m", "at least 1": what a range allows.
[[nodiscard]] std::string range_text(const Range& range, std::string_view unit);
// "is 1.5; allowed: 0 to 1"; nothing if it is allowed.
[[nodiscard]] std::optional<std::string> range_fault(double x, const Range& range, std::string_view unit);
// The same of a whole number, to the last digit: 2^53 + 1 has no double of its own.
[[nodiscard]] std::optional<std::string> whole_range_fault(std::int64_t n, const Range& range, std::string_view unit);
// "must be "a" or "b", not the text "bb"; did you mean "b"?"; nothing if it is one of them.
[[nodiscard]] std::optional<std::string> name_fault(std::string_view word, Names names);

// How to reach the value behind a key in an Owner. In radians, where it is an angle.
template <class Owner> struct Access {
  Type type;
  bool optional;                      // there may be no value
  Names (*names)(const Owner&);       // Type::name
  bool (*applies)(const Owner&);      // whether the owner has a place for the value
  Value (*get)(const Owner&);         // none where the key does not apply
  void (*set)(Owner&, const Value&);  // a value of the key's type, where the key applies
};

// What else is to be said of a key.
struct Terms {
  bool required = false;             // where it applies
  std::string_view otherwise = "";   // what holds without it, if that is not a value
  std::string_view not_beside = "";  // a key of the same section: one of the two
  std::string_view selector = "";    // the path of the key that decides whether it applies, if not its section's
  bool only_in_files = false;        // its range: a program may go beyond it
  std::optional<std::string> (*text_fault)(std::string_view) = nullptr;  // what is wrong with a text
};

template <class Owner> struct Key {
  std::string_view path;  // "radio.loss"; "events.loss" is events[0].loss, events[1].loss, ...
  Access<Owner> access;
  std::string_view unit;     // "m", "deg": angles are in degrees
  Range range;               // in this unit
  std::string_view meaning;  // a phrase
  Terms terms = {};

  [[nodiscard]] constexpr std::string_view section() const noexcept {
    const auto dot = path.rfind('.');
    return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
  }
  [[nodiscard]] constexpr std::string_view name() const noexcept { return path.substr(path.rfind('.') + 1); }
  [[nodiscard]] constexpr bool is_angle() const noexcept { return unit == "deg"; }
};

// The angle in degrees that becomes exactly this one in rad again, the shortest such decimal; the nearest
// if there is none.
[[nodiscard]] double exact_degrees(double rad);
[[nodiscard]] double radians(double degrees) noexcept;
[[nodiscard]] Value in_degrees(Value value);
[[nodiscard]] Value in_radians(Value value);

// The value as users write it; none if the key does not apply or nothing is given.
template <class Owner> [[nodiscard]] Value get(const Key<Owner>& key, const Owner& owner) {
  return key.is_angle() ? in_degrees(key.access.get(owner)) : key.access.get(owner);
}
// Of the key's type and where it applies; the caller checks everything else first.
template <class Owner> void set(const Key<Owner>& key, Owner& owner, Value value) {
  key.access.set(owner, key.is_angle() ? in_radians(std::move(value)) : std::move(value));
}

template <class Owner>
[[nodiscard]] const Key<Owner>* find_key(std::span<const Key<Owner>> keys, std::string_view path) noexcept {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key<Owner>& key) { return key.path == path; });
  return found == keys.end() ? nullptr : &*found;
}

// ---- From members to Access: of<&RadioModel::loss>, of<&Die::robot, &Freeze::robot> ----

// The names of an enum's values, in their order; specialised beside the keys.
template <class Enum> struct NamesOf;

// Where in an Owner its part of type Part is; null if it has another one there. Specialised for
// owners that consist of parts.
template <class Owner> struct Parts {
  template <class Part> static Part* find(Owner& owner) noexcept {
    static_assert(std::is_same_v<Part, Owner>);
    return &owner;
  }
};

// How a member of type T becomes a value and back. Here: an enum, or a variant whose alternatives
// have names; below, everything else.
template <class T> struct Conversion {
  static constexpr Type type = Type::name;
  static constexpr bool optional = false;
  static Names names() noexcept { return NamesOf<T>::list; }
  static Value get(const T& member) {
    std::size_t index = 0;
    if constexpr (std::is_enum_v<T>) index = static_cast<std::size_t>(member);
    else index = member.index();
    return index < names().size() ? std::string(names()[index]) : std::string();
  }
  static void set(T& member, const Value& value) {
    const auto index = static_cast<std::size_t>(
        std::find(names().begin(), names().end(), std::get<std::string>(value)) - names().begin());
    if constexpr (std::is_enum_v<T>) member = static_cast<T>(index);
    else choose(member, index, std::make_index_sequence<std::variant_size_v<T>>());
  }
  template <std::size_t... alternative>
  static void choose(T& member, std::size_t index, std::index_sequence<alternative...>) {
    static_cast<void>(((alternative == index && (member.template emplace<alternative>(), true)) || ...));
  }
};

template <class T, Type t> struct PlainConversion {
  static constexpr Type type = t;
  static constexpr bool optional = false;
  static Names names() noexcept { return {}; }
  static Value get(const T& member) { return member; }
  static void set(T& member, const Value& value) { member = std::get<T>(value); }
};
template <> struct Conversion<bool> : PlainConversion<bool, Type::truth> {};
template <> struct Conversion<double> : PlainConversion<double, Type::number> {};
template <> struct Conversion<std::string> : PlainConversion<std::string, Type::text> {};
template <> struct Conversion<BasicVec2<double>> : PlainConversion<BasicVec2<double>, Type::point> {};
template <>
struct Conversion<std::vector<BasicVec2<double>>> : PlainConversion<std::vector<BasicVec2<double>>, Type::points> {};
template <> struct Conversion<std::vector<double>> : PlainConversion<std::vector<double>, Type::numbers> {
  static constexpr bool optional = true;  // an empty list is none
  static Value get(const std::vector<double>& member) { return member.empty() ? Value() : Value(member); }
};
template <> struct Conversion<NamePairs> : PlainConversion<NamePairs, Type::pairs> {
  static constexpr bool optional = true;  // an empty list is none
  static Value get(const NamePairs& member) { return member.empty() ? Value() : Value(member); }
};
template <class T>
requires std::is_integral_v<T>
struct Conversion<T> : PlainConversion<std::int64_t, Type::whole> {
  static Value get(T member) noexcept { return static_cast<std::int64_t>(member); }
  static void set(T& member, const Value& value) { member = static_cast<T>(std::get<std::int64_t>(value)); }
};
template <class T> struct Conversion<std::optional<T>> : Conversion<T> {
  static constexpr bool optional = true;
  static Value get(const std::optional<T>& member) { return member ? Conversion<T>::get(*member) : Value(); }
  static void set(std::optional<T>& member, const Value& value) { Conversion<T>::set(member.emplace(), value); }
};

// `find` gives the member of an Owner, or null where the key does not apply.
template <class Owner, auto find> constexpr Access<Owner> access_by() {
  using T = std::remove_pointer_t<decltype(find(std::declval<Owner&>()))>;
  using C = Conversion<T>;
  return {C::type,
          C::optional,
          [](const Owner&) { return C::names(); },
          [](const Owner& owner) { return find(const_cast<Owner&>(owner)) != nullptr; },
          [](const Owner& owner) {
            const T* member = find(const_cast<Owner&>(owner));
            return member == nullptr ? Value() : C::get(*member);
          },
          [](Owner& owner, const Value& value) { C::set(*find(owner), value); }};
}

template <class Pointer> struct MemberPointer;
template <class Part_, class T_> struct MemberPointer<T_ Part_::*> {
  using Part = Part_;
  using T = T_;
};

template <auto first, auto... more> struct Of {
  using T = typename MemberPointer<decltype(first)>::T;
  // The member of the part that the owner has.
  template <class Owner> static T* find(Owner& owner) noexcept {
    T* found = nullptr;
    const auto look = [&](auto member) {
      auto* part = Parts<Owner>::template find<typename MemberPointer<decltype(member)>::Part>(owner);
      if (part != nullptr) found = &(part->*member);
    };
    look(first);
    (look(more), ...);
    return found;
  }
  // NOLINTNEXTLINE(google-explicit-constructor): a row of the table names the member, and it is for any owner
  template <class Owner> constexpr operator Access<Owner>() const { return access_by<Owner, &find<Owner>>(); }
};
template <auto first, auto... more> inline constexpr Of<first, more...> of{};

// The same for a function that finds the member.
template <auto function> struct By {
  // NOLINTNEXTLINE(google-explicit-constructor): a row of the table names the member, and it is for any owner
  template <class Owner> constexpr operator Access<Owner>() const { return access_by<Owner, function>(); }
};
template <auto function> inline constexpr By<function> by{};

// A text that is one of a few names, which the owner may know.
template <auto member, auto words> struct Word {
  // NOLINTNEXTLINE(google-explicit-constructor): a row of the table names the member, and it is for any owner
  template <class Owner> constexpr operator Access<Owner>() const {
    Access<Owner> access = of<member>;
    access.type = Type::name;
    access.names = words;
    return access;
  }
};
template <auto member, auto words> inline constexpr Word<member, words> word{};

}  // namespace banyan::world
