// SPDX-License-Identifier: Apache-2.0
// The whole product, installed and then moved: the launcher finds its own packages, guardian and report at their new
// place.
#include <gmock/gmock.h>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using test_support::CommandResult;
using test_support::run_command;
using testing::HasSubstr;

TEST(Installation, RunsFromAPrefixThatWasMoved) {
  test_support::Sandbox sandbox;
  const fs::path first = sandbox.directory() / "first";
  const fs::path prefix = sandbox.directory() / "moved";
  const CommandResult install = run_command({CMAKE, "--install", BUILD_DIRECTORY, "--prefix", first.string()});
  ASSERT_EQ(install.exit_code, 0) << install.err;
  fs::rename(first, prefix);
  EXPECT_TRUE(fs::exists(prefix / "share/doc/launch/LICENSE"));

  const std::string launch = (prefix / "bin/launch").string();
  const CommandResult plan = run_command({launch, "--dry-run", "launch_examples", "01_ping_pong.launch.xml"});
  EXPECT_THAT(plan.out, HasSubstr((prefix / "lib/demo_nodes/ping").string()));

  const CommandResult run =
      run_command({launch, "launch_examples", "01_ping_pong.launch.yaml", "count:=2", "period_ms:=20"});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr(" events, 2 processes, none lost)"));
  const CommandResult report = run_command({launch, "report", sandbox.trace_directory().string()});
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_THAT(report.out, HasSubstr("no events lost"));
}

}  // namespace
