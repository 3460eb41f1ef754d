// SPDX-License-Identifier: MIT
// What `banyan study` prints at the end.
#pragma once

#include <string>

#include "banyan/study/folder.hpp"
#include "banyan/study/results.hpp"

namespace banyan::cli {

// A line per part and value of the compared axis: share complete, median time, broken and split runs. Then a line per
// part and two of its values: their times compared.
[[nodiscard]] std::string study_summary(const study::Study& study, const study::Results& results,
                                        const study::Folder& folder, const study::Drawn& drawn);

}  // namespace banyan::cli
