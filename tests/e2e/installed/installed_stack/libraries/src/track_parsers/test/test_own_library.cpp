// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

int answer_of_the_package();

TEST(OwnLibrary, IsLoadedAndNotTheStacks) {
  EXPECT_EQ(answer_of_the_package(), 42);
}
