// SPDX-License-Identifier: MIT
// Opening what is to be kept of a run (outputs.hpp).
#include "banyan/record/outputs.hpp"

namespace banyan::record {

Sinks open_outputs(const std::string& directory, const SinkOptions& options, std::span<const OutputFormat> formats) {
  Sinks sinks;
  for (const OutputFormat& format : formats) {
    if (!options.output.wants(format)) continue;
    const std::string path = directory + "/" + std::string(format.file);
    sinks.add(path, format.open(path, options));
  }
  return sinks;
}

}  // namespace banyan::record
