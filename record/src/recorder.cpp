// SPDX-License-Identifier: MIT
// Writing a recording (recording.hpp).
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <utility>

#include "banyan/record/events.hpp"
#include "banyan/record/mcap.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/record/ros2.hpp"
#include "cell.hpp"
#include "frame_json.hpp"

namespace banyan::record {

namespace {

constexpr double chunk_span_s = 10.0;  // what a crash may cost at most
constexpr std::chrono::milliseconds live_every{1000};
// Plots and lists are to be read without unpacking what every robot did at every tick.
constexpr mcap::ChunkGroup large = 0, small = 1;
constexpr double scene_full_rate = 1000;  // robots; above, scenes come in proportion less often

mcap::WriterOptions writer_options(const Provenance& provenance, const RecorderOptions& options) {
  return {"", "banyan " + provenance.version, options.compression_level, options.chunk_bytes};
}

}  // namespace

struct Recorder::Impl {
  Impl(std::string path, Provenance from, const RecorderOptions& wanted)
      : options(wanted),
        provenance(std::move(from)),
        file(std::move(path), wanted.existing),
        mcap(file, writer_options(provenance, wanted)) {}

  RecorderOptions options;
  Provenance provenance;
  OutputFile file;
  mcap::Writer mcap;
  std::uint16_t frames = 0, messages = 0, markers = 0, transforms = 0;        // channels: large ones,
  std::uint16_t targets = 0, metrics = 0, events = 0, log = 0, settings = 0;  // small ones
  Text text;
  ros2::CdrWriter cdr;
  EventWatcher watcher;
  Setting setting;
  Frame now;
  bool started = false, frame_written = false, finished = false;
  double last_chunk_s = 0.0, next_scene_s = 0.0;
  std::chrono::steady_clock::time_point next_live;  // long ago: the start is seen at once
  MessageNumbers last_messages;                     // of now's world; empty: none
  std::vector<TargetFrame> last_targets;
  ros2::MapTopics maps;

  void add_channels();
  void add_messages_channel();
  void look_at(const Setting& current);
  void put(std::uint16_t channel) {
    mcap.message(channel, nanoseconds(now.time_s), text.view());
    text.clear();
  }
  [[nodiscard]] ros2::Stamp stamp() const { return {.nanoseconds = nanoseconds(now.time_s)}; }
  void put_cdr(std::uint16_t channel) { mcap.message(channel, nanoseconds(now.time_s), cdr.view()); }
  void record(const Setting& current, const measure::Tick& tick);
  void show_live();
  void put_frame();
  void put_event(const RecordedEvent& event);
  void put_scene();
  void put_result(const measure::Run& run, bool interrupted);
};

void Recorder::Impl::add_channels() {
  const auto add = [&](std::string topic, std::string schema, std::string_view schema_data, mcap::ChunkGroup group) {
    const auto id = mcap.add_schema(std::move(schema), "jsonschema", std::string(schema_data));
    return mcap.add_channel(id, std::move(topic), "json", {}, group);
  };
  frames = add("/banyan/frame", "banyan.Frame", frame_schema(), large);
  settings = add("/banyan/setting", "banyan.Setting", setting_schema(), small);
  targets = add("/banyan/targets", "banyan.Targets", targets_schema(), small);
  metrics = add("/banyan/metrics", "banyan.Metrics", metrics_schema(), small);
  events = add("/banyan/events", "banyan.Event", event_schema(), small);
  log = ros2::add_channel(mcap, ros2::log_topic, ros2::log_type(), small);
  if (options.scene_period_s > 0.0) {
    markers = ros2::add_channel(mcap, ros2::markers_topic, ros2::markers_type(), large);
    transforms = ros2::add_channel(mcap, ros2::transforms_topic, ros2::transforms_type(), large);
  }
}

// Its fields are those of the algorithm, which is known from the first frame of a world.
void Recorder::Impl::add_messages_channel() {
  if (messages != 0) return;
  const auto schema = mcap.add_schema("banyan.Messages", "jsonschema", messages_schema(last_messages.fields));
  messages = mcap.add_channel(schema, "/banyan/messages", "json", {}, large);
}

void Recorder::Impl::look_at(const Setting& current) {
  if (started && current == setting) return;
  setting = current;
  text.clear();
  write_setting(text, setting);
  if (!started) mcap.metadata({"banyan.setting", {{"json", std::string(text.view())}}});
  put(settings);
  started = true;
  if (options.scene_period_s > 0.0) maps.write(mcap, cdr, stamp(), setting, large);
}

void Recorder::Impl::put_frame() {
  write_frame(text, now);
  put(frames);
  if (!last_messages.empty()) {
    add_messages_channel();
    write_messages(text, now.tick, now.time_s, last_messages);
    put(messages);
  }
  frame_written = true;
}

void Recorder::Impl::put_event(const RecordedEvent& event) {
  write_event(text, event);
  put(events);
  write_log(cdr, stamp(), event);
  put_cdr(log);
}

void Recorder::Impl::put_scene() {
  write_markers(cdr, stamp(), setting, now);
  put_cdr(markers);
  write_transforms(cdr, stamp(), now);
  put_cdr(transforms);
  const double stretch = std::max(1.0, static_cast<double>(now.robots.size()) / scene_full_rate);
  next_scene_s = now.time_s + options.scene_period_s * stretch - 0.5 * setting.tick_s;
}

void Recorder::Impl::record(const Setting& current, const measure::Tick& tick) {
  if (now.time_s >= last_chunk_s + chunk_span_s) {
    mcap.end_chunks();
    last_chunk_s = now.time_s;
  }
  look_at(current);
  const bool first = !frame_written && last_targets.empty();
  if (first || now.targets != last_targets) {
    write_targets(text, now);
    put(targets);
    last_targets = now.targets;
  }
  frame_written = false;
  if (options.every_ticks <= 1 || now.tick % options.every_ticks == 0) put_frame();
  write_metrics(text, tick);
  put(metrics);
  for (const RecordedEvent& event : watcher.watch(setting, now, tick)) put_event(event);
  if (options.scene_period_s > 0.0 && now.time_s >= next_scene_s) put_scene();
  if (options.live) show_live();
}

// By the wall's clock, since it is for people; so the same run may have other chunks, and says the same in them.
void Recorder::Impl::show_live() {
  const auto moment = std::chrono::steady_clock::now();
  if (moment < next_live) return;
  mcap.end_chunks();
  last_chunk_s = now.time_s;
  next_live = moment + live_every;
}

void Recorder::Impl::put_result(const measure::Run& run, bool interrupted) {
  mcap::Metadata result{"banyan.result", {}};
  const RunRow row{{}, run, interrupted};
  for (const auto& column : result_columns()) {
    text.clear();
    write_cell_csv(text, column.cell(row), column.decimals);
    result.entries.emplace(column.name, text.view());
  }
  text.clear();
  mcap.metadata(result);
}

Recorder::Recorder(std::string path, Provenance provenance, RecorderOptions options)
    : impl_(std::make_unique<Impl>(std::move(path), std::move(provenance), options)) {
  Impl& r = *impl_;
  r.file.keep_part();
  r.mcap.metadata({"banyan.provenance",
                   {{"format_version", std::string(recording_format_version)},
                    {"version", r.provenance.version},
                    {"git", r.provenance.git},
                    {"seed", std::to_string(r.provenance.seed)},
                    {"config", r.provenance.config_json}}});
  r.add_channels();
  r.file.flush();  // whoever is killed before the first frame leaves a recording without one, and not a torn file
}

Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Recorder::~Recorder() {
  if (!impl_ || impl_->finished) return;
  try {
    impl_->mcap.end_chunks();  // what there is can be read back by scanning
    impl_->file.flush();
  } catch (const std::exception&) {
    // The caller that drops an unfinished recorder has had another exception already.
  }
}

void Recorder::frame(const world::World& world, const measure::Tick& tick) {
  Impl& r = *impl_;
  capture(world, r.now);
  if (r.options.messages) capture_messages(world.swarm(), world.arrived(), r.last_messages);
  r.record(r.started && still_holds(r.setting, world) ? r.setting : setting_of(world), tick);
}

void Recorder::frame(const Setting& setting, const Frame& frame, const measure::Tick& tick) {
  Impl& r = *impl_;
  r.now = frame;
  r.last_messages = {};
  r.record(setting, tick);
}

void Recorder::event(std::string_view kind, std::string_view text) {
  impl_->put_event({impl_->now.tick, impl_->now.time_s, std::string(kind), -1, -1, std::string(text)});
}

void Recorder::finish(const measure::Run& run, bool interrupted) {
  Impl& r = *impl_;
  if (r.started && !r.frame_written) r.put_frame();
  if (interrupted) event("interrupted", "stopped before completion or the time limit");
  r.put_result(run, interrupted);
  r.mcap.finish();
  r.file.commit();
  r.finished = true;
}

std::uint64_t Recorder::bytes() const noexcept { return impl_->file.position(); }
const std::string& Recorder::path() const noexcept { return impl_->file.path(); }
const std::string& Recorder::part_path() const noexcept { return impl_->file.part_path(); }

}  // namespace banyan::record
