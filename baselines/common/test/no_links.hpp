// SPDX-License-Identifier: MIT
// What a baseline without links reports while it runs.
#pragma once

#include <gtest/gtest.h>

#include "net.hpp"

namespace banyan::baselines {

template <class R> void expect_no_links(Net<R> net) {
  for (int t = 0; t < 20; ++t) net.tick();
  for (const typename R::State& s : net.states) {
    EXPECT_EQ(R::report(s).parent, nobody);
    EXPECT_EQ(R::report(s).kept, no_links());
  }
}

}  // namespace banyan::baselines
