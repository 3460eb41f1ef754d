// SPDX-License-Identifier: MIT
// Reading a recording (recording.hpp).
#include "banyan/record/recording.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "banyan/record/mcap.hpp"
#include "frame_json.hpp"

namespace banyan::record {

struct Recording::Impl {
  explicit Impl(const std::string& path) : reader(path) {}

  mcap::Reader reader;
  std::uint16_t frames = 0;  // channel
  Provenance provenance;
  Setting setting;
  std::map<std::string, std::string> result;
  double start_s = 0.0, end_s = 0.0;
  std::vector<std::pair<mcap::Nanoseconds, std::vector<TargetFrame>>> targets;  // by time
  std::vector<std::pair<mcap::Nanoseconds, Setting>> settings;                  // by time
  std::vector<std::string> own_warnings;
  mutable std::vector<std::string> warnings;  // the reader's and ours

  void warn(std::string text) {
    constexpr std::size_t most = 20;  // a file that is all damage needs no longer list
    if (own_warnings.size() < most) own_warnings.push_back(std::move(text));
  }
  void read_provenance(const mcap::Map& entries);
  void read_all_metadata();
  void read_all_settings();
  void read_all_targets();
  void read_time_range();
  [[nodiscard]] std::vector<TargetFrame> targets_at(mcap::Nanoseconds time) const;
  [[nodiscard]] std::optional<Frame> parse(const mcap::LoggedMessage& message);
};

void Recording::Impl::read_provenance(const mcap::Map& entries) {
  const auto entry = [&](const char* key) {
    const auto found = entries.find(key);
    return found == entries.end() ? std::string() : found->second;
  };
  provenance = {entry("config"), entry("version"), entry("git"), 0};
  const std::string seed = entry("seed");
  std::from_chars(seed.data(), seed.data() + seed.size(), provenance.seed);
  if (entry("format_version") != recording_format_version)
    throw FileError(reader.path(), "is a recording of format version '" + entry("format_version") +
                                       "', and this program reads " + std::string(recording_format_version) +
                                       ": open it with the version of banyan that made it (" + provenance.version +
                                       "), or run the scenario again");
}

void Recording::Impl::read_all_metadata() {
  bool provenance_found = false;
  bool setting_found = false;
  for (const mcap::Metadata& record : reader.metadata()) {
    if (record.name == "banyan.provenance") {
      read_provenance(record.entries);
      provenance_found = true;
    } else if (record.name == "banyan.result") {
      result = record.entries;
    } else if (record.name == "banyan.setting" && record.entries.contains("json")) {
      try {
        setting = read_setting(record.entries.at("json"));
        setting_found = true;
      } catch (const std::runtime_error& problem) {
        warn(std::string("the setting cannot be read: ") + problem.what());
      }
    }
  }
  if (!provenance_found) warn("it does not say where it comes from (no banyan.provenance)");
  if (!setting_found) warn("it does not say robot radius and radio range (no banyan.setting); defaults are assumed");
}

void Recording::Impl::read_all_settings() {
  const mcap::Channel* channel = reader.find_channel("/banyan/setting");
  if (channel == nullptr) return;
  reader.messages(channel->id, [&](const mcap::LoggedMessage& message) {
    try {
      settings.emplace_back(message.log_time, read_setting(message.data));
    } catch (const std::runtime_error& problem) { warn(std::string("setting: ") + problem.what()); }
    return true;
  });
}

void Recording::Impl::read_all_targets() {
  const mcap::Channel* channel = reader.find_channel("/banyan/targets");
  if (channel == nullptr) return warn("it has no /banyan/targets channel");
  reader.messages(channel->id, [&](const mcap::LoggedMessage& message) {
    try {
      targets.emplace_back(message.log_time, read_targets(message.data));
    } catch (const std::runtime_error& problem) { warn(std::string("targets: ") + problem.what()); }
    return true;
  });
}

void Recording::Impl::read_time_range() {
  const auto seconds = [](mcap::Nanoseconds ns) { return static_cast<double>(ns) * 1e-9; };
  reader.messages(frames, [&](const mcap::LoggedMessage& message) {
    start_s = seconds(message.log_time);
    return false;
  });
  reader.last_before(frames, std::numeric_limits<mcap::Nanoseconds>::max(), [&](const mcap::LoggedMessage& message) {
    end_s = seconds(message.log_time);
    return false;
  });
}

std::vector<TargetFrame> Recording::Impl::targets_at(mcap::Nanoseconds time) const {
  const auto after = std::upper_bound(targets.begin(), targets.end(), time,
                                      [](mcap::Nanoseconds t, const auto& entry) { return t < entry.first; });
  if (after == targets.begin()) return {};
  return std::prev(after)->second;
}

std::optional<Frame> Recording::Impl::parse(const mcap::LoggedMessage& message) {
  Frame frame;
  try {
    read_frame(message.data, frame);
  } catch (const std::runtime_error& problem) {
    warn("the frame at " + std::to_string(static_cast<double>(message.log_time) * 1e-9) +
         " s was skipped: " + problem.what());
    return std::nullopt;
  }
  frame.time_s = static_cast<double>(message.log_time) * 1e-9;  // the text has but four decimals
  frame.targets = targets_at(message.log_time);
  return frame;
}

Recording::Recording(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  Impl& r = *impl_;
  const mcap::Channel* channel = r.reader.find_channel("/banyan/frame");
  if (channel == nullptr || channel->message_encoding != "json") {
    std::string why;
    for (const std::string& warning : r.reader.warnings()) why += "; " + warning;
    throw FileError(path, "is not a recording of Banyan: no channel /banyan/frame" + why);
  }
  r.frames = channel->id;
  r.read_all_metadata();
  r.read_all_settings();
  r.read_all_targets();
  r.read_time_range();
}

Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;
Recording::~Recording() = default;

const std::string& Recording::path() const noexcept { return impl_->reader.path(); }
const Provenance& Recording::provenance() const noexcept { return impl_->provenance; }
const Setting& Recording::setting() const noexcept { return impl_->setting; }
const Setting& Recording::setting_at(double time_s) const noexcept {
  const auto& settings = impl_->settings;
  const auto after = std::upper_bound(settings.begin(), settings.end(), nanoseconds(time_s),
                                      [](mcap::Nanoseconds t, const auto& entry) { return t < entry.first; });
  return after == settings.begin() ? impl_->setting : std::prev(after)->second;
}

const std::map<std::string, std::string>& Recording::result() const noexcept { return impl_->result; }
std::size_t Recording::frames() const noexcept { return impl_->reader.message_count(impl_->frames); }
double Recording::start_s() const noexcept { return impl_->start_s; }
double Recording::end_s() const noexcept { return impl_->end_s; }

const std::vector<std::string>& Recording::warnings() const {
  impl_->warnings = impl_->reader.warnings();
  impl_->warnings.insert(impl_->warnings.end(), impl_->own_warnings.begin(), impl_->own_warnings.end());
  return impl_->warnings;
}

Frame Recording::frame_at(double time_s) {
  Impl& r = *impl_;
  std::optional<Frame> frame;
  bool any = false;
  const auto take = [&](const mcap::LoggedMessage& message) {
    any = true;
    frame = r.parse(message);
    return false;
  };
  if (!r.reader.last_before(r.frames, nanoseconds(time_s), take)) r.reader.messages(r.frames, take);
  if (!any) throw FileError(path(), "holds no frame");
  if (!frame) throw FileError(path(), r.own_warnings.back());
  return std::move(*frame);
}

void Recording::for_each(const std::function<bool(const Frame&)>& visit, double from_s, double to_s,
                         std::size_t every) {
  Impl& r = *impl_;
  std::size_t count = 0;
  r.reader.messages(
      r.frames,
      [&](const mcap::LoggedMessage& message) {
        if (count++ % std::max<std::size_t>(every, 1) != 0) return true;
        const auto frame = r.parse(message);
        return frame ? visit(*frame) : true;
      },
      nanoseconds(from_s), nanoseconds(to_s));
}

std::vector<measure::Tick> Recording::metrics() {
  std::vector<measure::Tick> ticks;
  const mcap::Channel* channel = impl_->reader.find_channel("/banyan/metrics");
  if (channel == nullptr) return ticks;
  impl_->reader.messages(channel->id, [&](const mcap::LoggedMessage& message) {
    try {
      ticks.push_back(read_metrics(message.data));
    } catch (const std::runtime_error& problem) { impl_->warn(std::string("metrics: ") + problem.what()); }
    return true;
  });
  return ticks;
}

std::vector<RecordedEvent> Recording::events() {
  std::vector<RecordedEvent> events;
  const mcap::Channel* channel = impl_->reader.find_channel("/banyan/events");
  if (channel == nullptr) return events;
  impl_->reader.messages(channel->id, [&](const mcap::LoggedMessage& message) {
    try {
      events.push_back(read_event(message.data));
    } catch (const std::runtime_error& problem) { impl_->warn(std::string("events: ") + problem.what()); }
    return true;
  });
  return events;
}

}  // namespace banyan::record
