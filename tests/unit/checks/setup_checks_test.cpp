// SPDX-License-Identifier: Apache-2.0
// Checks that fail before LTTng is asked: names, directories, context fields, sizes.
#include "tracing/record/checks/setup_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "tests/unit/plan/trace_error_text.hpp"
#include "tracing/record/checks/context_check.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace {

using tracing::TraceConfig;
using tracing::testing::error_of;

struct SetupChecks : testing::Test {
  SetupChecks() {
    std::string name = (std::filesystem::temp_directory_path() / "setup-checks-XXXXXX").string();
    directory = mkdtemp(name.data());
    config.session_name = "run";
    config.base_path = directory / "traces";
  }
  ~SetupChecks() override { std::filesystem::remove_all(directory); }

  std::string config_error() const {
    return error_of([this] { tracing::check_config(config); });
  }

  std::filesystem::path directory;
  TraceConfig config;
};

TEST_F(SetupChecks, AcceptABaseDirectoryThatIsYetToBeCreatedAndCreateNothing) {
  config.base_path = directory / "a" / "b" / "c";
  EXPECT_EQ(config_error(), "no error");
  EXPECT_TRUE(std::filesystem::is_empty(directory));
}

TEST_F(SetupChecks, RefuseAnEmptyName) {
  config.session_name.clear();
  EXPECT_EQ(config_error(), "the trace session's name is empty\ngive it a session-name");
}

TEST_F(SetupChecks, RefuseASlashInTheName) {
  config.session_name = "a/b";
  EXPECT_EQ(config_error(),
            "trace session name 'a/b' contains a '/'\nthe directory that will hold the trace is given by base-path "
            "(launch trace: --path)");
}

TEST_F(SetupChecks, RefuseANameThatLttngWouldCut) {
  config.session_name = std::string(255, 'n');
  EXPECT_EQ(config_error(), "trace session name '" + config.session_name + "' is longer than 254 characters\n");
}

TEST_F(SetupChecks, RefuseATraceWithoutEvents) {
  config.events_ust.clear();
  EXPECT_EQ(
      config_error(),
      "no events enabled for trace session 'run'\nname some in events-ust, events-python, events-kernel or syscalls");
  config.syscalls = {"openat"};
  EXPECT_EQ(config_error(), "no error");
}

TEST_F(SetupChecks, RefuseADirectoryThatExistsUnlessAppending) {
  std::filesystem::create_directories(directory / "traces" / "run");
  EXPECT_EQ(config_error(), "trace directory " + config.trace_directory() +
                                " exists already\nset append-trace to true (launch trace: --append-trace) to add to "
                                "it, or choose another session-name");
  config.append_trace = true;
  EXPECT_EQ(config_error(), "no error");
}

TEST_F(SetupChecks, WarnOfThreadCountersThatCannotBeCounted) {
  EXPECT_TRUE(tracing::perf_warnings({"vpid", "vtid"}).empty());
  const std::string impossible = "perf:thread:iTLB-stores";  // nothing stores through the instruction TLB
  EXPECT_THAT(tracing::perf_warnings({"vpid", impossible}),
              testing::ElementsAre(testing::AllOf(
                  testing::StartsWith("context field 'perf:thread:iTLB-stores' cannot be counted here ("),
                  testing::EndsWith("): LTTng will record no events; leave it out, or see whether "
                                    "/proc/sys/kernel/perf_event_paranoid forbids it"))));
}

}  // namespace
