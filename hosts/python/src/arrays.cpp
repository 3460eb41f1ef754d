// SPDX-License-Identifier: MIT
// From the house's values to numpy arrays and Python's objects.
#include <limits>

#include "binding.hpp"

namespace banyan::python {
namespace {

py::dtype dtype_of(Item item) {
  switch (item) {
    case Item::flag: return py::dtype::of<bool>();
    case Item::byte: return py::dtype::of<std::uint8_t>();
    case Item::small: return py::dtype::of<std::int8_t>();
    case Item::whole: return py::dtype::of<std::int32_t>();
    default: return py::dtype::of<float>();
  }
}

// A column of ticks: whole numbers stay whole, what is not available is NaN.
py::array column_of(const measure::Column<measure::Tick>& column, std::span<const measure::Tick> ticks) {
  const auto length = static_cast<py::ssize_t>(ticks.size());
  const record::Cell sample = column.cell(measure::Tick{});
  if (std::holds_alternative<bool>(sample)) {
    py::array_t<bool> values(length);
    for (py::ssize_t k = 0; k < length; ++k)
      values.mutable_at(k) = std::get<bool>(column.cell(ticks[static_cast<std::size_t>(k)]));
    return values;
  }
  if (std::holds_alternative<std::uint64_t>(sample)) {
    py::array_t<std::int64_t> values(length);
    for (py::ssize_t k = 0; k < length; ++k)
      values.mutable_at(k) =
          static_cast<std::int64_t>(std::get<std::uint64_t>(column.cell(ticks[static_cast<std::size_t>(k)])));
    return values;
  }
  py::array_t<double> values(length);
  for (py::ssize_t k = 0; k < length; ++k) {
    const record::Cell cell = column.cell(ticks[static_cast<std::size_t>(k)]);
    const double* const number = std::get_if<double>(&cell);
    values.mutable_at(k) = number != nullptr ? *number : std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

}  // namespace

py::array view_of(const py::dtype& type, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                  const void* data, const py::handle& owner, bool writeable) {
  py::array array(type, std::move(shape), std::move(strides), data, owner);
  if (!writeable) py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::dict arrays_of(const std::shared_ptr<Block>& block, bool always) {
  const py::capsule owner(new std::shared_ptr<Block>(block),
                          [](void* p) { delete static_cast<std::shared_ptr<Block>*>(p); });
  const Shape& shape = block->shape();
  py::dict arrays;
  for (const FieldInfoOf& info : fields()) {
    std::vector<py::ssize_t> lengths;
    if (always || block->swarms() > 1) lengths.push_back(static_cast<py::ssize_t>(block->swarms()));
    lengths.push_back(static_cast<py::ssize_t>(shape.robots));
    for (const FieldAxis axis : info.axes)
      if (axis != FieldAxis::none) lengths.push_back(static_cast<py::ssize_t>(length(axis, shape)));
    std::vector<py::ssize_t> strides(lengths.size());
    auto step = static_cast<py::ssize_t>(size_of(info.item));
    for (std::size_t k = lengths.size(); k-- > 0; step *= lengths[k]) strides[k] = step;
    arrays[info.name] = view_of(dtype_of(info.item), std::move(lengths), std::move(strides), block->data(info.field),
                                owner, info.decided);
  }
  return arrays;
}

py::object object_of(const record::Cell& cell) {
  if (const bool* const flag = std::get_if<bool>(&cell)) return py::bool_(*flag);
  if (const auto* const whole = std::get_if<std::uint64_t>(&cell)) return py::int_(*whole);
  if (const double* const real = std::get_if<double>(&cell)) return py::float_(*real);
  if (const auto* const text = std::get_if<std::string>(&cell)) return py::str(*text);
  return py::none();
}

py::dict table_of(std::span<const measure::Tick> ticks) {
  py::dict table;
  for (const auto& column : record::series_columns())
    table[py::str(std::string(column.name))] = column_of(column, ticks);
  return table;
}

}  // namespace banyan::python
