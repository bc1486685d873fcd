// SPDX-License-Identifier: Apache-2.0
// What the kernel says of a process, and of its small files.
#include "base/processes/process_stat.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/files/small_file.hpp"
#include "tests/support/emulated.hpp"

namespace {

// Stops at once.
pid_t start_stopped(const char* name) {
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_NAME, name);
    raise(SIGSTOP);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, WUNTRACED);
  return child;
}

void end(pid_t child) {
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(ProcessStat, TellsNameStateAndParentWhateverTheNameHolds) {
  const pid_t child = start_stopped("a) R (b) 7 8");
  const launch::ProcessStat process = launch::read_process_stat(child);
  end(child);
  EXPECT_EQ(process.name, "a) R (b) 7 8");
  EXPECT_EQ(process.state, 'T');
  EXPECT_EQ(process.parent, getpid());
}

TEST(ProcessStat, AYoungerProcessStartedNotEarlierThanThisOne) {
  const pid_t child = start_stopped("younger");
  const launch::ProcessStat younger = launch::read_process_stat(child);
  end(child);
  const launch::ProcessStat own = launch::read_process_stat(getpid());
  EXPECT_GT(own.started, 0u);
  EXPECT_GE(younger.started, own.started);
}

TEST(ProcessStat, CountsTheTimeOnProcessors) {
  NEEDS_PROC_SELF();
  const std::uint64_t before = launch::read_process_stat(getpid()).processor_time;
  std::uint64_t now = before;
  while (now == before) {  // until a clock tick has passed
    now = launch::read_process_stat(getpid()).processor_time;
  }
  EXPECT_GT(now, before);
}

TEST(ProcessStat, NothingIsKnownOfAProcessThatHasEnded) {
  const pid_t child = start_stopped("ended");
  end(child);
  EXPECT_EQ(launch::read_process_stat(child).name, "");
}

TEST(SmallFile, IsReadWholeAlsoWhereItHasNoSize) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("small-file-" + std::to_string(getpid()));
  const std::string text(10'000, 'x');
  std::ofstream(path) << text;
  EXPECT_EQ(launch::read_small_file(path), text);
  std::filesystem::remove(path);
  EXPECT_EQ(launch::read_small_file(path), std::nullopt);
  EXPECT_NE(launch::read_small_file("/proc/self/maps")->find("[stack]"), std::string::npos);
}

}  // namespace
