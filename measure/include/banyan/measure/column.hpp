// SPDX-License-Identifier: MIT
// What a metric says of itself: the columns of the tables of results. Whatever measures something lists them beside it.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace banyan::measure {

// A cell; monostate is "not available": an empty CSV field, null in JSON.
using Cell = std::variant<std::monostate, bool, std::uint64_t, double, std::string>;

template <class Row> struct Column {
  std::string_view name;  // snake_case, with its unit
  std::string_view meaning;
  int decimals;  // of a double
  Cell (*cell)(const Row&);
  std::string_view in_figures = {};  // what figures call it; "": its name without underscores
};

// A column of a larger row, of which the column's own is a part.
template <class Whole> struct ColumnIn {
  std::string_view name, meaning;
  int decimals;
  std::string_view in_figures;
  const void* of;
  Cell (*read)(const void* of, const Whole& whole);

  [[nodiscard]] Cell cell(const Whole& whole) const { return read(of, whole); }
};
// `of` is a Column or a ColumnIn, and outlives what is returned; `part` gives its row.
template <class Whole, auto part, class Of> ColumnIn<Whole> column_in(const Of& of) {
  return {
      of.name,     of.meaning,
      of.decimals, of.in_figures,
      &of,         [](const void* it, const Whole& whole) {
            return static_cast<const Of*>(it)->cell(part(whole)); }};
}

template <class Field> struct FieldOf;
template <class OfRow, class Value> struct FieldOf<Value OfRow::*> { using Row = OfRow; };
template <auto field> using RowWith = typename FieldOf<decltype(field)>::Row;

// The field of a row. What does not exist is negative there, and empty in a table.
template <auto field> Cell cell_of(const RowWith<field>& row) {
  using Value = std::remove_cvref_t<decltype(row.*field)>;
  if constexpr (std::same_as<Value, double>) return row.*field < 0.0 ? Cell{} : Cell{row.*field};
  else if constexpr (std::same_as<Value, bool> || std::same_as<Value, std::string>) return row.*field;
  else return std::uint64_t{row.*field};
}

// A count, a flag or a text.
template <auto field>
constexpr Column<RowWith<field>> column(std::string_view name, std::string_view meaning,
                                        std::string_view in_figures = {}) {
  return {name, meaning, 0, cell_of<field>, in_figures};
}
// A double: seconds, metres and means have four decimals, ratios six.
template <auto field>
constexpr Column<RowWith<field>> quantity(std::string_view name, std::string_view meaning,
                                          std::string_view in_figures = {}) {
  return {name, meaning, 4, cell_of<field>, in_figures};
}
template <auto field>
constexpr Column<RowWith<field>> ratio(std::string_view name, std::string_view meaning,
                                       std::string_view in_figures = {}) {
  return {name, meaning, 6, cell_of<field>, in_figures};
}

}  // namespace banyan::measure
