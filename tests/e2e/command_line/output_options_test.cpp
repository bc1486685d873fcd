// SPDX-License-Identifier: Apache-2.0
// How users set what a launch prints and logs (docs/logging.md).
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class OutputOptions : public testing::Test {
 protected:
  std::string write(const std::string& actions) const {
    const std::string file = sandbox_.directory() / "system.launch.xml";
    write_file(file, "<launch>\n" + actions + "\n</launch>\n");
    return file;
  }
  fs::path log_directory(const CommandResult& result) const {
    const std::size_t begin = result.out.find("below ") + 6;
    return result.out.substr(begin, result.out.find('\n', begin) - begin);
  }

  Sandbox sandbox_;
};

TEST_F(OutputOptions, FormatsOfMessagesAreThoseOfRos2Launch) {
  const std::string file = write(R"xml(<executable cmd="echo text" name="a" output="both"/>)xml");
  const CommandResult result =
      run_command({.argv = {LAUNCH_PROGRAM, file},
                   .environment = {{"OVERRIDE_LAUNCH_SCREEN_FORMAT", "{levelname:>8}|{name}|{msg}"},
                                   {"OVERRIDE_LAUNCH_LOG_FORMAT", "log\\t{msg}"},
                                   {"OVERRIDE_LAUNCH_LOG_FILE_NAME", "run.log"}}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\n    INFO|a-1|process started with pid ["));
  EXPECT_THAT(result.out, HasSubstr("\n[a-1] text\n"));
  const std::string log = read_file(log_directory(result) / "run.log");
  EXPECT_THAT(log, HasSubstr("\nlog\tprocess started with pid ["));
  EXPECT_THAT(log, ContainsRegex("\n[0-9.]+ \\[a-1\\] text\n"));
}

TEST_F(OutputOptions, TheLogFileHasTheNameThatIsGiven) {
  const std::string file = write(R"xml(<executable cmd="echo text" name="a"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "--log-file-name", "run", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_file(log_directory(result) / "run.log"), HasSubstr("process started with pid ["));
  EXPECT_FALSE(std::filesystem::exists(log_directory(result) / "launch.log"));
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, "--log-file-name", "a/b", file}).exit_code, 2);
}

TEST_F(OutputOptions, AFormatWithAnErrorStartsNothing) {
  const std::string file = write(R"xml(<executable cmd="echo text" output="screen"/>)xml");
  const CommandResult result =
      run_command({.argv = {LAUNCH_PROGRAM, file}, .environment = {{"OVERRIDE_LAUNCH_SCREEN_FORMAT", "{levl} {msg}"}}});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch: error: OVERRIDE_LAUNCH_SCREEN_FORMAT: there is no field 'levl'; the fields are created, asctime, "
            "levelname, levelno, name, msg, process\n");
  EXPECT_EQ(result.out, "");
}

TEST_F(OutputOptions, TimestampsStandInFrontOfEveryLine) {
  const std::string file = write(R"xml(<executable cmd="echo text" name="a" output="screen"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "--timestamps", file});
  EXPECT_THAT(result.out, ContainsRegex("\n[0-9]{10}\\.[0-9]{7} \\[a-1\\] text\n"));
  EXPECT_THAT(result.out, Not(ContainsRegex("\n\\[")));
}

TEST_F(OutputOptions, ColoursCanBeForced) {
  const std::string file = write(R"xml(<log message="text" level="error"/>)xml");
  const auto output = [&](const std::string& wish) {
    return run_command({.argv = {LAUNCH_PROGRAM, file}, .environment = {{"RCUTILS_COLORIZED_OUTPUT", wish}}}).out;
  };
  EXPECT_THAT(output("1"), HasSubstr("\033[31m[ERROR] [launch.user]: text\033[0m\n"));
  EXPECT_THAT(output("0"), HasSubstr("\n[ERROR] [launch.user]: text\n"));
  const std::vector<std::string> check = {LAUNCH_PROGRAM, "check", "nosuch"};
  EXPECT_THAT(run_command({.argv = check, .environment = {{"RCUTILS_COLORIZED_OUTPUT", "1"}}}).out,
              HasSubstr("\033[1;31merror:\033[0m"));
  EXPECT_THAT(run_command(check).out, StartsWith("error: launch file 'nosuch' does not exist [LF0001]\n"));
}

// A launch within the launch, and any program that knows such variables, would take them for itself.
TEST_F(OutputOptions, AreNoVariablesOfTheProcesses) {
  const std::string file = write(R"xml(<executable cmd="env" name="a"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "-a", file});
  EXPECT_THAT(result.out, HasSubstr("\n[a-1] PATH="));
  EXPECT_THAT(result.out, Not(HasSubstr("OVERRIDE_LAUNCH")));
  const CommandResult planned = run_command({LAUNCH_PROGRAM, "-a", "--report", "--dry-run=json", file});
  EXPECT_THAT(planned.out, Not(HasSubstr("LAUNCH_")));
}

TEST_F(OutputOptions, LogLevelsAreForAllNodesOrForSome) {
  const std::string file = write(R"xml(<node pkg="demo_nodes" exec="talker" name="a"/>
<node pkg="demo_nodes" exec="listener" name="b" namespace="/left"/>
<executable cmd="other"/>)xml");
  const CommandResult all = run_command({LAUNCH_PROGRAM, "--dry-run", "--log-level", "debug", file});
  EXPECT_THAT(all.out, ContainsRegex("/talker --ros-args .*--log-level debug\n"));
  EXPECT_THAT(all.out, ContainsRegex("/listener --ros-args .*--log-level debug\n"));
  EXPECT_THAT(all.out, Not(HasSubstr("other --")));
  const CommandResult some =
      run_command({LAUNCH_PROGRAM, "--dry-run", "--log-level", "/left/*:=warn", "--log-level", "talker:=fatal", file});
  EXPECT_THAT(some.out, ContainsRegex("/talker --ros-args .*--log-level fatal\n"));
  EXPECT_THAT(some.out, ContainsRegex("/listener --ros-args .*--log-level warn\n"));
  const CommandResult wrong = run_command({LAUNCH_PROGRAM, "--log-level", "loud", file});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err,
              HasSubstr("--log-level loud is unknown, expected debug, info, warn, error, fatal or NODE:=LEVEL"));
}

TEST_F(OutputOptions, LogFilesHaveALimitedSizeAndNumber) {
  const std::string file = write(R"xml(<executable cmd="seq 10000" name="a" output="full"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "--log-size", "10K", "--log-files", "3", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const fs::path logs = log_directory(result);
  for (const std::string name : {"launch.log", "a-1-stdout.log", "a-1.log"}) {
    EXPECT_TRUE(fs::exists(logs / (name + ".1"))) << name;
    EXPECT_TRUE(fs::exists(logs / (name + ".2"))) << name;
    EXPECT_FALSE(fs::exists(logs / (name + ".3"))) << name;
  }
  EXPECT_THAT(read_file(logs / "launch.log"), HasSubstr("process has finished cleanly"));
  EXPECT_THAT(
      read_file(logs / "a-1.log"),
      StartsWith("[launch] lines before this one are in a-1.log.1; of this log, the newest 3 files of 10240 bytes "
                 "are kept\n"));
}

TEST_F(OutputOptions, ASizeThatIsNoneIsAnError) {
  const std::string file = write(R"xml(<executable cmd="true"/>)xml");
  for (const char* const size : {"-1", "-5M", "10Q", "", "1.5G", "99999999999G"}) {
    const CommandResult result = run_command({LAUNCH_PROGRAM, "--log-size", size, file});
    EXPECT_EQ(result.exit_code, 2) << size;
    EXPECT_THAT(result.err,
                HasSubstr("'" + std::string(size) + "' is no size; write bytes, or a number with K, M or G"));
  }
}

TEST_F(OutputOptions, LogsOfEarlierLaunchesAreRemoved) {
  const std::string file = write(R"xml(<executable cmd="true"/>)xml");
  std::vector<fs::path> logs;
  for (int i = 0; i < 3; ++i) {
    logs.push_back(log_directory(run_command({LAUNCH_PROGRAM, file})));
    for (const fs::directory_entry& entry : fs::directory_iterator(logs.back())) {
      fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(10 - i));
    }
  }
  const CommandResult result = run_command({LAUNCH_PROGRAM, "--keep-logs", "2", file});
  EXPECT_THAT(result.out, ContainsRegex("removed the logs of 2 earlier launches \\([0-9.]+ MiB\\), 2 are left; "
                                        "--keep-logs says how many"));
  EXPECT_FALSE(fs::exists(logs[0]));
  EXPECT_FALSE(fs::exists(logs[1]));
  EXPECT_TRUE(fs::exists(logs[2]));
  const CommandResult wrong = run_command({LAUNCH_PROGRAM, "--keep-logs", "2x", file});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.err,
            "launch: error: --keep-logs: '2x' is no limit for logs, expected such as 200,90d,4G (directories, days, "
            "bytes), or all\n"
            "      = help: see 'launch --help'\n");
  const CommandResult wrong_variable =
      run_command({.argv = {LAUNCH_PROGRAM, file}, .environment = {{"OVERRIDE_LAUNCH_KEEP_LOGS", "2x"}}});
  EXPECT_EQ(wrong_variable.exit_code, 1);
  EXPECT_EQ(wrong_variable.err,
            "launch: error: OVERRIDE_LAUNCH_KEEP_LOGS: '2x' is no limit for logs, expected such as 200,90d,4G "
            "(directories, days, bytes), or all\n");
}

}  // namespace
