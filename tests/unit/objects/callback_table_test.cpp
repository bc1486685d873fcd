// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/callback_table.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

using Owner = CallbackObject::Owner;

struct CallbackTableTest : ::testing::Test {
  EarlierProcesses earlier;
  CallbackTable table{earlier};
};

TEST_F(CallbackTableTest, KeepsEqualAddressesOfTwoProcessesApart) {
  EXPECT_EQ(table.at(1, 0xcb), 0u);
  EXPECT_EQ(table.at(2, 0xcb), 1u);
  EXPECT_EQ(table.at(1, 0xcb), 0u);
}

TEST_F(CallbackTableTest, GivesAnOwnerToACallbackThatRanBefore) {
  const ObjectId id = table.at(1, 0xcb);
  EXPECT_EQ(table.add(1, 0xcb, Owner::kTimer, 3), id);
  EXPECT_TRUE(table.belongs_to(1, 0xcb, Owner::kTimer, 3));
}

TEST_F(CallbackTableTest, HasANewCallbackForAnotherOwner) {
  const ObjectId id = table.add(1, 0xcb, Owner::kTimer, 3);
  EXPECT_EQ(table.add(1, 0xcb, Owner::kTimer, 3), id);
  EXPECT_NE(table.add(1, 0xcb, Owner::kService, 3), id);
}

TEST_F(CallbackTableTest, HasANewCallbackForAnotherSymbol) {
  table.name(1, 0xcb, "(null)");
  table.name(1, 0xcb, "tick()");
  table.name(1, 0xcb, "tick()");
  EXPECT_EQ(table.all().size(), 1u);
  table.name(1, 0xcb, "tock()");
  ASSERT_EQ(table.all().size(), 2u);
  EXPECT_EQ(table.all()[1].symbol, "tock()");
}

TEST_F(CallbackTableTest, MovesTheNewestCallbackOfAnOwner) {
  table.add(1, 0xcb, Owner::kTimer, 3);
  table.name(1, 0xcb, "tick()");
  table.move(1, Owner::kTimer, 3, 4);
  ASSERT_EQ(table.all().size(), 2u);
  EXPECT_EQ(table.all()[1].owner_id, 4u);
  EXPECT_EQ(table.all()[1].symbol, "tick()");
  EXPECT_EQ(table.at(1, 0xcb), 1u);
}

TEST_F(CallbackTableTest, HasNoCallbackAtAnAddressThatHasEnded) {
  const ObjectId id = table.at(1, 0xcb);
  table.end(1, 0xcb);
  EXPECT_NE(table.at(1, 0xcb), id);
}

}  // namespace
}  // namespace tracing
