// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/session_daemon.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/support/command.hpp"
#include "tests/unit/plan/trace_error_text.hpp"

namespace {

using tracing::testing::error_of;

struct SessionDaemon : testing::Test {
  SessionDaemon() {
    std::string name = (std::filesystem::temp_directory_path() / "session-daemon-XXXXXX").string();
    directory = mkdtemp(name.data());
  }
  ~SessionDaemon() override { std::filesystem::remove_all(directory); }

  std::filesystem::path directory;
};

TEST_F(SessionDaemon, TakesARunningSessionDaemonOnly) {
  const std::string pid_file = directory / "lttng-sessiond.pid";
  const auto error = [&] { return error_of([&] { tracing::check_daemon_is_here(pid_file); }); };
  EXPECT_EQ(error(), "no error");  // without the file there is no objection
  test_support::write_file(pid_file, std::to_string(getpid()) + "\n");
  EXPECT_EQ(error(),
            "the LTTng session daemon exists but is unreachable: " + pid_file + " names process " +
                std::to_string(getpid()) +
                ", which is not a lttng-sessiond here\nanother container shares this home directory: give each "
                "container its own LTTNG_HOME (LTTng bug 1371)");
}

}  // namespace
