// SPDX-License-Identifier: MIT
#include "live.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include "banyan/config/config.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/record/events.hpp"
#include "banyan/record/json.hpp"
#include "banyan/record/outputs.hpp"
#include "banyan/record/simulation.hpp"
#include "banyan/version.hpp"

namespace banyan::viewer {
namespace {

std::vector<std::string> in_words(const std::vector<config::Problem>& problems) {
  std::vector<std::string> lines;
  lines.reserve(problems.size());
  for (const config::Problem& problem : problems) lines.push_back(to_string(problem));
  return lines;
}

struct Intervention {
  std::uint64_t tick;
  world::Event event;
};

// Steps up to `tick`, each intervention at its own.
template <class Step>
void replay(record::Simulation& simulation, const std::vector<Intervention>& interventions, std::uint64_t tick,
            const Step& step) {
  auto next = interventions.begin();
  const auto intervene = [&] {
    for (; next != interventions.end() && next->tick == simulation.world().tick(); ++next)
      simulation.intervene(next->event);
  };
  for (intervene(); simulation.world().tick() < tick; intervene()) step();
}

// The last tick simulated, in the terms of a recording, and the events up to it.
struct Head final : record::Sink {
  void start(const world::World& world) override {
    watcher = {};
    events.clear();
    setting = record::setting_of(world);
    ++setting_version;
    look(world, measure::at_start(world, measure::is_plotted(world)));
  }
  void tick(const world::World& world, const measure::Tick& observed) override { look(world, observed); }
  [[nodiscard]] bool wants_fiedler(const world::World& world) const override { return measure::is_plotted(world); }

  void look(const world::World& world, const measure::Tick& observed) {
    metrics = observed;
    packed.clear();
    capture(world, frame);
    if (!still_holds(setting, world)) {
      setting = record::setting_of(world);
      ++setting_version;
    }
    for (const record::RecordedEvent& event : watcher.watch(setting, frame, metrics)) events.push_back(event);
  }

  measure::Tick metrics;
  record::Frame frame;
  std::vector<double> packed;  // the same; empty until requested
  record::Setting setting;
  std::uint64_t setting_version = 0;
  record::EventWatcher watcher;
  std::vector<record::RecordedEvent> events;  // not taken yet
};

// A file of this process, gone with this object; in memory, where this runs in a browser.
class TemporaryFile {
 public:
  TemporaryFile() {
    const int descriptor = ::mkstemp(path_.data());
    if (descriptor < 0) throw record::FileError(path_, "cannot create", errno);
    ::close(descriptor);
  }
  ~TemporaryFile() {
    ::unlink(path_.c_str());
    ::unlink((path_ + ".part").c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string content() const {
    const record::InputFile in(path_);
    std::string bytes;
    if (!in.read(0, in.size(), bytes)) throw record::FileError(path_, "has become shorter");
    return bytes;
  }

 private:
  std::string path_ = "/tmp/banyan-live-XXXXXX";
};

}  // namespace

struct Live::Run {
  explicit Run(config::Configuration from) : configuration(std::move(from)) { begin(); }

  void begin() {
    finished_at.reset();
    simulation.emplace(world::World(configuration.scenario), head);
    note_end();
  }
  void step(world::Executor& executor) {
    simulation->step(executor);
    note_end();
  }
  void note_end() {
    if (!finished_at && simulation->finished()) finished_at = world().tick();
  }
  [[nodiscard]] const world::World& world() const { return simulation->world(); }
  // As loaded, with what the visitor did as events.
  [[nodiscard]] config::Configuration current() const {
    config::Configuration result = configuration;
    result.scenario.events = world().scenario().events;
    return result;
  }

  config::Configuration configuration;  // as loaded, without interventions
  std::vector<Intervention> interventions;
  Head head;
  std::optional<record::Simulation> simulation;
  std::optional<std::uint64_t> finished_at;  // tick
};

Live::Live(const AlgorithmList& algorithms)
    : algorithms_(algorithms), executor_(std::make_unique<world::Executor>(1)) {}
Live::~Live() = default;

Live::Run& Live::run() const {
  if (!run_) throw std::logic_error("no scenario is loaded");
  return *run_;
}

std::vector<std::string> Live::load(const std::string& name, std::string_view text,
                                    const std::vector<std::string>& overrides) {
  run_.reset();
  std::vector<config::Override> changes;
  changes.reserve(overrides.size());
  for (const std::string& change : overrides) changes.push_back({change, "--set " + change});
  config::Loaded loaded = config::parse_configuration(name, text, algorithms_, changes);
  std::vector<std::string> lines = in_words(loaded.problems);
  if (!loaded.ok()) return lines;
  try {
    run_ = std::make_unique<Run>(std::move(loaded.configuration));
  } catch (const std::exception& e) { lines.push_back(name + ": error: " + e.what()); }
  return lines;
}

void Live::use_threads(int threads) {
  executor_.reset();  // ends the last team: threads may be few
  executor_ = std::make_unique<world::Executor>(threads);
}

void Live::step(std::size_t ticks) {
  Run& r = run();
  for (; ticks > 0; --ticks) r.step(*executor_);
}

std::uint64_t Live::tick() const { return run().world().tick(); }
double Live::time_s() const { return run().world().time_s(); }
bool Live::finished() const { return run().finished_at.has_value(); }
bool Live::complete() const { return run().simulation->run().complete; }

void Live::rewind(std::uint64_t tick) {
  Run& r = run();
  if (tick > r.world().tick()) throw std::invalid_argument("there is no tick " + std::to_string(tick) + " yet");
  if (tick == r.world().tick()) return;
  std::erase_if(r.interventions, [tick](const Intervention& i) { return i.tick >= tick; });
  r.begin();
  replay(*r.simulation, r.interventions, tick, [&] { r.step(*executor_); });
  r.head.events.clear();
}

namespace {

// "loss: is 3; allowed: 0 to 1" instead of "intervention:1: error: events[4].loss: is 3; ...".
std::string about_event(const std::string& key, const std::string& text, std::size_t index) {
  const std::string path = "events[" + std::to_string(index) + "]";
  std::string line = key.empty() || key == path ? text : key + ": " + text;
  for (auto at = line.find(path + "."); at != std::string::npos; at = line.find(path + ".", at))
    line.erase(at, path.size() + 1);
  return line;
}

// The problems of a text that is not a table at all.
std::string about_text(std::string text) {
  constexpr std::string_view scenario = "a scenario is";
  if (text.starts_with(scenario)) text.replace(0, scenario.size(), "an intervention is");
  return text;
}

}  // namespace

std::vector<std::string> Live::intervene(std::string_view event_json) {
  Run& r = run();
  const world::World& world = r.world();
  const std::size_t index = world.scenario().events.size();
  std::vector<std::string> lines;
  try {
    config::Node event = config::parse_document("intervention.json", event_json);
    for (const std::string_view key : {"time_s", "when"})
      if (event.find(key) != nullptr) lines.push_back(std::string(key) + ": what a visitor does happens now");
    if (!lines.empty()) return lines;
    const config::Loaded loaded = config::with_event(r.current(), world.time_s(), std::move(event));
    for (const config::Problem& problem : loaded.problems)
      if (!problem.warning) lines.push_back(about_event(problem.key, problem.text, index));
    if (!lines.empty()) return lines;
    const world::Event& happens = loaded.configuration.scenario.events.back();
    for (const world::Fault& fault : world.faults_now(happens))
      lines.push_back(about_event(fault.key, fault.text, index));
    if (!lines.empty()) return lines;
    r.simulation->intervene(happens);
    r.interventions.push_back({world.tick(), happens});
  } catch (const config::DocumentError& e) { lines.push_back(about_text(e.problem.text)); }
  return lines;
}

std::span<const double> Live::frame() {
  Head& head = run().head;
  if (head.packed.empty()) record::pack(head.frame, head.packed);
  return head.packed;
}

std::size_t Live::robots() const { return run().head.frame.robots.size(); }

std::vector<std::string> Live::columns() {
  std::vector<std::string> names;
  for (const record::FrameColumn& column : record::frame_columns()) names.emplace_back(column.name);
  return names;
}

std::string Live::targets_json() const { return record::targets_json(run().head.frame); }
std::string Live::setting_json() const { return record::setting_json(run().head.setting); }
std::uint64_t Live::setting_version() const { return run().head.setting_version; }
std::string Live::metrics_json() const { return record::metrics_json(run().head.metrics); }

std::string Live::take_events_json() {
  std::string text = "[";
  std::vector<record::RecordedEvent>& events = run().head.events;
  for (const record::RecordedEvent& event : events) text += (text.size() > 1 ? "," : "") + record::event_json(event);
  events.clear();
  return text + "]";
}

std::string Live::message_json(std::size_t robot) const {
  const world::World& world = run().world();
  if (world.tick() == 0 || robot >= world.size()) return "null";
  return record::message_json(world.swarm(), robot);
}

std::string Live::hash() const {
  std::array<char, 17> text;
  const auto hash = static_cast<unsigned long long>(run().world().hash());
  static_cast<void>(std::snprintf(text.data(), text.size(), "%016llx", hash));
  return text.data();
}

std::string Live::result_json() const { return record::result_json(run().simulation->result()); }

std::uint64_t Live::seed() const { return run().configuration.scenario.seed; }
std::string Live::name() const { return run().configuration.scenario.name; }
std::string Live::config_json() const { return config::config_json(run().current()); }

std::string Live::scenario_toml() const {
  const Run& r = run();
  config::Configuration now = r.current();
  if (r.finished_at && *r.finished_at < r.world().tick()) {
    now.scenario.mission.stop_when_complete = false;
    now.scenario.mission.time_limit_s = r.world().time_s();
  }
  return config::config_toml(now);
}

std::string Live::recording() const {
  const Run& r = run();
  const TemporaryFile file;
  const auto recording = record::open_recording(
      file.path(), {{config_json(), version(), git(), seed()}, r.configuration.output, record::Existing::replace});
  record::Simulation again(world::World(r.configuration.scenario), *recording);
  replay(again, r.interventions, r.world().tick(), [&] { again.step(*executor_); });
  again.finish(!finished());
  return file.content();
}

std::string Live::version() { return std::string(banyan::version); }
std::string Live::git() { return std::string(git_id()); }

}  // namespace banyan::viewer
