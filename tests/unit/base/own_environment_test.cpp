// SPDX-License-Identifier: Apache-2.0
#include "base/environment/own_environment.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

namespace launch {
namespace {

TEST(OwnEnvironment, HoldsTheVariablesOfThisProcess) {
  ASSERT_EQ(::setenv("OF_THE_TEST", "a=b", 1), 0);
  EXPECT_EQ(own_environment().at("OF_THE_TEST"), "a=b");
  ASSERT_EQ(::unsetenv("OF_THE_TEST"), 0);
  EXPECT_FALSE(own_environment().contains("OF_THE_TEST"));
}

}  // namespace
}  // namespace launch
