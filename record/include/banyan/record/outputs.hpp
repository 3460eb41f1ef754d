// SPDX-License-Identifier: MIT
// Opening what is to be kept of a run (output_formats.hpp).
#pragma once

#include <span>
#include <string>

#include "banyan/record/file.hpp"
#include "banyan/record/output_formats.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/record/sink.hpp"

namespace banyan::record {

// What a format may need to know.
struct SinkOptions {
  Provenance provenance;
  OutputSettings output;
  Existing existing = Existing::keep;
};

// Opens everything that options.output wants, in a directory that is there. Throws FileError, before anything
// has been computed in vain; from then on one that fails costs itself only.
[[nodiscard]] Sinks open_outputs(const std::string& directory, const SinkOptions& options,
                                 std::span<const OutputFormat> formats = output_formats);

}  // namespace banyan::record
