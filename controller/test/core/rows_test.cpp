// SPDX-License-Identifier: MIT
// Sets of entries of the neighbour table.
#include "banyan/controller/core/rows.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>
#include <vector>

#include "visited.hpp"

namespace banyan {
namespace {

RC_GTEST_PROP(Rows, AgreesWithASet, ()) {
  Rows rows;
  std::set<int> expected;
  for (int turn = *rc::gen::inRange(0, 300); turn > 0; --turn) {
    const int k = *rc::gen::inRange(0, neighbor_capacity);
    const int what = *rc::gen::inRange(0, 4);
    if (what == 0) {
      rows.close_gap(k);
      std::set<int> moved;
      for (const int e : expected)
        if (e != k) moved.insert(e > k ? e - 1 : e);
      expected = moved;
    } else {
      rows.set(k, what > 1);
      if (what > 1) expected.insert(k);
      else expected.erase(k);
    }
    RC_ASSERT(visited(rows) == std::vector<int>(expected.begin(), expected.end()));
  }
}

}  // namespace
}  // namespace banyan
