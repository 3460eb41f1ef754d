// SPDX-License-Identifier: MIT
// One cell of a table as CSV or JSON.
#pragma once

#include "banyan/record/table.hpp"
#include "text.hpp"

namespace banyan::record {

void write_cell_csv(Text& out, const Cell& cell, int decimals);
void write_cell_json(Text& out, const Cell& cell, int decimals);

}  // namespace banyan::record
