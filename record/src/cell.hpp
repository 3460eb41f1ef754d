// SPDX-License-Identifier: MIT
// One cell of a table as CSV or JSON.
#pragma once

#include "banyan/record/table.hpp"
#include "text.hpp"

namespace banyan::record {

void write_cell_csv(Text& out, const Cell& cell, int decimals);
void write_cell_json(Text& out, const Cell& cell, int decimals);

// The columns of run_columns() that tell how the run went, without those that identify it.
[[nodiscard]] std::span<const Column<RunRow>> result_columns() noexcept;

}  // namespace banyan::record
