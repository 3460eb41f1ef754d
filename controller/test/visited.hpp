// SPDX-License-Identifier: MIT
// The entries of a set of the neighbour table, in the order in which a room visits them.
#pragma once

#include <vector>

#include "banyan/controller/core/rows.hpp"

namespace banyan {

inline std::vector<int> visited(const Rows& rows) {
  std::vector<int> list;
  rows.for_each([&](int k) { list.push_back(k); });
  return list;
}

}  // namespace banyan
