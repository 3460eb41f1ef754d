// SPDX-License-Identifier: MIT
// Live's interface to JavaScript (live.d.ts): C++ texts become strings, faults become Error objects
// with their text, ticks become numbers. There is no logic here.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "live.hpp"

namespace {

using banyan::viewer::Live;
using emscripten::val;

// A C++ exception would reach JavaScript as a number, or as an object without a text.
template <class Call> auto in_words(const Call& call) -> decltype(call()) {
  std::string words;
  try {
    return call();
  } catch (const std::exception& e) { words = e.what(); }
  val::global("Error").new_(words).throw_();
  std::abort();  // throw_() does not return
}

// The same for a member function.
template <auto function> struct Door;
template <class Result, class... Arguments, Result (Live::*function)(Arguments...)> struct Door<function> {
  static Result call(Live& live, Arguments... arguments) {
    return in_words([&] { return (live.*function)(std::move(arguments)...); });
  }
};
template <class Result, class... Arguments, Result (Live::*function)(Arguments...) const> struct Door<function> {
  static Result call(const Live& live, Arguments... arguments) {
    return in_words([&] { return (live.*function)(std::move(arguments)...); });
  }
};
// 64 bits: JavaScript counts ticks in numbers.
template <std::uint64_t (Live::*function)() const> double number(const Live& live) {
  return in_words([&] { return static_cast<double>((live.*function)()); });
}

val lines(const std::vector<std::string>& list) {
  val array = val::array();
  for (const std::string& line : list) array.call<void>("push", line);
  return array;
}

val load(Live& live, const std::string& name, const std::string& text, const val& overrides) {
  return in_words([&] { return lines(live.load(name, text, emscripten::vecFromJSArray<std::string>(overrides))); });
}
val intervene(Live& live, const std::string& event_json) {
  return in_words([&] { return lines(live.intervene(event_json)); });
}
void use_threads(Live& live, int threads) {
  in_words([&] { live.use_threads(threads); });
}
void step(Live& live, double ticks) {
  in_words([&] { live.step(static_cast<std::size_t>(ticks)); });
}
void rewind_to(Live& live, double tick) {
  in_words([&] { live.rewind(static_cast<std::uint64_t>(tick)); });
}
double robots(const Live& live) {
  return in_words([&] { return static_cast<double>(live.robots()); });
}
std::string message_json(const Live& live, double robot) {
  return in_words([&] { return live.message_json(static_cast<std::size_t>(robot)); });
}
// Views into the module's memory, which may move when it grows: slice() makes them the caller's own.
val frame(Live& live) {
  return in_words([&] {
    const auto numbers = live.frame();
    return val(emscripten::typed_memory_view(numbers.size(), numbers.data())).call<val>("slice");
  });
}
val recording(const Live& live) {
  return in_words([&] {
    const std::string bytes = live.recording();
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    return val(emscripten::typed_memory_view(bytes.size(), data)).call<val>("slice");
  });
}
// The page has all algorithms.
Live* make() { return new Live(banyan::algorithms()); }  // the page deletes it
val columns() { return lines(Live::columns()); }
val algorithm_names() {
  std::vector<std::string> names;
  for (const std::string_view name : banyan::algorithms().names()) names.emplace_back(name);
  return lines(names);
}

}  // namespace

EMSCRIPTEN_BINDINGS(banyan_live) {
  emscripten::class_<Live>("Live")
      .constructor(&make, emscripten::allow_raw_pointers())
      .function("load", &load)
      .function("loaded", &Live::loaded)
      .function("useThreads", &use_threads)
      .function("step", &step)
      .function("tick", &number<&Live::tick>)
      .function("timeS", &Door<&Live::time_s>::call)
      .function("finished", &Door<&Live::finished>::call)
      .function("complete", &Door<&Live::complete>::call)
      .function("rewind", &rewind_to)
      .function("intervene", &intervene)
      .function("frame", &frame)
      .function("robots", &robots)
      .function("targetsJson", &Door<&Live::targets_json>::call)
      .function("settingJson", &Door<&Live::setting_json>::call)
      .function("settingVersion", &number<&Live::setting_version>)
      .function("metricsJson", &Door<&Live::metrics_json>::call)
      .function("takeEventsJson", &Door<&Live::take_events_json>::call)
      .function("messageJson", &message_json)
      .function("hash", &Door<&Live::hash>::call)
      .function("resultJson", &Door<&Live::result_json>::call)
      .function("seed", &number<&Live::seed>)
      .function("name", &Door<&Live::name>::call)
      .function("configJson", &Door<&Live::config_json>::call)
      .function("scenarioToml", &Door<&Live::scenario_toml>::call)
      .function("recording", &recording);
  emscripten::function("columns", &columns);
  emscripten::function("algorithms", &algorithm_names);
  emscripten::function("version", &Live::version);
  emscripten::function("git", &Live::git);
}
