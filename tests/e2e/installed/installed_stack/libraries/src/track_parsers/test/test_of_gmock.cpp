// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

TEST(Gmock, IsLinked) {
  EXPECT_THAT("a text", testing::HasSubstr("text"));
}
