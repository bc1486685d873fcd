// SPDX-License-Identifier: Apache-2.0
// launch run: a program of a package on the terminal of its caller.
#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::HasSubstr;

class RunProgram : public testing::Test {
 protected:
  // A program of the package `tools`.
  void write_program(const std::string& script) const {
    write_file(prefix_ / "share/ament_index/resource_index/packages/tools", "");
    write_file(prefix_ / "lib/tools/tool", "#!/bin/sh\n" + script + "\n");
    fs::permissions(prefix_ / "lib/tools/tool", fs::perms::owner_all);
  }
  Command command(std::vector<std::string> words) const {
    words.insert(words.begin(), {LAUNCH_PROGRAM, "run"});
    return {.argv = std::move(words), .environment = {{"AMENT_PREFIX_PATH", prefix_.string()}}};
  }

  Sandbox sandbox_;
  fs::path prefix_ = [this] {
    fs::create_directories(sandbox_.directory() / "prefix/share/ament_index/resource_index/packages");
    fs::create_directories(sandbox_.directory() / "prefix/lib/tools");
    return sandbox_.directory() / "prefix";
  }();
};

TEST_F(RunProgram, PassesArgumentsInputOutputAndTheExitCode) {
  write_program("read line; echo \"$# $*: $line\"; echo error >&2; exit 5");
  const CommandResult result =
      run_command(command({"tools", "tool", "--help", "a b", "--ros-args", "-r", "x:=y"}), kCommandTimeout, "input\n");
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_EQ(result.out, "5 --help a b --ros-args -r x:=y: input\n");
  EXPECT_EQ(result.err, "error\n");
}

TEST_F(RunProgram, EndsWhatTheProgramLeavesRunning) {
  write_program("setsid sleep 1000 & echo started");
  const CommandResult result = run_command(command({"tools", "tool"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("started\n"));
  EXPECT_TRUE(result.output_closed) << "no process is left";
}

TEST_F(RunProgram, RecordsATrace) {
  write_program("echo traced; exit 5");
  const CommandResult result = run_command(command({"--trace", "tools", "tool"}), std::chrono::seconds(60));
  EXPECT_EQ(result.exit_code, 5) << result.out << result.err;
  EXPECT_THAT(result.out, testing::AllOf(HasSubstr("[tool-1] traced\n"), HasSubstr("trace written to: "),
                                         HasSubstr("/traces/tool-")));
}

TEST_F(RunProgram, PassesASignalAndTellsItsNumber) {
  write_program("echo ready; exec sleep 1000");
  RunningCommand run(command({"tools", "tool"}));
  ASSERT_TRUE(run.wait_for_output("ready"));
  run.send_signal(SIGTERM);
  EXPECT_EQ(run.wait().exit_code, 128 + SIGTERM);
}

TEST_F(RunProgram, PutsAPrefixInFront) {
  write_program("echo $WORD $1");
  EXPECT_EQ(run_command(command({"--prefix", "env WORD='a word'", "tools", "tool", "1"})).out, "a word 1\n");
}

TEST_F(RunProgram, SuggestsNames) {
  write_program("");
  const CommandResult program = run_command(command({"tools", "tol"}));
  EXPECT_EQ(program.exit_code, 1);
  EXPECT_EQ(program.err, "launch run: error: executable 'tol' not found on the libexec directory '" +
                             (prefix_ / "lib/tools").string() + "'\n      = help: did you mean 'tool'?\n");
  const CommandResult package = run_command(command({"tolos", "tool"}));
  EXPECT_EQ(package.exit_code, 1);
  EXPECT_THAT(package.err, HasSubstr("did you mean 'tools'?"));
  EXPECT_EQ(run_command(command({"tools"})).exit_code, 2);
  EXPECT_EQ(run_command({.argv = {LAUNCH_PROGRAM, "complete", "run", "tools", ""},
                         .environment = {{"AMENT_PREFIX_PATH", prefix_.string()}}})
                .out,
            "tool\n");
}

}  // namespace
