// SPDX-License-Identifier: Apache-2.0
// A launch where the kernel lacks a system call that it needs, or where a container forbids it.
#include <gmock/gmock.h>

#include <string>
#include <tuple>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using Missing = std::tuple<const char*, const char*, const char*>;  // its name, the error, and since when Linux has it

class MissingCalls : public testing::TestWithParam<Missing> {};

TEST_P(MissingCalls, AreNamed) {
  const auto [name, error, since] = GetParam();
  const Sandbox sandbox;
  const auto file = sandbox.directory() / "system.launch.xml";
  const auto started = sandbox.directory() / "started";
  write_file(file, "<launch><executable cmd=\"touch " + started.string() + "\"/></launch>\n");
  const CommandResult result = run_command({WITHOUT_SYSTEM_CALL, name, error, LAUNCH_PROGRAM, file.string()});
  if (result.exit_code == 77) {
    GTEST_SKIP() << "skipped, because " << result.err;
  }
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, std::string("launch: error: the system call ") + name +
                            " does not work here, and no launch can run without it (Linux has it since " + since +
                            "; a seccomp profile may forbid it): " +
                            (std::string(error) == "EPERM" ? "Operation not permitted" : "Function not implemented") +
                            "\n");
  EXPECT_FALSE(std::filesystem::exists(started));
}

INSTANTIATE_TEST_SUITE_P(All, MissingCalls,
                         testing::Values(Missing("pidfd_open", "ENOSYS", "5.3"), Missing("pidfd_open", "EPERM", "5.3"),
                                         Missing("signalfd4", "ENOSYS", "2.6.27"),
                                         Missing("pidfd_send_signal", "EPERM", "5.1")));

}  // namespace
