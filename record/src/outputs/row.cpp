// SPDX-License-Identifier: MIT
// run.csv: how the run went, as a table of one row.
#include "banyan/record/outputs.hpp"
#include "banyan/record/table.hpp"

namespace banyan::record {

namespace {

class RowSink final : public Sink {
 public:
  RowSink(std::string path, SinkOptions options) : path_(std::move(path)), options_(std::move(options)) {}

  void finish(const world::World& world, const RunEnd& end) override {
    const Provenance& from = options_.provenance;
    write_run_csv(path_, {identify(world.scenario(), from.version, from.git), end.run, end.interrupted},
                  options_.existing);
  }

 private:
  std::string path_;
  SinkOptions options_;
};

}  // namespace

std::unique_ptr<Sink> open_row(const std::string& path, const SinkOptions& options) {
  return std::make_unique<RowSink>(path, options);
}

}  // namespace banyan::record
