// SPDX-License-Identifier: Apache-2.0
// Writes traces and runs the tests of the Python module on them.
#include <gtest/gtest.h>

#include "tests/support/command.hpp"
#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace {

namespace fs = std::filesystem;
namespace ros2 = tracing::ros2;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using tracing::testing::TemporaryDirectory;
using tracing::testing::Thread;
using tracing::testing::TraceWriter;

constexpr Thread kPing{71, 72, "ping"};

// What test_launch_trace.py expects.
void write_traces(const fs::path& directory) {
  TraceWriter writer(directory / "whole", {.identity = 1, .vppid = 70});
  writer.write(0, 100, kPing, ros2::RclNodeInit{0xffff800000000001, 2, "tal\xffker", "/ns"});
  for (std::int64_t i = 0; i < 5; ++i) {
    writer.write(0, 200 + 10 * i, kPing, ros2::CallbackStart{static_cast<std::uint64_t>(i), i % 2 == 1});
  }
  writer.end_packet(0);
  writer.discard_events(0, 3);
  writer.write(1, 250, {81, 82, "pong"}, ros2::RmwTake{1, 2, -7, true});
  const std::uint16_t own = writer.declare("own:values",
                                           "floating_point { exp_dig = 11; mant_dig = 53; align = 8; } _ratio;\n"
                                           "integer { size = 8; align = 8; signed = 0; } _bytes[3];\n"
                                           "struct { integer { size = 8; align = 8; signed = 1; } _inner; } _pair;\n");
  const double ratio = 0.5;
  std::string payload(reinterpret_cast<const char*>(&ratio), sizeof ratio);
  payload += "\1\2\3\xfe";
  writer.write_raw(0, 300, kPing, own, payload);
  writer.finish();

  TraceWriter other(directory / "other", {.identity = 2});
  other.write(0, 150, kPing, ros2::RclNodeInit{5, 6, "other", "/"});
  other.write(0, 160, kPing, ros2::RclTake{5});
  other.finish();

  TraceWriter damaged(directory / "damaged", {.identity = 3});
  damaged.write(0, 1, kPing, ros2::RclTake{5});
  damaged.write(0, 2, kPing, ros2::RclTake{6});
  damaged.finish();
  const fs::path stream = directory / "damaged/ros2_0";
  fs::resize_file(stream, fs::file_size(stream) - 1);
}

// `without` is a module that Python must not find.
CommandResult run_tests(const fs::path& traces, const std::string& without) {
  return run_command(
      Command{{PYTHON, "-B", PYTHON_TESTS "/test_launch_trace.py", "-v"},
              {{"PYTHONPATH", PYTHON_MODULE_DIRECTORY}, {"TRACES", traces.string()}, {"WITHOUT_MODULE", without}}});
}

TEST(PythonModule, ReadsTraces) {
  const TemporaryDirectory directory;
  write_traces(directory.path());
  const CommandResult result = run_tests(directory.path(), "");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST(PythonModule, NeedsNoNumpy) {
  const TemporaryDirectory directory;
  write_traces(directory.path());
  const CommandResult result = run_tests(directory.path(), "numpy");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

// launch_trace.open(): tables, chains, plots, and the same answers as in SQL, CSV and JSON.
void expect_tables(const std::string& without) {
  const TemporaryDirectory directory;
  tracing::testing::write_example_system(directory.path() / "system", 100);
  const CommandResult result = run_command(Command{{PYTHON, "-B", PYTHON_TESTS "/test_open.py", "-v"},
                                                   {{"PYTHONPATH", PYTHON_MODULE_DIRECTORY},
                                                    {"SYSTEM", (directory.path() / "system").string()},
                                                    {"REPORT", LAUNCH_REPORT},
                                                    {"NOTEBOOK", NOTEBOOK},
                                                    {"WITHOUT_MODULE", without}}});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST(PythonModule, GivesTheTablesOfATrace) {
  expect_tables("");
}

TEST(PythonModule, GivesTheTablesWithoutNumpy) {
  expect_tables("numpy,pandas,matplotlib");
}

// The types that editors and type checkers get.
TEST(PythonModule, HasTheTypesOfItsStub) {
  const TemporaryDirectory directory;
  write_traces(directory.path());
  const CommandResult result =
      run_command(Command{{PYTHON, "-B", PYTHON_TESTS "/test_stub.py", "-v"},
                          {{"PYTHONPATH", PYTHON_MODULE_DIRECTORY}, {"TRACES", directory.path().string()}}});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

}  // namespace
