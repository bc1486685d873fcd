// SPDX-License-Identifier: Apache-2.0
// What is left of a kernel recorder that was killed harms nobody.
#include "tracing/record/kernel/kernel_recorder.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <string>

#include "base/processes/process_stat.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace {

struct LeftPidFile : testing::Test {
  // The recorder's number was given to another process after the recorder was killed.
  void SetUp() override {
    const std::uint64_t started = launch::read_process_stat(stranger.pid()).started;
    ASSERT_GT(started, 0u);
    test_support::write_file(sandbox.directory() / "kernel-recorder.pid",
                             std::to_string(stranger.pid()) + " " + std::to_string(started - 1) + " recording\n");
  }

  bool stranger_lives() const { return launch::read_process_stat(stranger.pid()).state != 'Z'; }

  test_support::Sandbox sandbox;
  test_support::RunningCommand stranger{{.argv = {"sleep", "1000"}}};
};

TEST_F(LeftPidFile, OfAnotherProcessIsNotSignalledAtTheEnd) {
  EXPECT_EQ(tracing::kernel_recorder_process(sandbox.directory()), 0);
  EXPECT_THROW(tracing::finish_kernel_recorder(sandbox.directory()), tracing::TraceError);
  EXPECT_TRUE(stranger_lives());
}

TEST_F(LeftPidFile, OfAnotherProcessIsNotSignalledForAPause) {
  EXPECT_THROW(tracing::pause_kernel_recorder(sandbox.directory()), tracing::TraceError);
  EXPECT_TRUE(stranger_lives());
}

}  // namespace
