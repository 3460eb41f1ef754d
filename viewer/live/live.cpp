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
#include "banyan/record/recording.hpp"
#include "banyan/version.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"

namespace banyan::viewer {
namespace {

std::vector<std::string> in_words(const std::vector<config::Problem>& problems) {
  std::vector<std::string> lines;
  lines.reserve(problems.size());
  for (const config::Problem& problem : problems) lines.push_back(to_string(problem));
  return lines;
}

// The world and what watches it, as `banyan run` has them. The same for playing, for going back and
// for recording.
struct Play {
  explicit Play(const world::Scenario& scenario) : world(scenario), observer(world) {
    measure::Observer before(world);  // the run's own counts ticks, and the start is none
    last = before.observe(world, measure::is_plotted(world));
  }
  void step() {
    world.step(executor);
    last = observer.observe(world, measure::is_plotted(world));
  }

  world::World world;
  measure::Observer observer;
  measure::Tick last;
  world::Executor executor{1};
};

struct Intervention {
  std::uint64_t tick;
  world::Event event;
};

// Steps up to `tick`, each intervention at its own.
template <class EachTick>
void replay(Play& play, const std::vector<Intervention>& interventions, std::uint64_t tick, const EachTick& each_tick) {
  auto next = interventions.begin();
  const auto intervene = [&] {
    for (; next != interventions.end() && next->tick == play.world.tick(); ++next) play.world.intervene(next->event);
  };
  for (intervene(); play.world.tick() < tick; intervene()) {
    play.step();
    each_tick();
  }
}

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
    play.emplace(configuration.scenario);
    watcher = {};
    events.clear();
    finished_at.reset();
    setting = record::setting_of(play->world);
    ++setting_version;
    watch();
  }
  void watch() {
    packed.clear();
    if (!finished_at && play->observer.finished()) finished_at = play->world.tick();
    capture(play->world, frame);
    watch_setting();
    for (const record::RecordedEvent& event : watcher.watch(setting, frame, play->last)) events.push_back(event);
  }
  void watch_setting() {
    if (still_holds(setting, play->world)) return;
    setting = record::setting_of(play->world);
    ++setting_version;
  }
  // As loaded, with what the visitor did as events.
  [[nodiscard]] config::Configuration current() const {
    config::Configuration result = configuration;
    result.scenario.events = play->world.scenario().events;
    return result;
  }

  config::Configuration configuration;  // as loaded, without interventions
  std::optional<Play> play;
  std::vector<Intervention> interventions;
  record::EventWatcher watcher;
  std::vector<record::RecordedEvent> events;  // not taken yet
  record::Setting setting;
  std::uint64_t setting_version = 0;
  record::Frame frame;                       // of the head
  std::vector<double> packed;                // the same; empty until somebody asks
  std::optional<std::uint64_t> finished_at;  // tick
};

Live::Live() = default;
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
  config::Loaded loaded = config::parse_configuration(name, text, changes);
  std::vector<std::string> lines = in_words(loaded.problems);
  if (!loaded.ok()) return lines;
  try {
    run_ = std::make_unique<Run>(std::move(loaded.configuration));
  } catch (const std::exception& e) { lines.push_back(name + ": error: " + e.what()); }
  return lines;
}

void Live::step(std::size_t ticks) {
  Run& r = run();
  for (; ticks > 0; --ticks) {
    r.play->step();
    r.watch();
  }
}

std::uint64_t Live::tick() const { return run().play->world.tick(); }
double Live::time_s() const { return run().play->world.time_s(); }
bool Live::finished() const { return run().finished_at.has_value(); }
bool Live::complete() const { return run().play->observer.run().complete; }

void Live::rewind(std::uint64_t tick) {
  Run& r = run();
  if (tick > r.play->world.tick()) throw std::invalid_argument("there is no tick " + std::to_string(tick) + " yet");
  if (tick == r.play->world.tick()) return;
  std::erase_if(r.interventions, [tick](const Intervention& i) { return i.tick >= tick; });
  r.begin();
  replay(*r.play, r.interventions, tick, [&r] { r.watch(); });
  r.events.clear();
}

namespace {

// The configuration with one more event, read as strictly as from a file.
config::Loaded with_event(const config::Configuration& current, double now_s, config::Node event) {
  const auto place = event.place;
  event.table()->push_back({"time_s", config::Node{now_s, place}});
  config::Node root = config::parse_document("intervention", config_json(current));
  if (root.find("events") == nullptr) root.table()->push_back({"events", config::Node{config::Node::Array{}, place}});
  root.find("events")->array()->push_back(std::move(event));
  return configure(std::move(root), current.scenario.name);
}

// "loss: is 3; allowed: 0 to 1" instead of "intervention:1: error: events[4].loss: is 3; ...".
std::string about_event(const std::string& key, const std::string& text, std::size_t index) {
  const std::string path = "events[" + std::to_string(index) + "]";
  std::string line = key.empty() || key == path ? text : key + ": " + text;
  for (auto at = line.find(path + "."); at != std::string::npos; at = line.find(path + ".", at))
    line.erase(at, path.size() + 1);
  return line;
}

// What is wrong with a text that is no table at all.
std::string about_text(std::string text) {
  constexpr std::string_view scenario = "a scenario is";
  if (text.starts_with(scenario)) text.replace(0, scenario.size(), "an intervention is");
  return text;
}

}  // namespace

std::vector<std::string> Live::intervene(std::string_view event_json) {
  Run& r = run();
  world::World& world = r.play->world;
  const std::size_t index = world.scenario().events.size();
  std::vector<std::string> lines;
  try {
    config::Node event = config::parse_document("intervention.json", event_json);
    for (const std::string_view key : {"time_s", "when"})
      if (event.find(key) != nullptr) lines.push_back(std::string(key) + ": what a visitor does happens now");
    if (!lines.empty()) return lines;
    const config::Loaded loaded = with_event(r.current(), world.time_s(), std::move(event));
    for (const config::Problem& problem : loaded.problems)
      if (!problem.warning) lines.push_back(about_event(problem.key, problem.text, index));
    if (!lines.empty()) return lines;
    const world::Event& happens = loaded.configuration.scenario.events.back();
    for (const world::Fault& fault : world.faults_now(happens))
      lines.push_back(about_event(fault.key, fault.text, index));
    if (!lines.empty()) return lines;
    world.intervene(happens);
    r.interventions.push_back({world.tick(), happens});
  } catch (const config::DocumentError& e) { lines.push_back(about_text(e.problem.text)); }
  return lines;
}

std::span<const double> Live::frame() {
  Run& r = run();
  if (r.packed.empty()) record::pack(r.frame, r.packed);
  return r.packed;
}

std::size_t Live::robots() const { return run().frame.robots.size(); }

std::vector<std::string> Live::columns() {
  std::vector<std::string> names;
  for (const record::FrameColumn& column : record::frame_columns()) names.emplace_back(column.name);
  return names;
}

std::string Live::targets_json() const { return record::targets_json(run().frame); }
std::string Live::setting_json() const { return record::setting_json(run().setting); }
std::uint64_t Live::setting_version() const { return run().setting_version; }
std::string Live::metrics_json() const { return record::metrics_json(run().play->last); }

std::string Live::take_events_json() {
  std::string text = "[";
  for (const record::RecordedEvent& event : run().events)
    text += (text.size() > 1 ? "," : "") + record::event_json(event);
  run().events.clear();
  return text + "]";
}

std::string Live::message_json(std::size_t robot) const {
  const world::World& world = run().play->world;
  if (world.tick() == 0 || robot >= world.size()) return "null";
  return record::message_json(world.swarm(), robot);
}

std::string Live::hash() const {
  std::array<char, 17> text;
  const auto hash = static_cast<unsigned long long>(run().play->world.hash());
  static_cast<void>(std::snprintf(text.data(), text.size(), "%016llx", hash));
  return text.data();
}

std::string Live::result_json() const {
  const Play& play = *run().play;
  return record::result_json(play.observer.result(play.world));
}

std::uint64_t Live::seed() const { return run().configuration.scenario.seed; }
std::string Live::name() const { return run().configuration.scenario.name; }
std::string Live::config_json() const { return config::config_json(run().current()); }

std::string Live::scenario_toml() const {
  const Run& r = run();
  config::Configuration now = r.current();
  if (r.finished_at && *r.finished_at < r.play->world.tick()) {
    now.scenario.mission.stop_when_complete = false;
    now.scenario.mission.time_limit_s = r.play->world.time_s();
  }
  return config::config_toml(now);
}

std::string Live::recording() const {
  const Run& r = run();
  Play again(r.configuration.scenario);
  const TemporaryFile file;
  record::RecorderOptions options;
  options.every_ticks = r.configuration.output.record_every;
  options.messages = r.configuration.output.messages;
  options.existing = record::Existing::replace;
  record::Recorder recorder(file.path(), {config_json(), version(), git(), seed()}, options);
  recorder.frame(again.world, again.last);
  replay(again, r.interventions, r.play->world.tick(), [&] { recorder.frame(again.world, again.last); });
  recorder.finish(again.observer.result(again.world), !finished());
  return file.content();
}

std::string Live::version() { return std::string(banyan::version); }
std::string Live::git() { return std::string(git_id()); }

}  // namespace banyan::viewer
