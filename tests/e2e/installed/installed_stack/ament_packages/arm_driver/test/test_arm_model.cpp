// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "arm_driver/arm_model.hpp"

TEST(ArmModel, SharesTheLoad) {
  EXPECT_EQ(arm_driver::hold(4).torques[1], 2);
}
