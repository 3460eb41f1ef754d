// SPDX-License-Identifier: MIT
// The result of the run: run.csv, a table of one row, and run.json, the same with the configuration of the run,
// which `banyan run` accepts as a scenario.
#include "banyan/record/outputs.hpp"
#include "banyan/record/table.hpp"

namespace banyan::record {

namespace {

using WriteResult = void (*)(const std::string& path, const RunRow& row, const SinkOptions& options);

class ResultSink final : public Sink {
 public:
  ResultSink(std::string path, SinkOptions options, WriteResult write)
      : path_(std::move(path)), options_(std::move(options)), write_(write) {}

  void finish(const world::World& world, const RunEnd& end) override {
    const Provenance& from = options_.provenance;
    write_(path_, {identify(world.scenario(), from.version, from.git), end.run, end.interrupted}, options_);
  }

 private:
  std::string path_;
  SinkOptions options_;
  WriteResult write_;
};

}  // namespace

std::unique_ptr<Sink> open_row(const std::string& path, const SinkOptions& options) {
  return std::make_unique<ResultSink>(
      path, options,
      [](const std::string& to, const RunRow& row, const SinkOptions& o) { write_run_csv(to, row, o.existing); });
}

std::unique_ptr<Sink> open_result(const std::string& path, const SinkOptions& options) {
  return std::make_unique<ResultSink>(path, options,
                                      [](const std::string& to, const RunRow& row, const SinkOptions& o) {
                                        write_run_json(to, row, o.provenance.config_json, o.existing);
                                      });
}

}  // namespace banyan::record
