// SPDX-License-Identifier: MIT
// What is kept of a run: the table of formats, and that their files are what they were asked to be.
#include "banyan/record/outputs.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <set>
#include <stdexcept>

#include "banyan/measure/observer.hpp"
#include "banyan/record/simulation.hpp"
#include "banyan/record/table.hpp"
#include "sample.hpp"

namespace banyan::record {
namespace {

namespace fs = std::filesystem;

SinkOptions everything() {
  SinkOptions options{test::sample_provenance(), {}, Existing::keep};
  for (const OutputFormat& format : output_formats)
    if (!format.key.empty()) options.output[format.key] = true;
  return options;
}

RunEnd run_into(Sinks& sinks) {
  world::Executor one(1);
  return run_scenario(world::World(test::small_world()), sinks, one);
}

std::set<std::string> files_in(const std::string& directory) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) names.insert(entry.path().filename());
  return names;
}

TEST(Outputs, KeysAndFilesAreThereOnce) {
  std::set<std::string_view> keys, files;
  for (const OutputFormat& format : output_formats) {
    if (!format.key.empty()) {
      EXPECT_TRUE(keys.insert(format.key).second) << format.key;
      EXPECT_EQ(format.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), std::string_view::npos) << format.key;
      EXPECT_EQ(OutputSettings{}[format.key], format.by_default) << format.key;
    }
    EXPECT_TRUE(files.insert(format.file).second) << format.file;
    EXPECT_FALSE(format.what.empty());
  }
  EXPECT_TRUE(OutputSettings{}["record"]);
  EXPECT_FALSE(OutputSettings{}["series"]);
  EXPECT_THROW(static_cast<void>(OutputSettings{}["sieres"]), std::out_of_range);
  EXPECT_THROW(static_cast<void>(OutputSettings{}[""]), std::out_of_range);
}

TEST(Outputs, OnlyWhatIsWantedIsWritten) {
  const auto written = [](OutputSettings output) {
    const test::TemporaryDirectory directory;
    Sinks sinks = open_outputs(directory.file(""), {{}, output, Existing::keep});
    run_into(sinks);
    EXPECT_TRUE(sinks.failures().empty());
    return files_in(directory.file(""));
  };
  using Names = std::set<std::string>;
  OutputSettings output;
  EXPECT_TRUE(output.any());
  EXPECT_EQ(written(output), (Names{"run.mcap", "run.csv", "run.json"}));
  output["series"] = true;
  output.results = false;
  EXPECT_EQ(written(output), (Names{"run.mcap", "series.csv"}));
  output["record"] = output["series"] = false;
  EXPECT_FALSE(output.any());
  EXPECT_EQ(written(output), Names{});
}

// Against a world that is stepped, observed and written down here.
TEST(Outputs, FilesHoldWhatHappened) {
  const test::TemporaryDirectory directory;
  SinkOptions options = everything();
  options.output.record_every = 3;
  options.output.messages = false;
  Sinks sinks = open_outputs(directory.file(""), options);
  run_into(sinks);

  world::World world(test::small_world());
  measure::Observer observer(world);
  RecorderOptions recorder_options;
  recorder_options.every_ticks = 3;
  recorder_options.messages = false;
  Recorder recorder(directory.file("wanted.mcap"), test::sample_provenance(), recorder_options);
  recorder.frame(world, measure::Observer(world).observe(world, true));
  std::string series = series_csv_header() + "\n";
  while (!observer.finished()) {
    world.step();
    const measure::Tick& tick = observer.observe(world, true);
    recorder.frame(world, tick);
    series += series_csv_row(tick) + "\n";
  }
  recorder.finish(observer.result(world));
  const auto [config, version, git, seed] = test::sample_provenance();
  const RunRow row{identify(test::small_world(), version, git), observer.result(world), false};

  EXPECT_EQ(test::contents(directory.file("run.mcap")), test::contents(directory.file("wanted.mcap")));
  EXPECT_EQ(test::contents(directory.file("series.csv")), series);
  EXPECT_EQ(test::contents(directory.file("run.csv")), run_csv_header() + "\n" + run_csv_row(row) + "\n");
  EXPECT_EQ(test::contents(directory.file("run.json")), run_json(row, config));
}

TEST(Outputs, AFileThatCannotBeMadeIsSaidBeforeTheRun) {
  const test::TemporaryDirectory directory;
  EXPECT_THROW(static_cast<void>(open_outputs(directory.file("no"), everything())), FileError);
}

// To the process that writes, a file that may not grow is a full disk.
class LargestFile {
 public:
  explicit LargestFile(std::uint64_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  LargestFile(const LargestFile&) = delete;
  LargestFile& operator=(const LargestFile&) = delete;
  ~LargestFile() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Outputs, AFullDiskCostsTheFileThatFillsItAndNothingElse) {
  const test::TemporaryDirectory roomy, full;
  Sinks undisturbed = open_outputs(roomy.file(""), everything());
  run_into(undisturbed);
  const std::string recording = test::contents(roomy.file("run.mcap"));
  Sinks sinks = open_outputs(full.file(""), everything());
  {
    const LargestFile limit(recording.size() - 1);
    run_into(sinks);
  }
  ASSERT_EQ(sinks.failures().size(), 1U);
  EXPECT_TRUE(sinks.failures()[0].text.ends_with("run.mcap: cannot write: File too large")) << sinks.failures()[0].text;
  EXPECT_EQ(files_in(full.file("")), (std::set<std::string>{"run.csv", "run.json", "run.mcap.part", "series.csv"}));
  for (const char* name : {"run.csv", "run.json", "series.csv"})
    EXPECT_EQ(test::contents(full.file(name)), test::contents(roomy.file(name))) << name;
}

// ------------------------------------------------------------------ a format more: one file ...

class EndSink final : public Sink {
 public:
  EndSink(const std::string& path, Existing existing) : file_(path, existing) {}
  void tick(const world::World& world, const measure::Tick&) override {
    if (world.tick() == fails_at) throw std::runtime_error("no more");
  }
  void finish(const world::World& world, const RunEnd&) override {
    file_.write(std::to_string(world.tick()) + "\n");
    file_.commit();
  }
  static inline std::uint64_t fails_at = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

 private:
  OutputFile file_;
};
std::unique_ptr<Sink> open_end(const std::string& path, const SinkOptions& options) {
  return std::make_unique<EndSink>(path, options.existing);
}

// ... and one line.
constexpr OutputFormat more_formats[] = {
    output_formats[0], output_formats[3], {"", true, "end.txt", "the last tick", open_end}, output_formats[1]};

TEST(Outputs, AFormatMoreIsALineMore) {
  const test::TemporaryDirectory directory;
  Sinks sinks = open_outputs(directory.file(""), everything(), more_formats);
  const RunEnd end = run_into(sinks);
  EXPECT_EQ(test::contents(directory.file("end.txt")), std::to_string(end.run.ticks) + "\n");
  EXPECT_EQ(files_in(directory.file("")), (std::set<std::string>{"end.txt", "run.csv", "run.mcap", "series.csv"}));
}

TEST(Outputs, OneThatFailsInTheMiddleLeavesNoFileAndTheOthersWhole) {
  const test::TemporaryDirectory alone, together;
  Sinks undisturbed = open_outputs(alone.file(""), everything());
  run_into(undisturbed);
  EndSink::fails_at = 4;
  Sinks sinks = open_outputs(together.file(""), everything(), more_formats);
  run_into(sinks);
  EndSink::fails_at = 0;
  ASSERT_EQ(sinks.failures().size(), 1U);
  EXPECT_EQ(sinks.failures()[0].path, together.file("") + "/end.txt");
  EXPECT_EQ(files_in(together.file("")), (std::set<std::string>{"run.csv", "run.mcap", "series.csv"}));
  for (const char* name : {"run.csv", "run.mcap", "series.csv"})
    EXPECT_EQ(test::contents(together.file(name)), test::contents(alone.file(name))) << name;
}

}  // namespace
}  // namespace banyan::record
