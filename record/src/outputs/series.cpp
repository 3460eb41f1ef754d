// SPDX-License-Identifier: MIT
// series.csv: the metrics of every tick.
#include "banyan/record/outputs.hpp"
#include "banyan/record/table.hpp"

namespace banyan::record {

namespace {

class SeriesSink final : public Sink {
 public:
  SeriesSink(const std::string& path, Existing existing) : file_(path, existing) {
    file_.write(series_csv_header() + "\n");
  }

  void tick(const world::World&, const measure::Tick& tick) override {
    line_ = series_csv_row(tick);
    line_ += '\n';
    file_.write(line_);
  }
  void finish(const world::World&, const RunEnd&) override { file_.commit(); }
  [[nodiscard]] bool wants_fiedler(const world::World&) const override { return true; }

 private:
  OutputFile file_;
  std::string line_;
};

}  // namespace

std::unique_ptr<Sink> open_series(const std::string& path, const SinkOptions& options) {
  return std::make_unique<SeriesSink>(path, options.existing);
}

}  // namespace banyan::record
