// SPDX-License-Identifier: MIT
// The strict configuration: what is accepted means what it says, what is wrong is said at once.
#include "config.hpp"

#include <gtest/gtest.h>

namespace banyan::cli {
namespace {
TEST(Config, placeholder_minimal) { EXPECT_TRUE(parse_configuration("a.toml", "[targets]\ncount=2").ok()); }
}  // namespace
}  // namespace banyan::cli
