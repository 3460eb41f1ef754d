// SPDX-License-Identifier: MIT
// Recordings and frames as arrays and pictures.
#include "banyan/record/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "banyan/record/json.hpp"
#include "frame_binding.hpp"

namespace banyan::python {
namespace {

// Options of a picture by the names that they have in DrawOptions.
record::PictureOptions look_of(const py::kwargs& told) {
  record::PictureOptions look;
  look.width_px = 640.0;
  for (const auto& [name, value] : told) {
    const auto key = name.cast<std::string>();
    if (key == "width") look.width_px = value.cast<double>();
    else if (key == "height") look.height_px = value.cast<double>();
    else if (key == "trail_s") look.trail_s = value.cast<double>();
    else if (key == "links") look.links = value.cast<bool>();
    else if (key == "blocked") look.blocked_links = value.cast<bool>();
    else if (key == "ids") look.ids = value.cast<bool>();
    else if (key == "legend") look.legend = value.cast<bool>();
    else if (key == "dark") look.dark = value.cast<bool>();
    else
      throw py::type_error("a picture has no option \"" + key +
                           "\"; it has width, height, trail_s, links, blocked, ids, legend, dark");
  }
  if (!(look.width_px >= 200.0 && look.width_px <= 20000.0)) throw py::value_error("width: allowed are 200 to 20000");
  if (look.height_px != 0.0 && !(look.height_px >= 150.0 && look.height_px <= 20000.0))
    throw py::value_error("height: allowed are 0 and 150 to 20000");
  if (!(look.trail_s >= 0.0 && std::isfinite(look.trail_s))) throw py::value_error("trail_s: must not be negative");
  return look;
}

py::dict arrays_of_frame(const record::Frame& frame) {
  std::vector<double> packed;
  record::pack(frame, packed);
  const std::size_t robots = frame.robots.size();
  py::dict columns;
  std::size_t c = 0;
  for (const record::FrameColumn& column : record::frame_columns()) {
    const auto* const first = packed.data() + robots * c++;
    columns[py::str(std::string(column.name))] = py::array_t<double>(static_cast<py::ssize_t>(robots), first);
  }
  return columns;
}

// All frames, frame by frame. Robots that have not joined yet are nowhere, and not alive.
struct Film {
  std::vector<double> time_s, positions, headings, targets;
  std::vector<std::int64_t> ticks;
  std::vector<std::uint8_t> roles, alive;
  std::vector<std::int32_t> parents, old_parents, serves;
  std::vector<std::size_t> counts;  // of robots, by frame
  std::size_t robots = 0, target_count = 0;

  void add(const record::Frame& frame) {
    counts.push_back(frame.robots.size());
    robots = std::max(robots, frame.robots.size());
    time_s.push_back(frame.time_s);
    ticks.push_back(static_cast<std::int64_t>(frame.tick));
    for (const record::RobotFrame& robot : frame.robots) {
      positions.insert(positions.end(), {robot.position.x, robot.position.y});
      headings.push_back(robot.heading_rad);
      roles.push_back(static_cast<std::uint8_t>(robot.role));
      alive.push_back(robot.alive ? 1 : 0);
      parents.push_back(robot.parent);
      old_parents.push_back(robot.old_parent);
      serves.push_back(robot.target);
    }
  }

  // So that each frame has `robots` of them, with `per_robot` values.
  template <class T>
  [[nodiscard]] std::vector<T> whole(std::vector<T> values, T absent, std::size_t per_robot = 1) const {
    if (values.size() == counts.size() * robots * per_robot) return values;
    std::vector<T> all;
    all.reserve(counts.size() * robots * per_robot);
    auto from = values.begin();
    for (const std::size_t count : counts) {
      const auto to = from + static_cast<std::ptrdiff_t>(count * per_robot);
      all.insert(all.end(), from, to);
      all.insert(all.end(), (robots - count) * per_robot, absent);
      from = to;
    }
    return all;
  }
};

py::dict arrays_of_recording(record::Recording& recording, std::size_t every) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  Film film;
  CtrlC interrupt;  // other threads wait: a recording is for one at a time
  recording.for_each(
      [&](const record::Frame& frame) {
        film.add(frame);
        interrupt.check();
        return true;
      },
      0.0, std::numeric_limits<double>::infinity(), every);
  const auto frames = static_cast<py::ssize_t>(film.time_s.size());
  const auto robots = static_cast<py::ssize_t>(film.robots);
  py::dict arrays;
  arrays["time_s"] = taken(std::move(film.time_s), {frames});
  arrays["tick"] = taken(std::move(film.ticks), {frames});
  arrays["positions"] = taken(film.whole(std::move(film.positions), nowhere, 2), {frames, robots, 2});
  arrays["headings_rad"] = taken(film.whole(std::move(film.headings), nowhere), {frames, robots});
  arrays["roles"] = taken(film.whole(std::move(film.roles), std::uint8_t{0}), {frames, robots});
  arrays["alive"] = taken(film.whole(std::move(film.alive), std::uint8_t{0}), {frames, robots}).attr("view")("bool");
  arrays["parents"] = taken(film.whole(std::move(film.parents), std::int32_t{-1}), {frames, robots});
  arrays["old_parents"] = taken(film.whole(std::move(film.old_parents), std::int32_t{-1}), {frames, robots});
  arrays["serves"] = taken(film.whole(std::move(film.serves), std::int32_t{-1}), {frames, robots});
  return arrays;
}

py::list events_of(record::Recording& recording) {
  py::list list;
  for (const record::RecordedEvent& event : recording.events()) {
    py::dict row;
    row["time_s"] = event.time_s;
    row["tick"] = event.tick;
    row["kind"] = event.kind;
    row["robot"] = event.robot;
    row["target"] = event.target;
    row["text"] = event.text;
    list.append(row);
  }
  return list;
}

// With the trails up to there.
PyFrame frame_at(record::Recording& recording, double time_s, double trail_s) {
  record::TrailLog log(trail_s);
  PyFrame found{recording.setting_at(time_s), recording.frame_at(time_s), {}};
  recording.for_each(
      [&](const record::Frame& frame) {
        log.add(frame);
        return true;
      },
      time_s - trail_s, time_s);
  found.trails = log.trails(found.frame);
  return found;
}

void bind_frame(py::module_& m) {
  py::class_<PyFrame>(m, "Frame")
      .def_property_readonly("time_s", [](const PyFrame& f) { return f.frame.time_s; })
      .def_property_readonly("tick", [](const PyFrame& f) { return f.frame.tick; })
      .def("columns", [](const PyFrame& f) { return arrays_of_frame(f.frame); })
      .def("svg", &svg_of)
      .def("_repr_svg_", [](const PyFrame& f) { return svg_of(f, py::kwargs{}); })
      .def("__repr__", [](const PyFrame& f) {
        return "<banyan.Frame: " + std::to_string(f.frame.robots.size()) + " robots of " + f.setting.name + " at " +
               config::number_text(f.frame.time_s) + " s>";
      });
}

}  // namespace

std::string svg_of(const PyFrame& frame, const py::kwargs& look) {
  return record::draw_svg(frame.setting, frame.frame, frame.trails, look_of(look));
}

void bind_recording(py::module_& m) {
  bind_frame(m);
  py::class_<record::Recording>(m, "Recording")
      .def(py::init<const std::string&>(), py::arg("path"))
      .def_property_readonly("path", &record::Recording::path)
      .def_property_readonly("warnings", &record::Recording::warnings)
      .def_property_readonly("config_json", [](const record::Recording& r) { return r.provenance().config_json; })
      .def_property_readonly("version", [](const record::Recording& r) { return r.provenance().version; })
      .def_property_readonly("git", [](const record::Recording& r) { return r.provenance().git; })
      .def_property_readonly("seed", [](const record::Recording& r) { return r.provenance().seed; })
      .def_property_readonly("result_text", &record::Recording::result)
      .def_property_readonly("start_s", &record::Recording::start_s)
      .def_property_readonly("end_s", &record::Recording::end_s)
      .def("__len__", &record::Recording::frames)
      .def("arrays", &arrays_of_recording, py::arg("every") = 1)
      .def("series", [](record::Recording& r) { return table_of(r.metrics()); })
      .def("events", &events_of)
      .def("frame_at", &frame_at, py::arg("time_s"), py::arg("trail_s") = 10.0);
}

}  // namespace banyan::python
