// SPDX-License-Identifier: MIT
// run.mcap: the run as a recording, its start included.
#include "banyan/measure/observer.hpp"
#include "banyan/record/outputs.hpp"

namespace banyan::record {

namespace {

RecorderOptions recorder_options(const SinkOptions& options) {
  RecorderOptions chosen;
  chosen.every_ticks = options.output.record_every;
  chosen.messages = options.output.messages;
  chosen.live = options.output.live;
  chosen.existing = options.existing;
  return chosen;
}

class RecordingSink final : public Sink {
 public:
  RecordingSink(const std::string& path, const SinkOptions& options)
      : recorder_(path, options.provenance, recorder_options(options)) {}

  void start(const world::World& world) override {
    recorder_.frame(world, measure::at_start(world, measure::is_plotted(world)));
  }
  void tick(const world::World& world, const measure::Tick& tick) override { recorder_.frame(world, tick); }
  void finish(const world::World&, const RunEnd& end) override { recorder_.finish(end.run, end.interrupted); }
  [[nodiscard]] bool wants_fiedler(const world::World& world) const override { return measure::is_plotted(world); }
  [[nodiscard]] std::string rest() const override { return recorder_.part_path(); }

 private:
  Recorder recorder_;
};

}  // namespace

std::unique_ptr<Sink> open_recording(const std::string& path, const SinkOptions& options) {
  return std::make_unique<RecordingSink>(path, options);
}

}  // namespace banyan::record
