// SPDX-License-Identifier: Apache-2.0
// Loading of libtracetools_provider.so, seen from outside: each case is a process of its own.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;

void expect_result(const CommandResult& result, int exit_code, const std::string& out, const std::string& err) {
  EXPECT_EQ(result.exit_code, exit_code);
  EXPECT_EQ(result.out, out);
  EXPECT_EQ(result.err, err);
}

TEST(Provider, IsLoadedFromBesideTheLibrary) {
  expect_result(run_command({STATUS}), 0, "Tracing enabled\n", "");
}

TEST(Provider, IsNotLoadedWhenTracingIsDisabled) {
  expect_result(run_command(Command{{STATUS}, {{"TRACETOOLS_RUNTIME_DISABLE", "1"}}}), 1, "Tracing disabled\n", "");
}

// The program prints how many threads it has: one, and the threads of sanitizers and of lttng-ust.
TEST(Provider, BringsTwoThreadsToAProcessThatCanBeTraced) {
  const test_support::Sandbox sandbox;
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
  const CommandResult traced = run_command({FIRE_ALL_EVENTS});
  const CommandResult untraced = run_command(Command{{FIRE_ALL_EVENTS}, {{"TRACETOOLS_RUNTIME_DISABLE", "1"}}});
  ASSERT_EQ(traced.exit_code, 0) << traced.err;
  ASSERT_EQ(untraced.exit_code, 0) << untraced.err;
  // lttng-ust listens to the user's session daemon and to root's.
  EXPECT_EQ(std::stoi(traced.out), std::stoi(untraced.out) + 2);
}

TEST(Provider, SaysOnRequestThatTracingIsDisabled) {
  expect_result(run_command(Command{{STATUS}, {{"TRACETOOLS_RUNTIME_DISABLE", "1"}, {"TRACETOOLS_VERBOSE", "1"}}}), 1,
                "Tracing disabled\n", "tracetools: tracing is disabled by TRACETOOLS_RUNTIME_DISABLE\n");
}

TEST(Provider, OtherValuesDoNotDisableTracing) {
  expect_result(run_command(Command{{STATUS}, {{"TRACETOOLS_RUNTIME_DISABLE", "0"}}}), 0, "Tracing enabled\n", "");
}

TEST(Provider, ProcessGoesOnUntracedWhenItIsMissing) {
  test_support::Sandbox sandbox;
  fs::copy(TRACETOOLS_LIBRARY, sandbox.directory() / "libtracetools.so");
  expect_result(run_command(Command{{STATUS}, {{"LD_PRELOAD", (sandbox.directory() / "libtracetools.so").string()}}}),
                1, "Tracing disabled\n",
                "tracetools: tracing is disabled, the provider cannot be loaded: " +
                    (sandbox.directory() / "libtracetools_provider.so").string() +
                    ": cannot open shared object file: No such file or directory\n");
}

}  // namespace
