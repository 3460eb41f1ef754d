// SPDX-License-Identifier: MIT
// run.json: how the run went and the configuration that it had, which `banyan run` takes as a scenario.
#include "banyan/record/outputs.hpp"
#include "banyan/record/table.hpp"

namespace banyan::record {

namespace {

class ResultSink final : public Sink {
 public:
  ResultSink(std::string path, SinkOptions options) : path_(std::move(path)), options_(std::move(options)) {}

  void finish(const world::World& world, const RunEnd& end) override {
    const Provenance& from = options_.provenance;
    write_run_json(path_, {identify(world.scenario(), from.version, from.git), end.run, end.interrupted},
                   from.config_json, options_.existing);
  }

 private:
  std::string path_;
  SinkOptions options_;
};

}  // namespace

std::unique_ptr<Sink> open_result(const std::string& path, const SinkOptions& options) {
  return std::make_unique<ResultSink>(path, options);
}

}  // namespace banyan::record
