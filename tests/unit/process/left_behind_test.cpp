// SPDX-License-Identifier: Apache-2.0
#include "base/processes/left_behind.hpp"

#include <gmock/gmock.h>

namespace {

using launch::left_behind;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(LeftBehind, IsWhatTheGuardianHasEnded) {
  EXPECT_THAT(left_behind("[INFO] [a-1]: process started with pid [3]\n"
                          "[WARNING] [launch]: a-1 left 1 process running: sleep (4); ending it\n"
                          "[WARNING] [launch]: the launch left 2 processes running: b (5), c (6); ending them\n"
                          "[ERROR] [launch]: cannot end d (7): what is left hangs in the kernel\n"),
              ElementsAre("a-1 left 1 process running: sleep (4)", "the launch left 2 processes running: b (5), c (6)",
                          "cannot end d (7): what is left hangs in the kernel"));
}

TEST(LeftBehind, IsNotWhatAProcessWrites) {
  EXPECT_THAT(left_behind("[a-1] [WARNING] [launch]: a-1 left 1 process running: sleep (4); ending it\n"
                          "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)\n"),
              IsEmpty());
}

}  // namespace
