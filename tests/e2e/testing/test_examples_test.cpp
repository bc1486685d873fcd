// SPDX-License-Identifier: Apache-2.0
// `launch test`: the examples of tests.
#include <gmock/gmock.h>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

class ExampleTests : public testing::TestWithParam<const char*> {};

TEST_P(ExampleTests, PassOrFailAsTheReadmeSays) {
  Sandbox sandbox;
  const std::string folder = EXAMPLES_DIRECTORY "/";
  const CommandResult good = run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "40_test.launch." + GetParam()}},
                                         std::chrono::seconds(100));
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("\n3 tests: 3 passed, in "));
  const CommandResult bad = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "41_failing_test.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("\n4 tests: 0 passed, 4 failed, in "));
  EXPECT_THAT(bad.out, HasSubstr("error: there is a line with 'count 3' from 'counter'\n"));
  EXPECT_THAT(bad.out, HasSubstr("error: 'crash' has exited with code 2\n"));
  EXPECT_THAT(bad.out, HasSubstr("      = expected: an exit with code 3\n"));
  EXPECT_THAT(bad.out, HasSubstr("error: unexpected-2 has exited with code 7\n"));
  const CommandResult traced = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "42_trace_test.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(traced.exit_code, 0) << traced.out << traced.err;
  const CommandResult late = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "43_latency_budget.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_THAT(late.out, HasSubstr("error: messages of '/ping' do not take the time that is expected\n"));
  EXPECT_THAT(late.out, HasSubstr(" outside; least "));
  EXPECT_THAT(late.out, HasSubstr("error: the chain /ping /pong does not take the time that is expected\n"));
  EXPECT_THAT(late.out, HasSubstr("nearest events:"));
}

TEST_P(ExampleTests, OfFaultsDoWhatTheirCommentsSay) {
  const std::string folder = EXAMPLES_DIRECTORY "/";
  const CommandResult faults = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "46_faults.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(faults.exit_code, 0) << faults.out << faults.err;
  EXPECT_THAT(faults.out, HasSubstr("(1 of 1 fault)\n"));
  const CommandResult crash = run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "46_faults.launch." + GetParam(),
                                                    "-n", "ping ends well", "--seed", "9", "--shrink"}},
                                          std::chrono::seconds(100));
  EXPECT_EQ(crash.exit_code, 1) << crash.out << crash.err;
  EXPECT_THAT(crash.out, HasSubstr("      = shrunk to 1 of "));
  EXPECT_THAT(crash.out, HasSubstr(": kill of 'ping' at "));
  const CommandResult messages =
      run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "48_message_faults.launch." + GetParam(), "--seeds", "3"}},
                  std::chrono::seconds(100));
  EXPECT_EQ(messages.exit_code, 0) << messages.out << messages.err;
  EXPECT_THAT(messages.out, HasSubstr("6 tests: 6 passed, in "));
  const CommandResult network = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "49_network_faults.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(network.exit_code, 0) << network.out << network.err;
  EXPECT_THAT(network.out, HasSubstr("2 tests: 2 passed, in "));
  const CommandResult clock = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "47_clock_faults.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(clock.exit_code, 0) << clock.out << clock.err;
  const CommandResult services =
      run_command({.argv = {LAUNCH_PROGRAM, "test", folder + "52_service_faults.launch." + GetParam(), "--seeds", "2"}},
                  std::chrono::seconds(100));
  EXPECT_EQ(services.exit_code, 0) << services.out << services.err;
  EXPECT_THAT(services.out, HasSubstr("6 tests: 6 passed, in "));
  const CommandResult disk = run_command(
      {.argv = {LAUNCH_PROGRAM, "test", folder + "53_full_disk.launch." + GetParam()}}, std::chrono::seconds(100));
  EXPECT_EQ(disk.exit_code, 0) << disk.out << disk.err;
  EXPECT_THAT(disk.out, HasSubstr("2 tests: 2 passed, in "));
}

INSTANTIATE_TEST_SUITE_P(Both, ExampleTests, testing::Values("xml", "yaml"));

}  // namespace
