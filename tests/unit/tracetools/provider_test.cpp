// Loading libtracetools_provider.so, seen from outside: each case is a process of its own.
#include <gtest/gtest.h>

#include <filesystem>

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
  // lttng-ust listens to the user's and to root's session daemon.
  EXPECT_EQ(run_command({FIRE_ALL_EVENTS}).out, "3 threads\n");
}

TEST(Provider, IsNotLoadedWhenTracingIsDisabled) {
  expect_result(run_command(Command{{STATUS}, {{"TRACETOOLS_RUNTIME_DISABLE", "1"}}}), 1, "Tracing disabled\n", "");
  EXPECT_EQ(run_command(Command{{FIRE_ALL_EVENTS}, {{"TRACETOOLS_RUNTIME_DISABLE", "1"}}}).out, "1 threads\n");
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
  expect_result(
      run_command(Command{{STATUS}, {{"LD_LIBRARY_PATH", sandbox.directory().string()}}}), 1, "Tracing disabled\n",
      "tracetools: tracing is disabled, the provider cannot be loaded: libtracetools_provider.so: cannot open "
      "shared object file: No such file or directory\n");
}

}  // namespace
