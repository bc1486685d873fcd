// SPDX-License-Identifier: Apache-2.0
// Part of test programs all of whose tests start processes as the launcher does (project_test, SPAWNS). Where that
// can't be, they say so.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/support/emulated.hpp"

namespace {

class NeedsSpawn : public testing::Environment {
 public:
  void SetUp() override {
    if (!test_support::vfork_shares_memory()) {
      std::cout << "[  SKIPPED ] all tests\n";  // what CTest looks for; skipped in this place they are only left out
      GTEST_SKIP() << "skipped, because vfork() copies the memory here, as under QEMU";
    }
  }
};

[[maybe_unused]] const testing::Environment* const kEnvironment = testing::AddGlobalTestEnvironment(new NeedsSpawn);

}  // namespace
