// SPDX-License-Identifier: MIT
// A run that a visitor watches and interferes with: what the page's live source (src/source/) needs,
// without JavaScript, so that it can be tested natively. All results are in the terms of src/frame.ts
// and src/source/protocol.ts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace banyan {
class AlgorithmList;  // controller/core/algorithm.hpp
}
namespace banyan::world {
class Executor;  // threads.hpp
}

namespace banyan::viewer {

class Live {
 public:
  // What mission.algorithm chooses from; must outlive this.
  explicit Live(const AlgorithmList& algorithms);
  ~Live();
  Live(const Live&) = delete;
  Live& operator=(const Live&) = delete;

  // Replaces the run by that of a scenario: its file's name, which messages use, its text (TOML or
  // JSON) and "key=value" changes as with --set. Returns what is wrong, a line each, as the program
  // prints it ("a.toml:12: error: radio.loss: ..."); warnings are among them, so ask loaded(). If it
  // could not be loaded, there is no run.
  [[nodiscard]] std::vector<std::string> load(const std::string& name, std::string_view text,
                                              const std::vector<std::string>& overrides);
  [[nodiscard]] bool loaded() const { return run_ != nullptr; }

  // Steps are computed by so many threads from now on, and come out the same. Where there are none, it stays at one.
  void use_threads(int threads);

  // Everything below needs a run and throws std::logic_error without one.

  void step(std::size_t ticks = 1);          // also beyond the end of the mission
  [[nodiscard]] std::uint64_t tick() const;  // the head: the last tick there is, 0 at the start
  [[nodiscard]] double time_s() const;       // tick() x tick_s
  [[nodiscard]] bool finished() const;       // `banyan run` would have stopped here or earlier
  [[nodiscard]] bool complete() const;       // all targets have been held at once

  // Goes back to `tick` <= tick(): the run starts again with the interventions that acted before, and
  // what was done from then on is forgotten, interventions at `tick` itself included. Going back to
  // tick() changes nothing. Takes as long as simulating that far. Throws std::invalid_argument for
  // a tick that has not been.
  void rewind(std::uint64_t tick);

  // What happens now, that is at the beginning of the next step: one event as JSON, in the keys of a
  // scenario's [[events]] without time_s and when. Returns what is wrong in words, a line each, and
  // then nothing has changed; empty if it will happen.
  [[nodiscard]] std::vector<std::string> intervene(std::string_view event_json);

  // The head as src/frame.ts has it: columns() x robots() numbers, column by column; valid until the
  // next call that is not const.
  [[nodiscard]] std::span<const double> frame();
  [[nodiscard]] std::size_t robots() const;
  [[nodiscard]] static std::vector<std::string> columns();
  [[nodiscard]] std::string targets_json() const;  // x_m, y_m, worker: as in /banyan/targets
  [[nodiscard]] std::string setting_json() const;  // as it is now
  // Another number whenever setting_json() may be another: an obstacle moved, a rewind.
  [[nodiscard]] std::uint64_t setting_version() const;
  [[nodiscard]] std::string metrics_json() const;  // of the head: as in /banyan/metrics; of tick 0 too
  // A JSON array of what happened since the last call, or since load() or rewind(): as in /banyan/events.
  [[nodiscard]] std::string take_events_json();
  // What this robot broadcast last, as an object; "null" if there is no such robot or it has not spoken.
  [[nodiscard]] std::string message_json(std::size_t robot) const;
  [[nodiscard]] std::string hash() const;         // 16 hexadecimal digits: the world's state
  [[nodiscard]] std::string result_json() const;  // columns of the run table as text, of the run so far

  [[nodiscard]] std::uint64_t seed() const;
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string config_json() const;  // the whole configuration, interventions included
  // The same as a file: run by `banyan run`, it has the same hash() at the same tick. A run that went on
  // where the mission had ended is given its head as the end.
  [[nodiscard]] std::string scenario_toml() const;
  // The run so far as an .mcap file. Made by simulating it once more.
  [[nodiscard]] std::string recording() const;

  [[nodiscard]] static std::string version();
  [[nodiscard]] static std::string git();

 private:
  struct Run;
  [[nodiscard]] Run& run() const;

  const AlgorithmList& algorithms_;
  std::unique_ptr<world::Executor> executor_;
  std::unique_ptr<Run> run_;
};

}  // namespace banyan::viewer
