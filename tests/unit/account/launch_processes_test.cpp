// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/counters/launch_processes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/files/pipe.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tracing/record/account/verdict.hpp"

namespace tracing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(LaunchProcesses, AreThoseThatWereNotedAndThoseThatCount) {
  const testing::TemporaryDirectory directory;
  const std::string counters = directory.path().string();
  note_launch_processes(counters, {12, 4});
  note_launch_processes(counters, {});
  note_launch_processes(counters, {12, 7});
  EXPECT_THAT(read_launch_processes(counters, {{.pid = 5, .process = "child"}}), ElementsAre(4, 5, 7, 12));
}

TEST(LaunchProcesses, AreNotKnownWhereNothingWasNoted) {
  const testing::TemporaryDirectory directory;
  note_launch_processes("", {12});
  EXPECT_THAT(read_launch_processes("", {{.pid = 5, .process = "child"}}), IsEmpty());
  EXPECT_THAT(read_launch_processes(directory.path().string(), {{.pid = 5, .process = "child"}}), IsEmpty());
}

TEST(LaunchProcesses, AreRelatedByParents) {
  const launch::Pipe told = launch::make_pipe();
  const launch::Pipe hold = launch::make_pipe();
  const pid_t child = ::fork();
  if (child == 0) {
    const pid_t grandchild = ::fork();
    if (grandchild > 0) {
      ::write(told.write.get(), &grandchild, sizeof grandchild);
    }
    char end = 0;
    ::read(hold.read.get(), &end, 1);
    ::_exit(0);
  }
  pid_t grandchild = 0;
  ASSERT_EQ(::read(told.read.get(), &grandchild, sizeof grandchild), static_cast<ssize_t>(sizeof grandchild));
  const std::vector<pid_t> related = related_processes();
  EXPECT_EQ(::write(hold.write.get(), "..", 2), 2);
  EXPECT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_THAT(related, Contains(::getpid()));
  EXPECT_THAT(related, Contains(::getppid()));
  EXPECT_THAT(related, Contains(child));
  EXPECT_THAT(related, Contains(grandchild));
  EXPECT_THAT(related, Not(Contains(0)));
}

TEST(LaunchProcesses, StandInTheVerdict) {
  LossAccount account;
  EXPECT_FALSE(nlohmann::json::parse(verdict_as_json(account, "run")).contains("launch_processes"));
  account.launch_processes = {4, 12};
  EXPECT_EQ(nlohmann::json::parse(verdict_as_json(account, "run"))["launch_processes"], nlohmann::json({4, 12}));

  const testing::TemporaryDirectory directory;
  SnapshotAccount snapshot;
  snapshot.launch_processes = {5};
  write_snapshot_verdict(directory.path(), "run", snapshot, {});
  std::ifstream file(directory.path() / kVerdictFile);
  EXPECT_EQ(nlohmann::json::parse(file)["launch_processes"], nlohmann::json({5}));
}

}  // namespace
}  // namespace tracing
