// SPDX-License-Identifier: MIT
// Writes the sample recordings that record/test/readers/ reads with the libraries of others:
//   sample_files DIRECTORY
// gives sample.mcap (all channels but messages), sample.csv (its export), world.mcap (of a simulated world, with
// messages), plain.mcap (uncompressed, every 5th tick), empty.mcap (no tick), cut.mcap.part (a recorder that never
// finished), killed.mcap.part and early.mcap.part (the program was killed within a second, and before the first tick),
// and as NAME-bag.mcap the bags made of them.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "banyan/measure/observer.hpp"
#include "banyan/record/export.hpp"
#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"
#include "sample.hpp"

namespace {

using namespace banyan::record;

// What is on the disk while the program still runs.
void write_killed(const std::string& path, std::uint64_t ticks) {
  RecorderOptions options;
  options.existing = Existing::replace;
  Recorder running(path + "-running.mcap", test::sample_provenance(), options);
  for (std::uint64_t t = 0; t < ticks; ++t) {
    const Frame frame = test::sample_frame(94, 3.0, t);
    running.frame(test::sample_setting(), frame, test::sample_tick(frame));
  }
  std::filesystem::copy_file(running.part_path(), path, std::filesystem::copy_options::overwrite_existing);
  running.finish(test::sample_run(ticks));
  std::filesystem::remove(running.path());
}

void write_samples(const std::string& directory) {
  const auto file = [&](const char* name) { return directory + "/" + name; };
  RecorderOptions options;
  options.existing = Existing::replace;
  options.chunk_bytes = 40000;
  test::record_sample(file("sample.mcap"), 30, 300, options);
  Recording recording(file("sample.mcap"));
  export_csv(recording, file("sample.csv"), Existing::replace);

  banyan::world::Scenario scenario = banyan::world::plain_scenario();
  scenario.swarm.robots = 12;
  banyan::world::World world(scenario);
  banyan::measure::Observer observer(world);
  Recorder simulated(file("world.mcap"), test::sample_provenance(), options);
  for (int t = 0; t < 150; ++t) {
    world.step();
    simulated.frame(world, observer.observe(world));
  }
  simulated.finish(observer.result(world));

  Recorder(file("empty.mcap"), test::sample_provenance(), options).finish(test::sample_run(0), true);

  RecorderOptions plain = options;
  plain.compression_level = 0;
  plain.every_ticks = 5;
  test::record_sample(file("plain.mcap"), 9, 101, plain);

  Recorder unfinished(file("cut.mcap"), test::sample_provenance(), options);
  for (std::uint64_t t = 0; t < 50; ++t) {
    const Frame frame = test::sample_frame(9, 3.0, t);
    unfinished.frame(test::sample_setting(), frame, test::sample_tick(frame));
  }
  write_killed(file("killed.mcap.part"), 10);
  write_killed(file("early.mcap.part"), 0);
}

void write_bags(const std::string& directory) {
  for (const char* name :
       {"sample.mcap", "world.mcap", "empty.mcap", "cut.mcap.part", "killed.mcap.part", "early.mcap.part"}) {
    Recording recording(directory + "/" + name);
    const std::string_view stem = std::string_view(name).substr(0, std::string_view(name).find('.'));
    export_bag(recording, directory + "/" + std::string(stem) + "-bag.mcap", Existing::replace);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: sample_files DIRECTORY\n");
    return 2;
  }
  try {
    write_samples(argv[1]);
    write_bags(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
