// SPDX-License-Identifier: MIT
// What the fields of a message mean to who hears it.
#include "banyan/controller/tree/message.hpp"

#include <gtest/gtest.h>

namespace banyan {
namespace {

TEST(Message, RootTokensAreOrderedBySequenceThenId) {
  EXPECT_TRUE(newer({2, 1}, {1, 9}));
  EXPECT_TRUE(newer({2, 5}, {2, 4}));
  EXPECT_FALSE(newer({2, 4}, {2, 4}));
  EXPECT_FALSE(newer({1, 9}, {2, 1}));
}

TEST(Message, VectorsGoToTheParentOrDuringASwitchToTheOldOne) {
  TreeMessage m;
  EXPECT_EQ(up_of(m), nobody);
  m.old_parent = 4;
  EXPECT_EQ(up_of(m), 4);
  m.parent = 5;
  EXPECT_EQ(up_of(m), 5);
  m.role = Role::root;  // a root keeps the edge to its old parent, but reports to nobody
  EXPECT_EQ(up_of(m), nobody);
}

}  // namespace
}  // namespace banyan
